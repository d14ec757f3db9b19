// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/odometry_motion_model.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "vmcl/estimation/pose_mixture.h"

namespace vmcl {
namespace {

using Drive = OdometryMotionModel::Drive;

OdometryMotionModel noiseless(Drive drive) { return {drive, 0, 0, 0, 0, 0}; }

constexpr int draws = 20000;

/// Standard deviations of way, direction and heading of many draws. Of 20,000, each is known to 0.5 %, so that 3 % is
/// six standard deviations: false alarm 1e-9.
Eigen::Vector3d deviations(const OdometryMotionModel& model, const PlanarPose& movement) {
  Random random(1);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < draws; ++i) {
    const PlanarPose drawn = model.draw(movement, random);
    const double along = std::hypot(drawn.x, drawn.y) - std::hypot(movement.x, movement.y);
    const double direction = wrapAngle(std::atan2(drawn.y, drawn.x) - std::atan2(movement.y, movement.x));
    sum += Eigen::Vector3d(along, direction, wrapAngle(drawn.phi - movement.phi)).cwiseAbs2();
  }
  return (sum / draws).cwiseSqrt();
}

TEST(OdometryMotionModel, WithoutNoiseItIsTheMovement) {
  Random random(1);
  for (const Drive drive : {Drive::differential, Drive::omnidirectional})
    for (const PlanarPose& movement : {PlanarPose{1, 0, 0}, {-0.5, 0.1, 0.3}, {0, 0.4, -3}, {0.001, 0, 0.5}, {}}) {
      const PlanarPose drawn = noiseless(drive).draw(movement, random);
      EXPECT_NEAR(drawn.x, movement.x, 1e-3);  // a way under 1 cm has no direction
      EXPECT_NEAR(drawn.y, movement.y, 1e-3);
      EXPECT_NEAR(wrapAngle(drawn.phi - movement.phi), 0, 1e-12);
    }
}

TEST(OdometryMotionModel, ARobotThatStandsStillHasNoNoise) {
  Random random(1);
  for (const Drive drive : {Drive::differential, Drive::omnidirectional}) {
    OdometryMotionModel model;
    model.drive = drive;
    EXPECT_EQ(difference(model.draw({}, random), {}).norm(), 0);
  }
}

TEST(OdometryMotionModel, EachAlphaOfTheDifferentialDriveActsWhereAmclSays) {
  const PlanarPose ahead{2, 0, 0}, turn{0, 0, 0.8};
  OdometryMotionModel model = noiseless(Drive::differential);
  model.alpha1 = 0.01;  // a turn of 0.8 errs by 0.08
  EXPECT_NEAR(deviations(model, turn).z() / 0.08, 1, 0.03);
  EXPECT_NEAR(deviations(model, ahead).norm(), 0, 1e-9);
  model = noiseless(Drive::differential);
  model.alpha2 = 0.0001;  // 2 m err by 0.02 rad in each of two turns
  EXPECT_NEAR(deviations(model, ahead).y() / 0.02, 1, 0.03);
  EXPECT_NEAR(deviations(model, ahead).z() / (0.02 * std::sqrt(2)), 1, 0.03);
  model = noiseless(Drive::differential);
  model.alpha3 = 0.01;  // 2 m err by 0.2 m
  EXPECT_NEAR(deviations(model, ahead).x() / 0.2, 1, 0.03);
  model = noiseless(Drive::differential);
  model.alpha4 = 0.0001;  // a turn of 0.8 after the way moves that by 0.008 m
  EXPECT_NEAR(deviations(model, {2, 0, 0.8}).x() / 0.008, 1, 0.03);
}

/// A robot that backs has not turned round twice.
TEST(OdometryMotionModel, BackingIsAsCertainAsGoingAhead) {
  OdometryMotionModel model;
  model.alpha1 = 0.01;
  EXPECT_NEAR((deviations(model, {-1, 0, 0}) - deviations(model, {1, 0, 0})).norm(), 0, 1e-9);
}

TEST(OdometryMotionModel, AnOmnidirectionalDriveErrsAcrossItsWay) {
  OdometryMotionModel model = noiseless(Drive::omnidirectional);
  model.alpha5 = 0.0001;  // 2 m err by 0.02 m across: 0.01 rad
  EXPECT_NEAR(deviations(model, {0, 2, 0}).y() / 0.01, 1, 0.03);
  EXPECT_NEAR(deviations(model, {0, 2, 0}).z(), 0, 1e-9);
  model = noiseless(Drive::omnidirectional);
  model.alpha2 = 0.0001;
  EXPECT_NEAR(deviations(model, {0, 2, 0}).z() / 0.02, 1, 0.03);
}

TEST(OdometryMotionModel, RefusesBadAlphas) {
  for (const double bad : {-0.1, std::nan(""), 1e9}) {
    OdometryMotionModel model;
    model.alpha3 = bad;
    EXPECT_THROW(model.check(), std::invalid_argument);
  }
}

}  // namespace
}  // namespace vmcl
