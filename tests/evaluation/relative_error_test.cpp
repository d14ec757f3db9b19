// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/evaluation/relative_error.h"

#include <gtest/gtest.h>

#include "straight_drive.h"

namespace vmcl {
namespace {

TEST(RelativeError, AConstantOffsetIsNone) {
  const std::vector<TimedEstimate> all{{0, true, {5, 5, 0}}, {1, true, {6, 5, 0}}, {2, true, {7, 5, 0}}};
  const RelativeError error = relativeError(all, straightDrive());
  EXPECT_EQ(error.pairs, 2);
  EXPECT_NEAR(error.position, 0, 1e-12);
  EXPECT_NEAR(error.heading, 0, 1e-12);
}

// Turned by 90 deg everywhere, the movement is seen the same from the robot.
TEST(RelativeError, AConstantTurnIsNone) {
  const std::vector<TimedEstimate> all{{0, true, {0, 0, 90 * degree}}, {1, true, {0, 1, 90 * degree}}};
  EXPECT_NEAR(relativeError(all, straightDrive()).position, 0, 1e-12);
}

// From 0 to 1 s 0.3 m too far, from 1 to 2 s right but turned by 2 deg.
TEST(RelativeError, IsTheRootMeanSquareOfThePairs) {
  const std::vector<TimedEstimate> all{{0, true, {0, 0, 0}}, {1, true, {1.3, 0, 0}}, {2, true, {2.3, 0, 2 * degree}}};
  const RelativeError error = relativeError(all, straightDrive());
  EXPECT_EQ(error.pairs, 2);
  EXPECT_NEAR(error.position, 0.3 / std::sqrt(2), 1e-12);
  EXPECT_NEAR(error.heading, 2 * degree / std::sqrt(2), 1e-12);
}

TEST(RelativeError, PairsAreOfLocalizedEstimatesAboutOneIntervalApart) {
  const std::vector<TimedEstimate> all{{0, true, {0, 0, 0}},     {0.9, true, {0, 0, 0}}, {1.2, false, {0, 0, 0}},
                                       {1.4, true, {1.5, 0, 0}}, {5, true, {0, 0, 0}},   {20, true, {0, 0, 0}}};
  const RelativeError error = relativeError(all, straightDrive());
  EXPECT_EQ(error.pairs, 1);  // 0 and 1.4; from the others it is 1.5 s or more
  EXPECT_NEAR(error.position, 0.1, 1e-12);
  EXPECT_EQ(relativeError({}, straightDrive()).pairs, 0);
}

}  // namespace
}  // namespace vmcl
