// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "fake_camera_map.h"
#include "filter_setup.h"
#include "vmcl/mrpt/pose_cluster.h"

namespace vmcl {
namespace {

enum class Sensor { camera, laser };

/// A robot that stands at one place and is carried to another, seen by one sensor. An image has now 20, now 100
/// matches, of which most fit where the robot is and none elsewhere; before a blank wall, none fit anywhere.
class Kidnapping : public ::testing::TestWithParam<Sensor> {
 protected:
  Kidnapping() {
    const auto one = [this](const PlanarPose& p) {
      const double distance = std::hypot(p.x - truth_.x, p.y - truth_.y);
      return (blank_ ? 0 : 2.3 * std::exp(-distance * distance / 0.25)) - 0.3;
    };
    setup_.filter.BETA = 0.5;
    setup_.options.injection_share = 0;
    setup_.options.recovery_alpha_slow = 0.001;
    setup_.options.recovery_alpha_fast = 0.1;
    if (GetParam() == Sensor::camera)
      maps_->maps.push_back(camera_ = std::make_shared<FakeCameraMap>(one));
    else
      maps_->maps.push_back(std::make_shared<FakeMap>([one](const PlanarPose& p) { return 20 * one(p); }));
  }

  PlanarMonteCarlo make() const {
    PlanarMonteCarlo filter(maps_, setup_.kld, setup_.filter, setup_.options, PoseRegion(box));
    filter.start(PoseRegion({-2, -2, -2, -2, 0, 0}), 1000);
    return filter;
  }

  void stand(PlanarMonteCarlo& filter, int updates) {
    const auto frame = someObservation();
    const auto action = movement(0, 0);
    for (int i = 0; i < updates; ++i) {
      if (camera_) camera_->matches = i % 2 ? 20 : 100;
      std::vector<PoseMode> modes;
      if (camera_ && !blank_) modes.push_back(mode(truth_, 0.1));
      filter.update(&action, &frame, modes);
    }
  }

  double distanceTo(const PlanarMonteCarlo& filter, const PlanarPose& place) const {
    const PlanarPose found = dominantCluster(filter).robot_in_map;
    return std::hypot(found.x - place.x, found.y - place.y);
  }

  FilterSetup setup_;
  mrpt::maps::CMultiMetricMap::Ptr maps_ = mrpt::maps::CMultiMetricMap::Create();
  std::shared_ptr<FakeCameraMap> camera_;
  PlanarPose truth_{-2, -2, 0};
  bool blank_ = false;
};

// One random particle of 80 lies near enough. The share of random ones is half of 1000 after ten updates, so that the
// chance to miss in the next thirty is far below 1e-9.
TEST_P(Kidnapping, RecoveryFindsTheRobotAgain) {
  auto filter = make();
  stand(filter, 20);
  EXPECT_LT(distanceTo(filter, truth_), 0.3);
  truth_ = {2, 2, 0};
  stand(filter, 40);
  EXPECT_LT(distanceTo(filter, truth_), 0.3);
}

TEST_P(Kidnapping, WithoutRecoveryTheRobotStaysLost) {
  setup_.options.recovery_alpha_fast = 0;
  auto filter = make();
  stand(filter, 20);
  truth_ = {2, 2, 0};
  stand(filter, 40);
  EXPECT_GT(distanceTo(filter, truth_), 3);
}

TEST_P(Kidnapping, NobodyIsReplacedWhileAllIsWell) {
  auto filter = make();
  const auto frame = someObservation();
  for (int i = 0; i < 20; ++i) {
    if (camera_) camera_->matches = i % 2 ? 20 : 100;
    filter.update(nullptr, &frame);
    EXPECT_EQ(weightWhere(filter, [&](const PlanarPose& p) { return std::hypot(p.x + 2, p.y + 2) > 1e-6; }), 0);
  }
}

// Were images compared with those before alone, the mean match would fall from 2 to -0.3 and most particles be
// replaced, as for a laser. A few are, for the particles' noise.
TEST_P(Kidnapping, ABlankWallTellsTheCameraNothingOfBeingLost) {
  auto filter = make();
  stand(filter, 20);
  blank_ = true;
  stand(filter, 10);
  const double elsewhere = weightWhere(filter, [&](const PlanarPose& p) { return std::hypot(p.x + 2, p.y + 2) > 1; });
  if (camera_)
    EXPECT_LT(elsewhere, 0.1);
  else
    EXPECT_GT(elsewhere, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Sensors, Kidnapping, ::testing::Values(Sensor::camera, Sensor::laser),
                         [](const auto& sensor) { return sensor.param == Sensor::camera ? "camera" : "laser"; });

}  // namespace
}  // namespace vmcl
