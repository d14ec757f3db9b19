// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>

#include <memory>

#include "../relocalization/synthetic_room.h"
#include "vmcl/mrpt/visual_keyframe_map.h"

namespace vmcl {

using mrpt::obs::CObservationImage;

inline mrpt::poses::CPose3D mrptPose(const Rigid3& pose) {
  return mrpt::poses::CPose3D(mrpt::math::CMatrixDouble44(Eigen::Matrix4d(pose.matrix())));
}

inline mrpt::poses::CPose3D mrptPose(const PlanarPose& pose) { return {pose.x, pose.y, 0, pose.phi, 0, 0}; }

class VisualKeyframeMapTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { content_ = std::make_shared<const KeyframeMap>(mapOf(room_)); }
  static void TearDownTestSuite() { content_.reset(); }

  static CObservationImage imageFrom(const PlanarPose& robot_in_map) {
    const Image seen = room_.look(robot_in_map, SyntheticRoom::mount());
    CObservationImage observation;
    observation.sensorLabel = "front";
    static double time = 1000;  // a new one for each image, as the map tells images apart by it
    observation.timestamp = mrpt::Clock::fromDouble(time++);
    Image pixels = seen;
    observation.image.loadFromMemoryBuffer(seen.width, seen.height, false, pixels.pixels.data());
    const PinholeCamera camera = SyntheticRoom::calibration().pinhole;
    observation.cameraParams.ncols = static_cast<uint32_t>(camera.width);
    observation.cameraParams.nrows = static_cast<uint32_t>(camera.height);
    observation.cameraParams.setIntrinsicParamsFromValues(camera.fx, camera.fy, camera.cx, camera.cy);
    observation.cameraPose = mrptPose(SyntheticRoom::mount());
    return observation;
  }

  static double logLikelihood(const VisualKeyframeMap& map, const mrpt::obs::CObservation& observation,
                              const PlanarPose& robot_in_map) {
    return map.computeObservationLikelihood(observation, mrptPose(robot_in_map));
  }

  /// The truth is likelier than anything a little off, and far likelier than what is far off (10: 1 to 20,000).
  static void expectPeakAt(const PlanarPose& truth, const VisualKeyframeMap& map, const CObservationImage& image) {
    const double at_truth = logLikelihood(map, image, truth);
    for (const double step : {0.15, -0.15}) {
      EXPECT_GT(at_truth, logLikelihood(map, image, {truth.x + step, truth.y, truth.phi}));
      EXPECT_GT(at_truth, logLikelihood(map, image, {truth.x, truth.y + step, truth.phi}));
      EXPECT_GT(at_truth, logLikelihood(map, image, {truth.x, truth.y, truth.phi + step}) + 5);
    }
    EXPECT_GT(at_truth, logLikelihood(map, image, {truth.x, truth.y, truth.phi + 2}) + 10);
  }

  inline static const SyntheticRoom room_;
  inline static std::shared_ptr<const KeyframeMap> content_;
  const PlanarPose truth_{0.15, -0.25, 0.12};
};

}  // namespace vmcl
