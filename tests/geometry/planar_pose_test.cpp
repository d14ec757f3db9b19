// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/geometry/planar_pose.h"

#include <gtest/gtest.h>

#include "vmcl/geometry/planar_transform.h"
#include "vmcl/geometry/random.h"

namespace vmcl {
namespace {

PlanarPose randomPose(Random& random) {
  return {random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-10, 10)};
}

void expectSame(const PlanarPose& a, const PlanarPose& b) {
  EXPECT_NEAR(a.x, b.x, 1e-12);
  EXPECT_NEAR(a.y, b.y, 1e-12);
  EXPECT_NEAR(wrapAngle(a.phi - b.phi), 0, 1e-12);
}

TEST(PlanarPose, IsAGroup) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const PlanarPose a = randomPose(random), b = randomPose(random), c = randomPose(random);
    expectSame((a * b) * c, a * (b * c));
    expectSame(a * inverse(a), {});
    expectSame(inverse(a) * a, {});
    expectSame(a * PlanarPose{}, a);
  }
}

TEST(PlanarPose, ComposesAsInSpace) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const PlanarPose a = randomPose(random), b = randomPose(random);
    EXPECT_TRUE(toRigid3(a * b).isApprox(toRigid3(a) * toRigid3(b), 1e-12));
    expectSame(planarPart(toRigid3(a)), a);
    expectSame(PlanarTransform(a).pose(), a);
  }
}

TEST(PlanarPose, WrapsToTheHalfOpenCircle) {
  EXPECT_DOUBLE_EQ(wrapAngle(M_PI), M_PI);
  EXPECT_DOUBLE_EQ(wrapAngle(-M_PI), M_PI);
  EXPECT_NEAR(wrapAngle(3 * M_PI + 0.1), -M_PI + 0.1, 1e-12);
  EXPECT_EQ(wrapAngle(0.5), 0.5);
}

}  // namespace
}  // namespace vmcl
