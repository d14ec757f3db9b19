// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mapping/keyframe_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "small_map.h"

namespace vmcl {
namespace {

using testing::smallMap;

void setFeatureCount(Keyframe& keyframe, std::size_t count) {
  keyframe.features.pixels.resize(count, Eigen::Vector2f::Zero());
  keyframe.features.sizes.resize(count);
  keyframe.features.responses.resize(count);
  keyframe.features.descriptors.setZero(static_cast<Eigen::Index>(count), 32);
  keyframe.landmark_of_feature.resize(count, -1);
}

TEST(KeyframeMap, AcceptsAValidAndAnEmptyMap) {
  EXPECT_NO_THROW(smallMap().check());
  EXPECT_NO_THROW(KeyframeMap{}.check());
}

TEST(KeyframeMap, NamesTheBrokenEntry) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  struct Damage {
    const char* named;
    std::function<void(KeyframeMap&)> apply;
  };
  const Damage damages[] = {
      {"max_features", [](KeyframeMap& map) { map.feature_options.max_features = 0; }},
      {"camera 1", [&](KeyframeMap& map) { map.cameras[1].calibration.pinhole.fx = nan; }},
      {"camera 0", [](KeyframeMap& map) { map.cameras[0].robot_from_camera.linear() *= 1.1; }},
      {"camera 0", [](KeyframeMap& map) { map.cameras[0].mask_rows_from_top = -1; }},
      {"camera 1", [](KeyframeMap& map) { map.cameras[1].mask.width = 15; }},
      {"camera 1", [](KeyframeMap& map) { map.cameras[1].mask.pixels.pop_back(); }},
      {"camera 0", [](KeyframeMap& map) { map.cameras[0].depth = static_cast<DepthSource>(3); }},
      {"keyframe 2", [&](KeyframeMap& map) { map.keyframes[2].time = nan; }},
      {"keyframe 2", [&](KeyframeMap& map) { map.keyframes[2].session = -1; }},
      {"keyframe 1", [](KeyframeMap& map) { map.keyframes[1].camera = 2; }},
      {"keyframe 1", [](KeyframeMap& map) { map.keyframes[1].camera = -1; }},
      {"keyframe 0", [&](KeyframeMap& map) { map.keyframes[0].map_from_robot.translation().x() = nan; }},
      {"keyframe 0", [](KeyframeMap& map) { map.keyframes[0].map_from_robot.linear().col(2) *= -1; }},
      {"keyframe 1", [](KeyframeMap& map) { map.keyframes[1].features.sizes.pop_back(); }},
      {"keyframe 1", [](KeyframeMap& map) { map.keyframes[1].dense.depth.pop_back(); }},
      {"keyframe 1", [](KeyframeMap& map) { map.keyframes[1].features.kind = FeatureKind::sift; }},
      {"keyframe 1", [&](KeyframeMap& map) { map.keyframes[1].features.pixels[0].x() = std::nanf(""); }},
      {"keyframe 1", [](KeyframeMap& map) { map.keyframes[1].features.descriptors.resize(3, 31); }},
      {"100001 features", [](KeyframeMap& map) { setFeatureCount(map.keyframes[1], 100'001); }},
      {"keyframe 2", [](KeyframeMap& map) { map.keyframes[2].landmark_of_feature[0] = 4; }},
      {"keyframe 2", [](KeyframeMap& map) { map.keyframes[2].landmark_of_feature[0] = -2; }},
      {"keyframe 2", [](KeyframeMap& map) { map.keyframes[2].landmark_of_feature.pop_back(); }},
      {"landmark 3", [&](KeyframeMap& map) { map.landmarks[3].point_in_map.z() = nan; }},
      {"landmark 3", [](KeyframeMap& map) { map.landmarks[3].covariance(0, 1) += 1; }},
      {"landmark 3", [](KeyframeMap& map) { map.landmarks[3].covariance(2, 2) = -1; }},
      {"landmark 3", [](KeyframeMap& map) { map.landmarks[3].observation_count = -1; }},
      {"poses", [](KeyframeMap& map) { map.pose_covariance(1, 1) = -1; }},
      {"vocabulary", [](KeyframeMap& map) { map.feature_options.kind = FeatureKind::sift, map.keyframes.clear(); }},
      {"place descriptors", [](KeyframeMap& map) { map.place_descriptors.conservativeResize(512, 2); }},
      {"place descriptors", [](KeyframeMap& map) { map.place_descriptors.resize(511, 3); }},
      {"place descriptors", [](KeyframeMap& map) { map.place_descriptors(5, 1) = std::nanf(""); }},
      {"place network", [](KeyframeMap& map) { map.place_network.file = "beside_a_vocabulary.onnx"; }},
  };
  for (const Damage& damage : damages) {
    KeyframeMap map = smallMap();
    damage.apply(map);
    try {
      map.check();
      ADD_FAILURE() << "accepted a broken " << damage.named;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(damage.named), std::string::npos)
          << "\"" << error.what() << "\" does not name " << damage.named;
    }
  }
}

TEST(KeyframeMap, ReferenceCameraIsTheCameraAtTheKeyframe) {
  const KeyframeMap map = smallMap();
  const ReferenceCamera reference = map.referenceCamera(map.keyframes[1]);
  EXPECT_EQ(reference.camera.fy, 501);
  const Eigen::Vector3d point_in_camera(0.3, -0.4, 2);
  const Eigen::Vector3d point_in_robot = map.cameras[1].robot_from_camera * point_in_camera;
  EXPECT_TRUE(
      (reference.map_from_camera * point_in_camera).isApprox(map.keyframes[1].map_from_robot * point_in_robot, 1e-12));
}

}  // namespace
}  // namespace vmcl
