// SPDX-License-Identifier: BSD-3-Clause
// What a user of AMCL does, on a Localizer with AMCL's options.
#include <gtest/gtest.h>

#include "localizer_setup.h"
#include "scratch_directory.h"

namespace vmcl {
namespace {

/// That fits at x, y within about 0.3 m.
std::shared_ptr<FakeMap> mapThatFitsAt(double x, double y) {
  return std::make_shared<FakeMap>(
      [=](const PlanarPose& p) { return -10 * std::min(1.0, (p.x - x) * (p.x - x) + (p.y - y) * (p.y - y)); });
}

PoseWithCovariance near(const PlanarPose& pose, double deviation = 0.1) {
  PoseWithCovariance known{pose, Eigen::Matrix3d::Zero()};
  known.covariance.diagonal().setConstant(deviation * deviation);
  return known;
}

mrpt::obs::CSensoryFrame seenAt(double time) {
  mrpt::obs::CSensoryFrame frame;
  frame.insert(commentAt(time));
  return frame;
}

class AmclWorkflow : public ::testing::Test {
 protected:
  void start(const std::shared_ptr<FakeMap>& map, const LocalizerOptions& how = amclOptions()) {
    localizer_.emplace(how);
    localizer_->setMap(mapsWith(map), box);
    localizer_->setInitialPose(near({0, 0, 0}));
  }

  std::optional<LocalizationFrame> move(const PlanarPose& movement) {
    return localizer_->process(movement, seenAt(time_ += 1));
  }

