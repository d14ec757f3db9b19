// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/evaluation/run_measures.h"

#include <gtest/gtest.h>

#include "straight_drive.h"

namespace vmcl {
namespace {

/// An update each 0.5 s from 0 to 10 s, all right and localized, with deviations of 0.1 m and 0.1 rad.
std::vector<RunUpdate> goodRun() {
  std::vector<RunUpdate> run;
  for (int i = 0; i <= 20; ++i)
    run.push_back({{0.5 * i, true, {0.5 * i, 0, 0}}, 0.01 * Eigen::Matrix3d::Identity(), 100 + i});
  return run;
}

/// Carried from x = 2 m to 5 m, sees again from 5 s on, and is wrong from then until before `recovery`.
std::vector<RunUpdate> kidnappedRun(double recovery) {
  std::vector<RunUpdate> run = goodRun();
  run.erase(run.begin() + 4, run.begin() + 10);
  for (RunUpdate& update : run)
    if (update.estimate.time >= 5 && update.estimate.time < recovery) update.estimate.robot_in_map.x -= 3;
  return run;
}

TEST(RunMeasures, OfAGoodRun) {
  const RunMeasures measures = measureRun(goodRun(), straightDrive());
  EXPECT_EQ(measures.updates, 21);
  EXPECT_NEAR(measures.position_rmse.value(), 0, 1e-12);
  EXPECT_NEAR(measures.relative_position.value(), 0, 1e-12);
  EXPECT_EQ(measures.success, (std::array<double, 3>{1, 1, 1}));
  EXPECT_EQ(measures.time_to_converge, 0);
  EXPECT_EQ(measures.distance_to_converge, 0);
  EXPECT_EQ(measures.false_accept_share, 0);
  EXPECT_NEAR(measures.nees.value(), 0, 1e-12);
  EXPECT_DOUBLE_EQ(measures.particles, 110);
  EXPECT_DOUBLE_EQ(measures.lifelong.correct_rate, 1);
  EXPECT_TRUE(measures.found);
  EXPECT_FALSE(measures.recovery_time);
  EXPECT_FALSE(measures.notice_time);
  EXPECT_FALSE(measures.noticed);
  EXPECT_FALSE(measures.kidnapped_distance);
}

// 4 m beside the truth and not localized until 3 s, 0.3 m beside it at 3 s and 3.5 s, localized from 3 s on.
TEST(RunMeasures, OfASlowStart) {
  std::vector<RunUpdate> run = goodRun();
  for (int i = 0; i < 6; ++i) {
    run[i].estimate.localized = false;
    run[i].estimate.robot_in_map.y = 4;
  }
  run[6].estimate.robot_in_map.y = run[7].estimate.robot_in_map.y = 0.3;
  const RunMeasures measures = measureRun(run, straightDrive());
  EXPECT_NEAR(measures.success[0], 13.0 / 21, 1e-12);
  EXPECT_NEAR(measures.success[1], 15.0 / 21, 1e-12);
  EXPECT_NEAR(measures.success[2], 15.0 / 21, 1e-12);
  EXPECT_NEAR(measures.time_to_converge.value(), 4, 1e-9);
  EXPECT_NEAR(measures.distance_to_converge.value(), 4, 1e-9);
  EXPECT_NEAR(measures.position_rmse.value(), std::sqrt(2 * 0.09 / 15), 1e-12);
  EXPECT_NEAR(measures.nees.value(), 2 * 9.0 / 15, 1e-12);
}

TEST(RunMeasures, FalseAcceptsAreFarOffAndStoodBy) {
  std::vector<RunUpdate> run = goodRun();
  run[3].estimate.robot_in_map.y = 0.99;
  run[4].estimate.robot_in_map.y = 1.01;
  run[5].estimate.robot_in_map.phi = 14.9 * degree;
  run[6].estimate.robot_in_map.phi = 15.1 * degree;
  run[7].estimate.robot_in_map.y = 5;
  run[7].estimate.localized = false;
  EXPECT_NEAR(measureRun(run, straightDrive()).false_accept_share, 2.0 / 20, 1e-12);
}

TEST(RunMeasures, IsFoundWhenItConvergesInTimeAndIsRightAtTheEnd) {
  std::vector<RunUpdate> strays = goodRun(), late;
  strays.back().estimate.robot_in_map.y = 0.3;
  EXPECT_FALSE(measureRun(strays, straightDrive()).found);
  std::vector<StampedPose> still;
  for (int i = 0; i <= 80; ++i) {
    still.push_back({0.5 * i, toRigid3({})});
    late.push_back({{0.5 * i, i >= 61, {}}, Eigen::Matrix3d::Identity(), 1});
  }
  EXPECT_NEAR(measureRun(late, Trajectory(still)).time_to_converge.value(), 30.5, 1e-9);
  EXPECT_FALSE(measureRun(late, Trajectory(still)).found);
}

// Is lost by its own account at 6 s, and right from 7 s on.
TEST(RunMeasures, OfAKidnapping) {
  std::vector<RunUpdate> run = kidnappedRun(7);
  for (RunUpdate& update : run) update.lost = update.estimate.time == 6 || update.estimate.time == 1;
  const RunMeasures measures = measureRun(run, straightDrive(), Kidnapped{2, 5});
  EXPECT_NEAR(measures.notice_time.value(), 1, 1e-9);
  EXPECT_EQ(measures.noticed, true);
  EXPECT_NEAR(measures.kidnapped_distance.value(), 3, 1e-9);
  EXPECT_NEAR(measures.recovery_time.value(), 2, 1e-9);
  EXPECT_EQ(measures.time_to_converge, 0);
  EXPECT_NEAR(measures.false_accept_share, 4.0 / 15, 1e-12);
}

TEST(RunMeasures, ARobotThatStaysLostDoesNotRecover) {
  EXPECT_FALSE(measureRun(kidnappedRun(11), straightDrive(), Kidnapped{2, 5}).recovery_time);
}

TEST(RunMeasures, ANoticeMayComeTooLateOrNever) {
  std::vector<RunUpdate> run = kidnappedRun(11);
  EXPECT_EQ(measureRun(run, straightDrive(), Kidnapped{2, 5}).noticed, false);
  for (RunUpdate& update : run) update.lost = update.estimate.time >= 7.5;
  const RunMeasures measures = measureRun(run, straightDrive(), Kidnapped{2, 5});
  EXPECT_NEAR(measures.notice_time.value(), 2.5, 1e-9);
  EXPECT_EQ(measures.noticed, false);
}

TEST(RunMeasures, ARobotLostBeforeItIsKidnappedNoticesNothing) {
  std::vector<RunUpdate> run = kidnappedRun(7);
  for (RunUpdate& update : run)
    if (update.estimate.time >= 1 && update.estimate.time < 7) {
      update.estimate.localized = false;
      update.lost = true;
    }
  const RunMeasures measures = measureRun(run, straightDrive(), Kidnapped{2, 5});
  EXPECT_FALSE(measures.notice_time);
  EXPECT_FALSE(measures.noticed);
  EXPECT_NEAR(measures.recovery_time.value(), 2, 1e-9);
}

// Recovers at 5.5 s, and is lost at 6.5 s for another reason.
TEST(RunMeasures, ARobotLostAfterItRecoversHasNotNoticed) {
  std::vector<RunUpdate> run = kidnappedRun(5.5);
  for (RunUpdate& update : run) update.lost = update.estimate.time == 6.5;
  const RunMeasures measures = measureRun(run, straightDrive(), Kidnapped{2, 5});
  EXPECT_NEAR(measures.recovery_time.value(), 0.5, 1e-9);
  EXPECT_FALSE(measures.notice_time);
  EXPECT_EQ(measures.noticed, false);
}

TEST(RunMeasures, ARobotThatSearchesWhenItIsKidnappedHasNothingToNotice) {
  std::vector<RunUpdate> run = kidnappedRun(11);
  for (RunUpdate& update : run) update.estimate.localized = false;
  EXPECT_FALSE(measureRun(run, straightDrive(), Kidnapped{2, 5}).noticed);
}

TEST(RunMeasures, OfARunThatIsNeverLocalized) {
  std::vector<RunUpdate> run = goodRun();
  for (RunUpdate& update : run) update.estimate.localized = false;
  const RunMeasures measures = measureRun(run, straightDrive());
  EXPECT_FALSE(measures.position_rmse);
  EXPECT_FALSE(measures.relative_position);
  EXPECT_FALSE(measures.nees);
  EXPECT_FALSE(measures.time_to_converge);
  EXPECT_EQ(measures.success[0], 1);  // the reported pose is right all the same
}

TEST(RunMeasures, OfNoUpdate) { EXPECT_EQ(measureRun({}, straightDrive()).updates, 0); }

TEST(NormalizedSquaredError, WeighsByTheCovariance) {
  const Eigen::Matrix3d covariance = Eigen::Vector3d(4, 0.25, 0.01).asDiagonal();
  EXPECT_NEAR(normalizedSquaredError({3, 1, 0.1}, covariance, {1, 0, -0.1}).value(), 1 + 4 + 4, 1e-12);
  const double across_the_turn = normalizedSquaredError({0, 0, 3.14}, covariance, {0, 0, -3.14}).value();
  EXPECT_NEAR(across_the_turn, std::pow(2 * std::numbers::pi - 6.28, 2) / 0.01, 1e-9);
  EXPECT_FALSE(normalizedSquaredError({}, Eigen::Matrix3d::Zero(), {}));
}

TEST(DistanceAlong, ThePathBetweenTwoTimes) {
  const Trajectory corner({{0, toRigid3({0, 0, 0})}, {0.4, toRigid3({2, 0, 0})}, {0.8, toRigid3({2, 2, 0})}});
  EXPECT_NEAR(distanceAlong(corner, 0.2, 0.6), 2, 1e-12);
  EXPECT_NEAR(distanceAlong(corner, -5, 5), 4, 1e-12);
}

}  // namespace
}  // namespace vmcl
