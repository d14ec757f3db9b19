// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/localizer.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include "localizer_setup.h"

namespace vmcl {
namespace {

using mrpt::obs::CObservation;

TEST(Localizer, FollowsTheOdometryOfSingleObservations) {
  Localizer localizer(trackingConfig(), mapsWith(flatMap()));
  EXPECT_FALSE(localizer.step(nullptr, nullptr, odometry(5)));
  EXPECT_FALSE(localizer.step(nullptr, nullptr, odometry(6)));  // before the first observation: the start is there
  const auto first = localizer.step(nullptr, nullptr, commentAt(10));
  ASSERT_TRUE(first);
  EXPECT_DOUBLE_EQ(first->time, 10);
  EXPECT_NEAR(first->cluster.robot_in_map.x, 1, 1e-9);
  localizer.step(nullptr, nullptr, odometry(6.25));
  localizer.step(nullptr, nullptr, odometry(6.5));
  const auto second = localizer.step(nullptr, nullptr, commentAt(11));
  ASSERT_TRUE(second);
  EXPECT_NEAR(second->cluster.robot_in_map.x, 1.5, 0.02);
  EXPECT_NEAR(second->cluster.robot_in_map.y, 2, 0.02);
}

TEST(Localizer, KeepsTheOdometryAcrossObservationsOfNoUse) {
  Localizer localizer(trackingConfig(), mapsWith(flatMap()));
  localizer.step(nullptr, nullptr, odometry(0));
  localizer.step(nullptr, nullptr, commentAt(0));
  localizer.step(nullptr, nullptr, odometry(0.5));
  EXPECT_FALSE(localizer.step(nullptr, nullptr, mrpt::obs::CObservation2DRangeScan::Create()));
  const auto frame = localizer.step(nullptr, nullptr, commentAt(1));
  ASSERT_TRUE(frame);
  EXPECT_NEAR(frame->cluster.robot_in_map.x, 1.5, 0.02);
}

TEST(Localizer, TakesPairsOfActionsAndFrames) {
  Localizer localizer(trackingConfig(), mapsWith(flatMap()));
  const auto action = std::make_shared<mrpt::obs::CActionCollection>(movement(0.3, 0));
  const auto first = localizer.step(action, someFrame(), nullptr);  // the start is where the first frame was taken
  ASSERT_TRUE(first);
  EXPECT_NEAR(first->cluster.robot_in_map.x, 1, 1e-9);
  EXPECT_NEAR(localizer.step(action, someFrame(), nullptr)->cluster.robot_in_map.x, 1.3, 0.02);
}

TEST(Localizer, SkipsTheOffset) {
  LocalizationConfig config = trackingConfig();
  config.rawlog_offset = 2;
  Localizer localizer(config, mapsWith(flatMap()));
  EXPECT_FALSE(localizer.step(nullptr, nullptr, commentAt(0)));
  EXPECT_FALSE(localizer.step(nullptr, nullptr, commentAt(1)));
  EXPECT_TRUE(localizer.step(nullptr, nullptr, commentAt(2)));
}

TEST(Localizer, IsLocalizedAfterSharpFramesInARow) {
  Localizer sharp(trackingConfig(), mapsWith(flatMap()));
  EXPECT_FALSE(sharp.step(nullptr, nullptr, commentAt(0))->localized);
  EXPECT_TRUE(sharp.step(nullptr, nullptr, commentAt(1))->localized);
  LocalizationConfig config = trackingConfig();
  config.start = {0, 5, 0, 5};
  Localizer spread(config, mapsWith(flatMap()));
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(spread.step(nullptr, nullptr, commentAt(i))->localized);
}

// Two places look alike but for one step, which carries the cluster from one to the other.
TEST(Localizer, IsNotLocalizedRightAfterAJump) {
  LocalizationConfig config = trackingConfig();
  config.start = {1, 3, 2, 2, 0, 0};
  config.particles_count = 2000;
  config.localized.max_position_deviation = 0.5;
  double place = 1;
  const auto map = std::make_shared<FakeMap>(
      [&](const PlanarPose& pose) { return std::max(-10.0, -50 * (pose.x - place) * (pose.x - place)); });
  Localizer jumping(config, mapsWith(map));
  jumping.step(nullptr, nullptr, commentAt(0));
  place = 3;  // the few particles left there take over
  for (int i = 1; i < 4; ++i) {
    const auto frame = jumping.step(nullptr, nullptr, commentAt(i));
    if (frame->cluster.robot_in_map.x < 2) continue;
    EXPECT_FALSE(frame->localized);
    EXPECT_TRUE(jumping.step(nullptr, nullptr, commentAt(i + 1))->localized);
    return;
  }
  FAIL() << "the cluster did not jump";
}

TEST(Localizer, DoesNotFollowTheOdometryThroughAKidnapping) {
  Localizer localizer(trackingConfig(), mapsWith(flatMap()));
  localizer.step(nullptr, nullptr, odometry(0));
  localizer.step(nullptr, nullptr, commentAt(0));
  localizer.step(nullptr, nullptr, odometry(0.5));
  localizer.kidnap();
  localizer.step(nullptr, nullptr, odometry(7));
  localizer.step(nullptr, nullptr, odometry(7.25));
  EXPECT_NEAR(localizer.step(nullptr, nullptr, commentAt(1))->cluster.robot_in_map.x, 1.75, 0.02);
}

TEST(Localizer, ByOdometryOnlyItWeighsNothing) {
  LocalizationConfig config = trackingConfig();
  config.odometry_only = true;
  const auto strict = std::make_shared<FakeMap>([](const PlanarPose& pose) { return pose.x > 1 ? -100 : 0; });
  Localizer localizer(config, mapsWith(strict));
  localizer.step(nullptr, nullptr, odometry(0));
  localizer.step(nullptr, nullptr, commentAt(0));
  localizer.step(nullptr, nullptr, odometry(0.5));
  const auto frame = localizer.step(nullptr, nullptr, commentAt(1));
  ASSERT_TRUE(frame);
  EXPECT_NEAR(frame->cluster.robot_in_map.x, 1.5, 0.02);
  EXPECT_EQ(frame->effective_share, 1);
}

// The map tells of no more room than the box where the particles would start, but of any heading.
TEST(Localizer, MayStartAnywhereInTheMap) {
  LocalizationConfig config = trackingConfig();
  config.start_anywhere = true;
  EXPECT_THROW(Localizer(config, mapsWith(flatMap())), std::logic_error);
  config.start = {0, 2, 1, 3, 0, 0};
  const Localizer localizer(config, mapsWith(flatMap()));
  double greatest = 0;
  for (const auto& particle : localizer.particles().m_particles)
    greatest = std::max(greatest, std::abs(particle.d.phi));
  EXPECT_GT(greatest, 2.5);  // of 200 particles; false alarm (2.5 / pi)^200 = 1e-20
}

TEST(Localizer, SameSeedSameFrames) {
  const auto run = [] {
    Localizer localizer(trackingConfig(), mapsWith(flatMap()));
    for (int i = 0; i < 5; ++i) {
      localizer.step(nullptr, nullptr, odometry(0.1 * i));
      localizer.step(nullptr, nullptr, commentAt(i));
    }
    return numbersOf(localizer.particles());
  };
  EXPECT_EQ(run(), run());
}

mrpt::obs::CActionCollection::Ptr movementInSpace(double x) {
  mrpt::obs::CActionRobotMovement3D movement;
  movement.poseChange.mean = mrpt::poses::CPose3D(x, 0, 0);
  movement.poseChange.cov = mrpt::math::CMatrixDouble66(Eigen::Matrix<double, 6, 6>::Identity() * 1e-6);
  auto actions = mrpt::obs::CActionCollection::Create();
  actions->insert(movement);
  return actions;
}

// A cluster that moves otherwise than the odometry says never counts as localized.
TEST(Localizer, FollowsMovementsInSpace) {
  Localizer localizer(trackingConfig(), mapsWith(flatMap()));
  for (int i = 0; i < 3; ++i) {
    const auto result = localizer.step(movementInSpace(1), someFrame(), nullptr);
    EXPECT_NEAR(result->cluster.robot_in_map.x, 1 + i, 0.02);
    EXPECT_EQ(result->localized, i > 0);
  }
}

TEST(Localizer, LeavesOutMovementsThatAreNone) {
  Localizer localizer(trackingConfig(), mapsWith(flatMap()));
  localizer.step(nullptr, someFrame(), nullptr);
  for (const double x : {1e300, 1e4, std::nan("")})
    for (const auto& action : {movementInSpace(x), std::make_shared<mrpt::obs::CActionCollection>(movement(x, 0))}) {
      EXPECT_NEAR(localizer.step(action, someFrame(), nullptr)->cluster.robot_in_map.x, 1, 0.02);
      EXPECT_EQ(localizer.takeProblems().size(), 1U) << x;
    }
}

TEST(Localizer, LeavesOutMovementsWithoutAPose) {
  Localizer localizer(trackingConfig(), mapsWith(flatMap()));
  localizer.step(nullptr, someFrame(), nullptr);
  const auto action = std::make_shared<mrpt::obs::CActionCollection>(movement(0.5, 0));
  action->getActionByClass<mrpt::obs::CActionRobotMovement2D>()->poseChange.reset();
  const auto frame = localizer.step(action, someFrame(), nullptr);
  ASSERT_TRUE(frame);
  EXPECT_NEAR(frame->cluster.robot_in_map.x, 1, 0.02);
  EXPECT_EQ(localizer.takeProblems().size(), 1U);
}

TEST(Localizer, LeavesOutJumpsOfTheOdometry) {
  Localizer localizer(trackingConfig(), mapsWith(flatMap()));
  localizer.step(nullptr, nullptr, odometry(0));
  localizer.step(nullptr, nullptr, commentAt(0));
  localizer.step(nullptr, nullptr, odometry(0.25));
  for (const double x : {1e300, 0.0, -1e4}) {
    localizer.step(nullptr, nullptr, odometry(x));
    EXPECT_EQ(localizer.takeProblems(), std::vector<std::string>{"odometry '': a jump of more than 1000 m"}) << x;
  }
  localizer.step(nullptr, nullptr, odometry(-1e4 + 0.5));
  EXPECT_NEAR(localizer.step(nullptr, nullptr, commentAt(1))->cluster.robot_in_map.x, 1.75, 0.02);
}

TEST(Localizer, ItsSeedIsThatOfTheSamplesDrawnFromImages) {
  const auto camera = std::make_shared<FakeCameraMap>([](const PlanarPose&) { return 0; });
  LocalizationConfig config = trackingConfig();
  config.monte_carlo.seed = 7;
  Localizer(config, mapsWith(camera)).step(nullptr, nullptr, commentAt(0));
  EXPECT_EQ(camera->seeds, std::vector<uint64_t>{7});
}

TEST(Localizer, TellsWhereItIsExpectedWhileItTracks) {
  const auto camera = std::make_shared<FakeCameraMap>([](const PlanarPose&) { return 1; });
  LocalizationConfig config = trackingConfig();
  config.guided_updates = 2;
  Localizer localizer(config, mapsWith(camera));
  for (int i = 0; i < 9; ++i) {
    localizer.step(nullptr, nullptr, odometry(0.5 * i, i));
    localizer.step(nullptr, nullptr, commentAt(i));
  }
  std::vector<std::size_t> updates;  // it tracks from the second one on
  for (const auto& [update, pose] : camera->expected) {
    updates.push_back(update);
    EXPECT_NEAR(pose.x, 1 + 0.5 * static_cast<double>(update), 0.05);
  }
  EXPECT_EQ(updates, (std::vector<std::size_t>{2, 3, 5, 6, 8}));
}

TEST(Localizer, ExpectsNothingUnlessAskedTo) {
  const auto camera = std::make_shared<FakeCameraMap>([](const PlanarPose&) { return 1; });
  Localizer localizer(trackingConfig(), mapsWith(camera));
  for (int i = 0; i < 4; ++i) localizer.step(nullptr, nullptr, commentAt(i));
  EXPECT_TRUE(camera->expected.empty());
}

/// A camera's map to which every observation is broken.
class BrokenMap : public FakeCameraMap {
 public:
  BrokenMap() : FakeCameraMap([](const PlanarPose&) { return 0; }) {}
  PoseEstimate relocalize(const CObservation&, uint64_t) const override {
    throw std::runtime_error("camera 'front': no image");
  }
};

TEST(Localizer, NamesBrokenObservationsAndGoesOn) {
  Localizer localizer(trackingConfig(), mapsWith(std::make_shared<BrokenMap>()));
  EXPECT_FALSE(localizer.step(nullptr, nullptr, commentAt(0)));
  EXPECT_EQ(localizer.takeProblems(), std::vector<std::string>{"camera 'front': no image"});
  EXPECT_TRUE(localizer.takeProblems().empty());
}

TEST(Localizer, FreeSpaceNeedsAGrid) {
  LocalizationConfig config = trackingConfig();
  config.start_in_free_space = true;
  EXPECT_THROW(Localizer(config, mapsWith(flatMap())), std::invalid_argument);
}

}  // namespace
}  // namespace vmcl