  std::optional<Localizer> localizer_;
  double time_ = 0;
};

TEST_F(AmclWorkflow, NothingHappensBeforeAStart) {
  localizer_.emplace(amclOptions());
  EXPECT_FALSE(move({}));
  localizer_->setMap(mapsWith(flatMap()), box);
  EXPECT_FALSE(move({}));
  EXPECT_EQ(localizer_->health().status, LocalizationStatus::uninitialized);
  EXPECT_TRUE(localizer_->clusters().empty());
  EXPECT_THROW(localizer_->estimate(), std::logic_error);
}

/// 2000 particles: the mean is known to 2 % of the deviation, a variance to 3 %; 5.5 of each, false alarm 2e-7.
TEST_F(AmclWorkflow, InitialPoseWithCovariance) {
  start(flatMap());
  PoseWithCovariance given = near({1, -2, 3.1}, 0.2);
  given.covariance(0, 1) = given.covariance(1, 0) = 0.02;
  localizer_->setInitialPose(given);
  const PoseWithCovariance pose = localizer_->estimate();
  EXPECT_LT(difference(pose.robot_in_map, given.robot_in_map).cwiseAbs().maxCoeff(), 0.025);
  EXPECT_LT((pose.covariance - given.covariance).cwiseAbs().maxCoeff(), 0.007);
  EXPECT_EQ(localizer_->health().status, LocalizationStatus::uninitialized);
}

/// Of 2000 particles nine start within 0.3 m of the place, none with a chance of 1.5e-4.
TEST_F(AmclWorkflow, GlobalLocalizationOnRequest) {
  start(mapThatFitsAt(3, 3));
  move({});
  EXPECT_LT(localizer_->estimate().robot_in_map.x, 2);
  localizer_->globalLocalization();
  move({});
  const PlanarPose found = localizer_->estimate().robot_in_map;
  EXPECT_LT(std::hypot(found.x - 3, found.y - 3), 0.3);
}

TEST_F(AmclWorkflow, UpdatesOnceTheRobotHasMovedEnough) {
  start(flatMap());
  EXPECT_TRUE(move({}));  // the first observation
  EXPECT_FALSE(move({}));
  EXPECT_FALSE(move({0.2, 0, 0}));
  EXPECT_NEAR(localizer_->estimate().robot_in_map.x, 0.2, 0.02);  // known all the same
  EXPECT_TRUE(move({0.1, 0, 0}));                                 // 0.3 m together
  EXPECT_FALSE(move({0.1, 0, 0.1}));
  EXPECT_TRUE(move({0, 0, 0.15}));  // 0.25 rad together
  EXPECT_NEAR(localizer_->estimate().robot_in_map.x, 0.4, 0.02);
}

/// Images that fit come ten times a second and are not used, as the robot does not move.
TEST_F(AmclWorkflow, ARobotThatStandsStillStaysTracked) {
  const auto fits = [](const PlanarPose& p) { return 0.7 * std::exp(-p.x * p.x / 0.1) - 0.2; };
  start(std::make_shared<FakeCameraMap>(fits));
  const auto stand = [&](int steps, bool seeing) {
    for (int i = 0; i < steps; ++i) {
      time_ += 0.1;
      localizer_->step(nullptr, nullptr, odometry(0, time_));
      if (seeing) localizer_->step(nullptr, nullptr, commentAt(time_));
    }
    return localizer_->health().status;
  };
  for (int i = 0; i < 3; ++i) {
    localizer_->requestNoMotionUpdate();
    stand(1, true);
  }
  EXPECT_EQ(stand(50, true), LocalizationStatus::tracking);
  EXPECT_EQ(stand(15, false), LocalizationStatus::degraded);
}

TEST_F(AmclWorkflow, AnywhereNeedsAMapThatTellsWhereThatIs) {
  localizer_.emplace(amclOptions());
  localizer_->setMap(mapsWith(flatMap()));
  EXPECT_THROW(localizer_->globalLocalization(), std::logic_error);
  EXPECT_FALSE(move({}));
}

TEST_F(AmclWorkflow, NoMotionUpdateOnRequest) {
  start(flatMap());
  move({});
  localizer_->requestNoMotionUpdate();
  EXPECT_TRUE(move({}));
  EXPECT_FALSE(move({}));
}

// A scan and an image of one place are both news, in whatever order and steps they come.
TEST_F(AmclWorkflow, EachSensorIsUsedOnceTheRobotHasMovedEnough) {
  start(flatMap());
  const auto seenBy = [&](const std::string& sensor, const PlanarPose& movement) {
    const auto observation = commentAt(time_ += 0.001);
    observation->sensorLabel = sensor;
    mrpt::obs::CSensoryFrame frame;
    frame.insert(observation);
    return localizer_->process(movement, frame).has_value();
  };
  for (int place = 0; place < 3; ++place) {
    EXPECT_TRUE(seenBy("laser", {0.3, 0, 0}));
    EXPECT_TRUE(seenBy("camera", {}));
    EXPECT_FALSE(seenBy("laser", {0.1, 0, 0}));
    EXPECT_FALSE(seenBy("camera", {0.1, 0, 0}));
  }
}

/// Noise that grows with the square of the way must not depend on how often the movement is read. Of 2000 particles the
/// deviation is known to 1.6 %, of which 10 % are six: false alarm 1e-9.
TEST_F(AmclWorkflow, OdometryNoiseDoesNotDependOnItsRate) {
  LocalizerOptions noisy = amclOptions();
  noisy.monte_carlo.motion_model->alpha3 = 0.01;  // 0.1 m on 1 m
  noisy.update_min_d = 0.95;
  const auto deviation = [&](int steps) {
    start(flatMap(), noisy);
    localizer_->setInitialPose(near({0, 0, 0}, 0));
    move({});
    for (int i = 0; i < steps; ++i) move({1.0 / steps, 0, 0});
    return std::sqrt(localizer_->estimate().covariance(0, 0));
  };
  EXPECT_NEAR(deviation(1), 0.1, 0.01);
  EXPECT_NEAR(deviation(20), 0.1, 0.01);
}

double effectiveShareAfter(const LocalizationFrame& frame, const Localizer& localizer) {
  double squares = 0, sum = 0;
  for (const auto& particle : localizer.particles().m_particles) {
    sum += std::exp(particle.log_w);
    squares += std::exp(2 * particle.log_w);
  }
  return sum * sum / squares / frame.particles;
}

TEST_F(AmclWorkflow, ResampleInterval) {
  LocalizerOptions every_third = amclOptions();
  every_third.monte_carlo.amcl_resampling->resample_interval = 3;
  every_third.update_min_d = every_third.update_min_a = 0;
  start(mapThatFitsAt(0.2, 0), every_third);
  for (int i = 1; i <= 6; ++i) {
    const auto frame = move({});
    EXPECT_EQ(effectiveShareAfter(*frame, *localizer_) > 0.999, i % 3 == 0) << i;
  }
}

TEST_F(AmclWorkflow, SelectiveResampling) {
  LocalizerOptions selective = amclOptions();
  selective.monte_carlo.amcl_resampling->selective_resampling = true;
  selective.update_min_d = selective.update_min_a = 0;
  start(mapThatFitsAt(0.05, 0), selective);
  EXPECT_LT(effectiveShareAfter(*move({}), *localizer_), 0.999);  // tells too little to resample
  start(mapThatFitsAt(0.5, 0), selective);
  localizer_->setInitialPose(near({0, 0, 0}, 0.5));
  EXPECT_GT(effectiveShareAfter(*move({}), *localizer_), 0.999);
}

TEST_F(AmclWorkflow, ParticlesBetweenMinAndMax) {
  LocalizerOptions few = amclOptions();
  few.kld.KLD_minSampleSize = 200;
  start(mapThatFitsAt(0, 0), few);
  localizer_->globalLocalization();
  EXPECT_EQ(localizer_->particles().particlesCount(), 2000U);
  move({});
  for (int i = 0; i < 5; ++i) move({0.3, 0, 0});
  localizer_->setMap(mapsWith(mapThatFitsAt(1.5, 0)), box);
  int particles = 0;
  for (int i = 0; i < 6; ++i) {
    localizer_->requestNoMotionUpdate();
    particles = move({})->particles;
  }
  EXPECT_LT(particles, 1000);
  EXPECT_GE(particles, 200);
}

TEST_F(AmclWorkflow, TheMapMayChangeWhileRunning) {
  start(mapThatFitsAt(0.3, 0));
  move({});
  EXPECT_NEAR(localizer_->estimate().robot_in_map.x, 0.3, 0.3);
  const auto before = numbersOf(localizer_->particles());
  localizer_->setMap(mapsWith(mapThatFitsAt(-0.3, 0)), box);
  EXPECT_EQ(numbersOf(localizer_->particles()), before);
  for (int i = 0; i < 10; ++i) {
    localizer_->requestNoMotionUpdate();
    move({0, 0, 0.05});
  }
  EXPECT_LT(localizer_->estimate().robot_in_map.x, 0.1);
}

/// Drawn anew, 2000 particles have the covariance to 3 %; 20 % are six of that, false alarm 1e-9.
TEST_F(AmclWorkflow, PoseAndCovarianceAreSavedAndRestored) {
  start(mapThatFitsAt(0.2, 0.1));
  move({});
  const PoseWithCovariance before = localizer_->estimate();
  const ScratchDirectory scratch;
  savePose(scratch.path() / "pose.yaml", before);
  start(flatMap());
  localizer_->setInitialPose(loadPose(scratch.path() / "pose.yaml"));
  const PoseWithCovariance after = localizer_->estimate();
  EXPECT_LT(difference(after.robot_in_map, before.robot_in_map).norm(), 0.03);
  EXPECT_NEAR(after.covariance(0, 0) / before.covariance(0, 0), 1, 0.2);
}

/// About nine of 2000 particles start at each place. The likelier one would come second if it got seven times fewer of
/// them, with a chance of 2e-3, or either none.
TEST_F(AmclWorkflow, ClustersAndTheBestOnesCovariance) {
  start(std::make_shared<FakeMap>([](const PlanarPose& p) {  // two places, one likelier by e
    return std::hypot(p.x - 3, p.y) < 0.3 ? 6 : std::hypot(p.x + 3, p.y) < 0.3 ? 5 : -5;
  }));
  localizer_->globalLocalization();
  move({});
  localizer_->requestNoMotionUpdate();
  move({});
  const auto clusters = localizer_->clusters();
  ASSERT_GE(clusters.size(), 2U);
  EXPECT_GT(clusters[0].robot_in_map.x, 2);
  for (std::size_t i = 2; i < clusters.size(); ++i) EXPECT_LE(clusters[i].share, clusters[i - 1].share);
  EXPECT_LT(localizer_->estimate().covariance(0, 0), 0.1);  // of the one cluster, not of all
}

TEST_F(AmclWorkflow, RefusesBadOptions) {
  const auto refuses = [](auto&& change) {
    LocalizerOptions bad = amclOptions();
    change(bad);
    EXPECT_THROW(Localizer{bad}, std::invalid_argument);
  };
  refuses([](LocalizerOptions& o) { o.particles_count = 0; });
  refuses([](LocalizerOptions& o) { o.update_min_d = -1; });
  refuses([](LocalizerOptions& o) { o.update_min_a = std::nan(""); });
  refuses([](LocalizerOptions& o) { o.monte_carlo.amcl_resampling->resample_interval = 0; });
  refuses([](LocalizerOptions& o) { o.monte_carlo.motion_model->alpha1 = -1; });
  refuses([](LocalizerOptions& o) { o.kld.KLD_maxSampleSize = 0; });
  refuses([](LocalizerOptions& o) { o.filter.powFactor = -1; });
  refuses([](LocalizerOptions& o) { o.health.lost_after = 0; });
}

}  // namespace
}  // namespace vmcl
