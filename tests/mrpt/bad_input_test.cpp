// SPDX-License-Identifier: BSD-3-Clause
// Whatever comes in: no crash, nothing that is not finite comes out, and the status says so.
#include <gtest/gtest.h>

#include "localizer_setup.h"

namespace vmcl {
namespace {

using enum LocalizationStatus;

/// An image that fits where the odometry says the robot is, at x = 1 + `travelled`, y = 2, facing 0, or nowhere when it
/// is `dark`.
class BadInput : public ::testing::Test {
 protected:
  BadInput() {
    config_.health.lost_reset_after = 0;
    localizer_.emplace(config_, mapsWith(camera_));
  }

  /// Anew, with AMCL's options.
  void beginLikeAmcl() {
    LocalizerOptions amcl = amclOptions();
    amcl.health.lost_reset_after = 0;
    localizer_.emplace(amcl);
    localizer_->setMap(mapsWith(camera_), box);
    localizer_->setInitialPose({{1, 2, 0}, 0.01 * Eigen::Matrix3d::Identity()});
    travelled_ = 0;
  }

  std::optional<LocalizationFrame> see() {
    const auto frame = localizer_->step(nullptr, nullptr, commentAt(time_));
    if (frame) expectFinite(*frame);
    return frame;
  }

  /// A tenth of a second later.
  mrpt::obs::CSensoryFrame seen() {
    mrpt::obs::CSensoryFrame frame;
    frame.insert(commentAt(time_ += 0.1));
    return frame;
  }

  /// Drives on with odometry, and sees, ten times a second.
  LocalizationStatus drive(int steps) {
    for (int i = 0; i < steps; ++i) {
      time_ += 0.1;
      travelled_ += 0.05;
      localizer_->step(nullptr, nullptr, odometry(travelled_, time_));
      see();
    }
    return localizer_->health().status;
  }

  void expectFinite(const LocalizationFrame& frame) {
    EXPECT_TRUE(isFinite(frame.cluster.robot_in_map));
    EXPECT_TRUE(frame.cluster.covariance.allFinite());
    for (const auto& particle : localizer_->particles().m_particles)
      EXPECT_TRUE(std::isfinite(particle.d.x + particle.d.y + particle.d.phi + particle.log_w));
  }

  double error() const { return std::abs(localizer_->estimate().robot_in_map.x - 1 - travelled_); }

