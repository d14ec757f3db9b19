// SPDX-License-Identifier: BSD-3-Clause
#include "bundle_adjustment.h"

#include <gtest/gtest.h>

#include "landmark_covariance.h"
#include "synthetic_room.h"

namespace vmcl {
namespace {

/// Three views of one point, which is not a number.
Reconstruction brokenScene() {
  Reconstruction scene;
  scene.cameras = {testing::forwardCamera()};
  scene.corrections.resize(1);
  scene.keyframes.resize(3);
  scene.map_from_robot.resize(3);
  scene.depths.resize(3);
  scene.level_from_robot.resize(3, Rigid3::Identity());
  scene.stance.resize(3, Eigen::Vector3d::Zero());
  for (Keyframe& keyframe : scene.keyframes) keyframe.features.pixels.emplace_back(320, 240);
  scene.points.push_back({Eigen::Vector3d::Constant(std::nan("")), {{0, 0}, {1, 0}, {2, 0}}});
  return scene;
}

TEST(BundleAdjustment, SaysThatItFailed) {
  Reconstruction scene = brokenScene();
  EXPECT_THROW(adjust(scene, {}, 1e-6), std::runtime_error);
}

TEST(LandmarkCovariance, APointThatIsNotFixedHasNoneAndSpoilsNoOther) {
  Reconstruction scene = brokenScene();
  scene.points.push_back({{5, 0, 0.4}, {{0, 0}, {1, 0}, {2, 0}}});
  scene.points.push_back({{5e6, 0, 0.4}, {{0, 0}, {1, 0}, {2, 0}}});
  for (int k = 0; k < 3; ++k) scene.map_from_robot[static_cast<std::size_t>(k)].y = 0.5 * k;
  const std::vector<Eigen::Matrix3d> covariances = pointCovariances(scene, {});
  EXPECT_FALSE(covariances[0].allFinite());
  EXPECT_TRUE(covariances[1].allFinite()) << covariances[1];
  EXPECT_FALSE(covariances[2].allFinite()) << covariances[2];
}

}  // namespace
}  // namespace vmcl
