// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vmcl/geometry/random.h"
#include "vmcl/mapping/keyframe_map.h"

namespace vmcl::testing {

/// A map of every part, filled with random values that are valid.
inline KeyframeMap smallMap(uint64_t seed = 1) {
  Random random(seed);
  KeyframeMap map;
  map.feature_options = {FeatureKind::orb, 7, 2};
  MapCamera camera{"front", {{640, 480, 500, 501, 320, 240}, {0.1, -0.2, 0.01, 0.02, 0.3}}, Rigid3::Identity(), 3};
  camera.robot_from_camera = Eigen::Translation3d(0.1, 0.2, 0.3) * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY());
  map.cameras = {camera, camera};
  map.cameras[1].label = "";
  map.cameras[1].calibration.pinhole.width = 20;
  map.cameras[1].calibration.pinhole.height = 15;
  map.cameras[1].mask = {20, 15, std::vector<uint8_t>(20 * 15)};
  map.cameras[1].mask.pixels[7 * 20 + 5] = 255;
  map.cameras[1].depth = DepthSource::range;
  for (int l = 0; l < 4; ++l) {
    const Eigen::Matrix3d root = Eigen::Matrix3d::NullaryExpr([&] { return random.normal(); });
    const Eigen::Matrix3d covariance = root * root.transpose();
    const Eigen::Vector3d point(random.normal(), random.normal(), 1);
    map.landmarks.push_back({point, (covariance + covariance.transpose()) / 2, 3});
  }
  map.pose_covariance = map.landmarks[1].covariance;
  for (int k = 0; k < 3; ++k) {
    Keyframe keyframe{0.1 * k, k % 2, k / 2, toRigid3({random.normal(), 2, random.normal()}), {}, {}};
    const int count = 3 * k;  // the first has none
    keyframe.features.descriptors.resize(count, 32);
    for (int i = 0; i < count; ++i) {
      keyframe.features.pixels.emplace_back(random.uniform(0, 640), random.uniform(0, 480));
      keyframe.features.sizes.push_back(31);
      keyframe.features.responses.push_back(static_cast<float>(random.uniform()));
      keyframe.landmark_of_feature.push_back(i % 5 - 1);
      for (int byte = 0; byte < 32; ++byte)
        keyframe.features.descriptors(i, byte) = static_cast<uint8_t>(random.next());
    }
    keyframe.dense.image = {uint8_t{1}, uint8_t{2}, static_cast<uint8_t>(k)};
    map.keyframes.push_back(keyframe);
  }
  map.keyframes[1].dense.depth.assign(5 * 4, 1234);
  map.keyframes[1].solution = Solver::two_depth;
  const Eigen::MatrixXf words =
      Eigen::MatrixXf::NullaryExpr(2, 256, [&] { return static_cast<float>(random.normal()); });
  map.vocabulary = VladVocabulary(FeatureKind::orb, words);
  map.place_descriptors = Eigen::MatrixXf::NullaryExpr(512, 3, [&] { return static_cast<float>(random.normal()); });
  return map;
}

}  // namespace vmcl::testing