  LocalizationConfig config_ = trackingConfig();
  double time_ = 100;
  double travelled_ = 0;
  bool dark_ = false;
  std::shared_ptr<FakeCameraMap> camera_ = std::make_shared<FakeCameraMap>([this](const PlanarPose& pose) {
    const double off = std::hypot(pose.x - 1 - travelled_, pose.y - 2, pose.phi);
    return dark_ ? -0.01 : 0.7 * std::exp(-off * off / 0.1) - 0.2;
  });
  std::optional<Localizer> localizer_;
};

TEST_F(BadInput, AllIsWellWithoutAny) {
  EXPECT_EQ(drive(10), tracking);
  EXPECT_TRUE(localizer_->takeProblems().empty());
  EXPECT_LT(error(), 0.1);
}

TEST_F(BadInput, OdometryThatJumps) {
  drive(10);
  for (const double jump : {5.0, 1e5, -1e300}) {
    localizer_->step(nullptr, nullptr, odometry(travelled_ + jump, time_ += 0.01));
    localizer_->step(nullptr, nullptr, odometry(travelled_, time_ += 0.01));
    EXPECT_EQ(localizer_->takeProblems().size(), 2U) << jump;
    EXPECT_EQ(drive(5), tracking) << jump;
    EXPECT_LT(error(), 0.1) << jump;
  }
}

TEST_F(BadInput, OdometryThatStops) {
  for (const bool like_amcl : {false, true}) {
    if (like_amcl) beginLikeAmcl();
    drive(20);
    for (int i = 0; i < 10; ++i) {
      time_ += 0.1;
      travelled_ += 0.05;
      see();
    }
    EXPECT_EQ(localizer_->health().status, degraded);
    EXPECT_EQ(localizer_->takeProblems(), std::vector<std::string>{"the odometry has stopped"});
    EXPECT_LT(error(), 0.3);  // followed by sight
    EXPECT_EQ(drive(20), tracking);
  }
}

TEST_F(BadInput, OdometryThatIsNotFinite) {
  drive(10);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    localizer_->step(nullptr, nullptr, odometry(bad, time_ + 0.05));
    EXPECT_EQ(localizer_->takeProblems().size(), 1U);
  }
  EXPECT_EQ(drive(5), tracking);
  mrpt::obs::CSensoryFrame frame;
  frame.insert(commentAt(time_ + 0.1));
  localizer_->process(PlanarPose{std::nan(""), 0, 0}, frame);
  EXPECT_EQ(localizer_->takeProblems().size(), 1U);
  EXPECT_TRUE(isFinite(localizer_->estimate().robot_in_map));
}

TEST_F(BadInput, OdometryOutOfOrder) {
  drive(10);
  localizer_->step(nullptr, nullptr, odometry(travelled_ - 0.5, time_ - 1));
  EXPECT_EQ(localizer_->takeProblems().size(), 1U);
  EXPECT_EQ(drive(5), tracking);
  EXPECT_LT(error(), 0.1);
}

TEST_F(BadInput, ObservationsTwiceOrOutOfOrder) {
  drive(10);
  const auto before = numbersOf(localizer_->particles());
  EXPECT_FALSE(see());
  EXPECT_FALSE(localizer_->step(nullptr, nullptr, commentAt(time_ - 0.35)));
  EXPECT_EQ(localizer_->takeProblems(), std::vector<std::string>(2, "sensor '': an observation twice or out of order"));
  EXPECT_EQ(numbersOf(localizer_->particles()), before);
  time_ -= 3600;  // a clock set anew
  EXPECT_EQ(drive(10), tracking);
}

TEST_F(BadInput, ACameraThatSeesNothing) {
  drive(10);
  dark_ = true;
  EXPECT_EQ(drive(15), degraded);
  EXPECT_EQ(drive(200), degraded);
  EXPECT_LT(error(), 0.5);
  dark_ = false;
  EXPECT_EQ(drive(10), tracking);
}

TEST_F(BadInput, ACameraThatVanishes) {
  drive(10);
  int frames = 0;
  for (int i = 0; i < 50; ++i) {
    time_ += 0.1;
    travelled_ += 0.05;
    if (const auto frame = localizer_->step(nullptr, nullptr, odometry(travelled_, time_))) {
      ++frames;
      expectFinite(*frame);
      EXPECT_EQ(frame->health.status, degraded);
      EXPECT_NEAR(frame->cluster.robot_in_map.x, 1 + travelled_, 0.2);
    }
  }
  EXPECT_NEAR(frames, 4, 1);  // one a second
  EXPECT_EQ(drive(10), tracking);
}

/// The status must not stay what it was, with odometry or without.
TEST_F(BadInput, AMapThatThrowsOrGivesNoNumber) {
  enum { fine, none, throws } map_is = fine;
  const auto map = std::make_shared<FakeMap>([&](const PlanarPose& pose) {
    if (map_is == throws) throw std::runtime_error("the map is broken");
    return map_is == none ? std::nan("") : -std::abs(pose.x - 1);
  });
  localizer_->setMap(mapsWith(map), box);
  for (const auto broken : {none, throws}) {
    map_is = fine;
    for (int i = 0; i < 5; ++i) localizer_->process(PlanarPose{}, seen());
    EXPECT_EQ(localizer_->health().status, tracking);
    map_is = broken;
    const auto before = numbersOf(localizer_->particles());
    for (int i = 0; i < 15; ++i) EXPECT_FALSE(localizer_->process(nullptr, seen()));
    EXPECT_EQ(localizer_->takeProblems().size(), 15U);
    EXPECT_EQ(numbersOf(localizer_->particles()), before);
    EXPECT_EQ(localizer_->health().status, degraded);
  }
}

/// It weighs the particles, but nothing anywhere else.
TEST_F(BadInput, AMapThatThrowsWhileThePoseIsJudged) {
  int asked = 0;
  const auto map = std::make_shared<FakeMap>([&](const PlanarPose&) {
    if (++asked % 201 == 0) throw std::runtime_error("the map is broken");
    return 0;
  });
  config_.start = {0, 2, 1, 3, 0, 0};
  localizer_.emplace(config_, mapsWith(map));
  localizer_->setInitialPose({{1, 2, 0}, Eigen::Matrix3d::Zero()});
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(localizer_->process(nullptr, seen()));
  EXPECT_EQ(localizer_->takeProblems().size(), 5U);
  EXPECT_EQ(localizer_->health().status, searching);
}

TEST_F(BadInput, AnInitialPoseOffTheMap) {
  localizer_->setMap(mapsWith(camera_), box);
  localizer_->setInitialPose({{1000, 0, 0}, 0.01 * Eigen::Matrix3d::Identity()});
  ASSERT_EQ(localizer_->takeProblems().size(), 1U);
  EXPECT_EQ(drive(10), searching);
}

TEST_F(BadInput, AnInitialPoseThatIsNone) {
  const Eigen::Matrix3d fine = Eigen::Matrix3d::Identity(), nan = std::nan("") * fine, negative = -fine;
  EXPECT_THROW(localizer_->setInitialPose({{std::nan(""), 0, 0}, fine}), std::invalid_argument);
  EXPECT_THROW(localizer_->setInitialPose({{1e30, 0, 0}, fine}), std::invalid_argument);
  EXPECT_THROW(localizer_->setInitialPose({{}, nan}), std::invalid_argument);
  EXPECT_THROW(localizer_->setInitialPose({{}, negative}), std::invalid_argument);
  EXPECT_EQ(drive(10), tracking);  // where it was
}

TEST_F(BadInput, NoParticles) {
  config_.particles_count = 0;
  EXPECT_THROW(Localizer(config_, mapsWith(camera_)), std::invalid_argument);
}

TEST_F(BadInput, EmptyFramesAndActions) {
  drive(10);
  EXPECT_FALSE(localizer_->step(nullptr, nullptr, nullptr));
  EXPECT_FALSE(localizer_->step(nullptr, mrpt::obs::CSensoryFrame::Create(), nullptr));
  EXPECT_FALSE(localizer_->process(nullptr, {}));
  EXPECT_EQ(drive(5), tracking);
}

/// Carried off: the images fit elsewhere, where nothing is injected.
TEST_F(BadInput, AKidnappedRobotIsNotTracked) {
  drive(10);
  travelled_ += 3;
  localizer_->kidnap();
  EXPECT_NE(drive(15), tracking);
}

}  // namespace
}  // namespace vmcl
