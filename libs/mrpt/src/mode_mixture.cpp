// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/mode_mixture.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "vmcl/mrpt/pose_density.h"

namespace vmcl {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

/// So many turns either way reach every heading within seven deviations of the mean.
int wrapsOf(double heading_deviation) {
  constexpr double most = 100;  // a heading so spread is as good as any
  return static_cast<int>(std::min(most, std::floor(7 * heading_deviation / full_turn + 0.5)));
}

}  // namespace

ModeMixture::ModeMixture(std::span<const PoseMode> modes) {
  if (modes.empty()) throw std::invalid_argument("a mixture needs at least one mode");
  const Eigen::Vector3d kernel(PoseDensity::position_variance, PoseDensity::position_variance,
                               PoseDensity::heading_variance);
  double top = modes.front().log_weight, sum = 0;
  for (const PoseMode& mode : modes) top = std::max(top, mode.log_weight);
  for (const PoseMode& mode : modes) sum += std::exp(mode.log_weight - top);
  for (const PoseMode& mode : modes) {
    const Eigen::LLT<Eigen::Matrix3d> cholesky(mode.covariance + Eigen::Matrix3d(kernel.asDiagonal()));
    if (cholesky.info() != Eigen::Success || !mode.covariance.allFinite() || !isFinite(mode.robot_in_map))
      throw std::invalid_argument("a mode's covariance is not positive semidefinite");
    Component component{mode.robot_in_map, cholesky.matrixL(), std::exp(mode.log_weight - top) / sum, 0, 0};
    component.peak_density = component.weight / (std::pow(full_turn, 1.5) * component.root.diagonal().prod());
    component.wraps = wrapsOf(component.root.row(2).norm());
    components_.push_back(component);
  }
}

PlanarPose ModeMixture::draw(Random& random) const {
  double rest = random.uniform();
  std::size_t chosen = 0;
  while (chosen + 1 < components_.size() && rest >= components_[chosen].weight) rest -= components_[chosen++].weight;
  const Component& component = components_[chosen];
  Eigen::Vector3d normal;
  for (double& value : normal) value = random.normal();
  const Eigen::Vector3d offset = component.root * normal;
  return {component.mean.x + offset.x(), component.mean.y + offset.y(), wrapAngle(component.mean.phi + offset.z())};
}

double ModeMixture::density(const PlanarPose& pose) const {
  double sum = 0;
  for (const Component& component : components_) {
    const double angle = wrapAngle(pose.phi - component.mean.phi);
    for (int wrap = -component.wraps; wrap <= component.wraps; ++wrap) {
      const Eigen::Vector3d offset(pose.x - component.mean.x, pose.y - component.mean.y, angle + wrap * full_turn);
      sum += component.peak_density *
             std::exp(-component.root.triangularView<Eigen::Lower>().solve(offset).squaredNorm() / 2);
    }
  }
  return sum;
}

}  // namespace vmcl
