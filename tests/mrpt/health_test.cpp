// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/health.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vmcl {
namespace {

using enum LocalizationStatus;

class HealthTest : public ::testing::Test {
 protected:
  HealthMonitor monitor_{HealthOptions{}};
  double time_ = 100;

  /// One more update, 0.1 s later.
  LocalizationStatus see(Verdict verdict, bool steady = true) {
    UpdateEvidence evidence{.time = time_ += 0.1, .steady = steady};
    evidence.count(verdict);
    return monitor_.update(evidence).status;
  }

  LocalizationStatus seeTimes(int times, Verdict verdict, bool steady = true) {
    for (int i = 1; i < times; ++i) see(verdict, steady);
    return see(verdict, steady);
  }
};

TEST_F(HealthTest, StartsUninitializedThenSearchesThenTracks) {
  EXPECT_EQ(monitor_.health().status, uninitialized);
  EXPECT_EQ(see(Verdict::agrees, false), searching);
  EXPECT_EQ(see(Verdict::agrees), tracking);
  monitor_.restart();
  EXPECT_EQ(monitor_.health().status, uninitialized);
}

TEST_F(HealthTest, IsDegradedWhenNothingConfirmsForASecond) {
  see(Verdict::agrees);
  EXPECT_EQ(seeTimes(9, Verdict::silent), tracking);
  EXPECT_EQ(seeTimes(3, Verdict::silent), degraded);
  EXPECT_NEAR(monitor_.health().unconfirmed_for, 1.2, 1e-9);
  EXPECT_EQ(seeTimes(300, Verdict::silent), degraded);  // dead reckoning is not being lost
  EXPECT_EQ(see(Verdict::agrees), tracking);
}

TEST_F(HealthTest, StandingStillNeedsNoConfirmation) {
  see(Verdict::agrees);
  monitor_.rest(30);
  time_ += 30;
  EXPECT_EQ(see(Verdict::silent), tracking);
  EXPECT_NEAR(monitor_.health().unconfirmed_for, 0.1, 1e-9);
}

TEST_F(HealthTest, IsDegradedByOneContradictionLostByThree) {
  see(Verdict::agrees);
  EXPECT_EQ(see(Verdict::contradicts), degraded);
  EXPECT_EQ(see(Verdict::silent), degraded);
  EXPECT_EQ(see(Verdict::contradicts), degraded);
  EXPECT_EQ(see(Verdict::contradicts), lost);
  EXPECT_EQ(see(Verdict::silent), lost);
  EXPECT_EQ(see(Verdict::agrees, false), lost);
  EXPECT_EQ(see(Verdict::agrees), tracking);
}

TEST_F(HealthTest, AnAgreementBetweenContradictionsKeepsItFromBeingLost) {
  see(Verdict::agrees);
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(seeTimes(2, Verdict::contradicts), degraded);
    EXPECT_EQ(see(Verdict::agrees), tracking);
  }
}

TEST_F(HealthTest, SensorsThatContradictEachOtherDoNotConfirm) {
  see(Verdict::agrees);
  LocalizationStatus status = tracking;
  for (int i = 0; i < 12; ++i) {
    UpdateEvidence both{.time = time_ += 0.1, .steady = true};
    both.count(Verdict::agrees);
    both.count(Verdict::contradicts);
    status = monitor_.update(both).status;
  }
  EXPECT_EQ(status, degraded);
}

TEST_F(HealthTest, IsLostByAJumpAndWhenTheParticlesScatter) {
  for (const bool jumped : {true, false}) {
    see(Verdict::agrees);
    UpdateEvidence evidence{.time = time_ += 0.1, .jumped = jumped, .scattered = !jumped};
    EXPECT_EQ(monitor_.update(evidence).status, lost);
  }
}

TEST_F(HealthTest, WhatWasNeverTrackedIsNotLost) {
  UpdateEvidence scattered{.time = 1, .scattered = true};
  EXPECT_EQ(monitor_.update(scattered).status, searching);
  EXPECT_EQ(seeTimes(10, Verdict::contradicts), searching);
}

TEST_F(HealthTest, WithoutOdometryNothingIsTracked) {
  see(Verdict::agrees);
  UpdateEvidence blind{.time = time_, .steady = true, .blind_motion = true};
  blind.count(Verdict::agrees);
  EXPECT_EQ(monitor_.update(blind).status, degraded);
}

TEST_F(HealthTest, OdometryAloneIsTrackedWhileTheClusterIsSteady) {
  EXPECT_EQ(seeTimes(100, Verdict::untestable), tracking);
  EXPECT_EQ(see(Verdict::untestable, false), degraded);
}

TEST_F(HealthTest, AClockSetBackDoesNotMakeItConfirmedForLong) {
  see(Verdict::agrees);
  time_ -= 60;
  EXPECT_EQ(seeTimes(9, Verdict::silent), tracking);
  EXPECT_EQ(seeTimes(3, Verdict::silent), degraded);
  EXPECT_NEAR(monitor_.health().unconfirmed_for, 1.1, 1e-9);
}

TEST_F(HealthTest, ContradictionsWithAnotherMapAreForgotten) {
  see(Verdict::agrees);
  EXPECT_EQ(seeTimes(2, Verdict::contradicts), degraded);
  monitor_.forgetContradictions();
  EXPECT_EQ(seeTimes(2, Verdict::contradicts), degraded);
  EXPECT_EQ(see(Verdict::contradicts), lost);
}

TEST_F(HealthTest, EveryStatusHasAName) {
  EXPECT_EQ(nameOf(uninitialized), "uninitialized");
  EXPECT_EQ(nameOf(lost), "lost");
}

TEST_F(HealthTest, RefusesBadOptions) {
  EXPECT_THROW(HealthMonitor(HealthOptions{.degraded_after = 0}), std::invalid_argument);
  EXPECT_THROW(HealthMonitor(HealthOptions{.lost_after = 0}), std::invalid_argument);
  EXPECT_THROW(HealthMonitor(HealthOptions{.lost_reset_after = std::nan("")}), std::invalid_argument);
}

}  // namespace
}  // namespace vmcl
