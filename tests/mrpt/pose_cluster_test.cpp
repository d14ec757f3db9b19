// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/pose_cluster.h"

#include <gtest/gtest.h>

#include "vmcl/geometry/random.h"

namespace vmcl {
namespace {

void add(mrpt::poses::CPosePDFParticles& particles, const PlanarPose& pose, double weight) {
  particles.m_particles.emplace_back();
  particles.m_particles.back().d = {pose.x, pose.y, pose.phi};
  particles.m_particles.back().log_w = std::log(weight);
}

mrpt::poses::CPosePDFParticles none() {
  mrpt::poses::CPosePDFParticles particles;
  particles.clearParticles();
  return particles;
}

TEST(PoseCluster, MeanAndCovarianceOfFourParticles) {
  auto particles = none();
  for (const double dx : {-0.1, 0.1})
    for (const double dphi : {-0.2, 0.2}) add(particles, {2 + dx, 3, wrapAngle(std::numbers::pi + dphi)}, 0.25);
  const PoseCluster cluster = dominantCluster(particles);
  EXPECT_NEAR(cluster.robot_in_map.x, 2, 1e-12);
  EXPECT_NEAR(cluster.robot_in_map.y, 3, 1e-12);
  EXPECT_NEAR(std::abs(cluster.robot_in_map.phi), std::numbers::pi, 1e-12);
  EXPECT_NEAR(cluster.covariance(0, 0), 0.01, 1e-12);
  EXPECT_NEAR(cluster.covariance(2, 2), 0.04, 1e-12);
  EXPECT_NEAR(cluster.covariance(0, 2), 0, 1e-12);
  EXPECT_DOUBLE_EQ(cluster.share, 1);
  EXPECT_NEAR(cluster.positionDeviation(), 0.1, 1e-12);
}

TEST(PoseCluster, TheHeavierOfTwoCounts) {
  auto particles = none();
  for (int i = 0; i < 90; ++i) add(particles, {0, 0, 0}, 0.002);  // many, but light
  for (int i = 0; i < 10; ++i) add(particles, {5, 5, 1}, 0.082);
  const PoseCluster cluster = dominantCluster(particles);
  EXPECT_NEAR(cluster.robot_in_map.x, 5, 1e-12);
  EXPECT_NEAR(cluster.share, 0.82, 1e-12);
}

TEST(PoseCluster, TheSamePlaceTheOtherWayRoundIsAnother) {
  auto particles = none();
  add(particles, {0, 0, 0}, 0.6);
  add(particles, {0, 0, std::numbers::pi}, 0.4);
  EXPECT_NEAR(dominantCluster(particles).share, 0.6, 1e-12);
}

TEST(PoseCluster, FindsTheMiddleOfASpreadCloud) {
  auto particles = none();
  Random random(1);
  for (int i = 0; i < 5000; ++i)
    add(particles, {1.25 + 0.3 * random.normal(), 0.3 * random.normal(), 0.1 * random.normal()}, 1.0 / 5000);
  const PoseCluster cluster = dominantCluster(particles);
  EXPECT_NEAR(cluster.robot_in_map.x, 1.25, 0.03);  // seven standard deviations of the mean: false alarm 3e-12
  EXPECT_NEAR(cluster.positionDeviation(), 0.42, 0.03);
  EXPECT_GT(cluster.share, 0.98);
}

TEST(PoseCluster, FarAwayThereAreStillTwoSides) {
  auto particles = none();
  for (const double x : {-1e300, 1e300}) add(particles, {x, 0, 0}, 0.3);
  add(particles, {0, 0, 0}, 0.4);
  EXPECT_NEAR(dominantCluster(particles).share, 0.4, 1e-12);
}

TEST(PoseCluster, NeedsParticles) { EXPECT_THROW(dominantCluster(none()), std::invalid_argument); }

}  // namespace
}  // namespace vmcl
