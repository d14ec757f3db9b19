// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/pose_density.h"

#include <gtest/gtest.h>

#include "vmcl/mrpt/mode_mixture.h"

namespace vmcl {
namespace {

/// Sum of density * function over a fine lattice about a pose, times the lattice cell.
template <typename Density, typename Function>
double integrate(const Density& density, const PlanarPose& centre, double reach, double turn, Function&& function) {
  constexpr int steps = 60;
  double sum = 0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j)
      for (int k = 0; k < steps; ++k) {
        const auto offset = [&](int step, double half) { return half * (2 * (step + 0.5) / steps - 1); };
        const PlanarPose d{offset(i, reach), offset(j, reach), offset(k, turn)};
        sum += density({centre.x + d.x, centre.y + d.y, wrapAngle(centre.phi + d.phi)}) * function(d);
      }
  return sum * std::pow(2.0 / steps, 3) * reach * reach * turn;
}

TEST(PoseDensity, IntegratesToTheWeightAndHasTheStatedKernel) {
  PoseDensity density;
  const PlanarPose pose{1.234, -5.678, 3.13};  // the kernel crosses the turn
  density.add(pose, 0.7);
  const double reach = 0.25, turn = 0.25;
  EXPECT_NEAR(integrate(density, pose, reach, turn, [](auto&) { return 1; }), 0.7, 0.01);
  EXPECT_NEAR(integrate(density, pose, reach, turn, [](auto& d) { return d.x; }), 0, 1e-3);
  // Averaged over where the pose lies in its cell the variance is cell^2 / 3; at any one place it differs a little.
  double variance = 0;
  for (int i = 0; i < 5; ++i) {
    PoseDensity one;
    const PlanarPose shifted{pose.x + i * PoseDensity::cell_position / 5, pose.y, pose.phi};
    one.add(shifted, 1);
    variance += integrate(one, shifted, reach, turn, [](auto& d) { return d.x * d.x; }) / 5;
  }
  EXPECT_NEAR(variance, PoseDensity::position_variance, 0.1 * PoseDensity::position_variance);
}

TEST(PoseDensity, IsZeroFarAway) {
  PoseDensity density;
  density.add({0, 0, 0}, 1);
  EXPECT_EQ(density({1, 0, 0}), 0);
  EXPECT_EQ(density({0, 0, 1}), 0);
  EXPECT_GT(density({0.05, 0, 0}), 0);
}

TEST(PoseDensity, TakesPosesHoweverFarAway) {
  PoseDensity density;
  density.add({1e300, -1e300, 0}, 1);
  EXPECT_GT(density({1e300, -1e300, 0}), 0);
  EXPECT_EQ(density({0, 0, 0}), 0);
  EXPECT_EQ(density({-1e300, -1e300, 0}), 0);
}

TEST(PoseDensity, FindsAUniformDensity) {
  PoseDensity density;
  Random random(7);
  constexpr int count = 200000;
  for (int i = 0; i < count; ++i)
    density.add({random.uniform(0, 1), random.uniform(0, 1), random.uniform(-std::numbers::pi, std::numbers::pi)},
                1.0 / count);
  // About 28 poses a cell, so the mean over 1000 inner places is within 2 % with a chance of error below 1e-6.
  double mean = 0;
  for (int i = 0; i < 1000; ++i)
    mean += density({random.uniform(0.2, 0.8), random.uniform(0.2, 0.8), random.uniform(-3, 3)}) / 1000;
  EXPECT_NEAR(mean * 2 * std::numbers::pi, 1, 0.02);
}

std::vector<PoseMode> twoModes() {
  PoseMode a, b;
  a.robot_in_map = {1, 2, 3.1};
  a.covariance = Eigen::Vector3d(0.01, 0.04, 0.01).asDiagonal();
  a.log_weight = std::log(0.75);
  b.robot_in_map = {-4, 0, 0};
  b.log_weight = std::log(0.25);
  return {a, b};
}

TEST(ModeMixture, IntegratesToOne) {
  const ModeMixture mixture(twoModes());
  const auto density = [&](const PlanarPose& pose) { return mixture.density(pose); };
  EXPECT_NEAR(integrate(density, {1, 2, 3.1}, 1.2, 0.7, [](auto&) { return 1; }), 0.75, 1e-3);
  EXPECT_NEAR(integrate(density, {-4, 0, 0}, 0.4, 0.35, [](auto&) { return 1; }), 0.25, 1e-3);
}

TEST(ModeMixture, DrawsWhatItsDensitySays) {
  const auto modes = twoModes();
  const ModeMixture mixture(modes);
  Random random(3);
  constexpr int count = 20000;
  int near_first = 0;
  Eigen::Vector3d variance = Eigen::Vector3d::Zero();
  for (int i = 0; i < count; ++i) {
    const PlanarPose pose = mixture.draw(random);
    if (pose.x < -1.5) continue;
    ++near_first;
    const Eigen::Vector3d d(pose.x - 1, pose.y - 2, wrapAngle(pose.phi - 3.1));
    variance += d.cwiseAbs2();
  }
  // Six standard deviations each: chance of a false alarm about 1e-8.
  EXPECT_NEAR(near_first, 0.75 * count, 6 * std::sqrt(0.75 * 0.25 * count));
  variance /= near_first;
  const Eigen::Vector3d expected =
      modes[0].covariance.diagonal() +
      Eigen::Vector3d(PoseDensity::position_variance, PoseDensity::position_variance, PoseDensity::heading_variance);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(variance[i], expected[i], 6 * expected[i] * std::sqrt(2.0 / near_first));
}

/// A heading spread over turns, tied to the position: what is drawn has gone round the circle. Seed 1; only a draw
/// beyond seven deviations, chance below 1e-6, could fail it.
TEST(ModeMixture, HeadingsGoRoundTheCircle) {
  PoseMode mode;
  mode.robot_in_map = {1, 2, 3};
  mode.covariance << 0.04, 0, 0.7, 0, 0.04, 0, 0.7, 0, 16;
  const ModeMixture mixture({&mode, 1});
  Random random(1);
  for (int i = 0; i < 10000; ++i) EXPECT_GT(mixture.density(mixture.draw(random)), 1e-12);
  // The mass over positions and headings, within 8 deviations of the positions.
  double mass = 0;
  constexpr double step = 0.05, angle = 2 * std::numbers::pi / 64;
  for (double x = -0.8; x < 2.8; x += step)
    for (double y = 0.2; y < 3.8; y += step)
      for (int k = 0; k < 64; ++k) mass += mixture.density({x, y, k * angle}) * step * step * angle;
  EXPECT_NEAR(mass, 1, 1e-6);
}

TEST(ModeMixture, RefusesWhatIsNoDensity) {
  EXPECT_THROW(ModeMixture({}), std::invalid_argument);
  auto modes = twoModes();
  modes[0].covariance(0, 0) = -1;
  EXPECT_THROW((ModeMixture(modes)), std::invalid_argument);
  modes = twoModes();
  modes[1].robot_in_map.x = std::numeric_limits<double>::infinity();
  EXPECT_THROW((ModeMixture(modes)), std::invalid_argument);
}

}  // namespace
}  // namespace vmcl
