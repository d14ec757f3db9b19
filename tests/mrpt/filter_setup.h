// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <vector>

#include "fake_map.h"
#include "vmcl/mrpt/planar_monte_carlo.h"

namespace vmcl {

inline constexpr PoseBox box{-4, 4, -4, 4};

/// A filter with one fake map and a fixed sample size. Everything random follows options.seed, 1 unless a test changes
/// it; chances of a false alarm that tests state are those of any other seed.
struct FilterSetup {
  PlanarMonteCarloOptions options;
  PlanarMonteCarlo::ParticleFilterOptions filter;
  PlanarMonteCarlo::KldOptions kld;
  std::function<double(const PlanarPose&)> log_likelihood = [](const PlanarPose&) { return 0; };

  FilterSetup() {
    filter.adaptiveSampleSize = false;
    filter.BETA = 0;  // no resampling, so that weights can be looked at
  }

  mrpt::maps::CMultiMetricMap::Ptr maps() const {
    auto one = mrpt::maps::CMultiMetricMap::Create();
    one->maps.push_back(std::make_shared<FakeMap>(log_likelihood));
    return one;
  }

  PlanarMonteCarlo make(const PoseBox& start, int particles) const {
    PlanarMonteCarlo filtered(maps(), kld, filter, options, PoseRegion(box));
    filtered.start(PoseRegion(start), particles);
    return filtered;
  }
};

inline mrpt::obs::CSensoryFrame someObservation() {
  mrpt::obs::CSensoryFrame frame;
  frame.insert(mrpt::obs::CObservationComment::Create());
  return frame;
}

inline mrpt::obs::CActionCollection movement(double x, double phi) {
  mrpt::obs::CActionRobotMovement2D action;
  action.computeFromOdometry(mrpt::poses::CPose2D(x, 0, phi), {});
  mrpt::obs::CActionCollection actions;
  actions.insert(action);
  return actions;
}

inline PoseMode mode(const PlanarPose& pose, double deviation) {
  PoseMode one;
  one.robot_in_map = pose;
  one.covariance = Eigen::Vector3d::Constant(deviation * deviation).asDiagonal();
  return one;
}

template <typename Inside>
double weightWhere(const PlanarMonteCarlo& filter, Inside&& inside) {
  double weight = 0, total = 0;
  for (const auto& particle : filter.m_particles) {
    const double w = std::exp(particle.log_w);
    total += w;
    if (inside(PlanarPose{particle.d.x, particle.d.y, particle.d.phi})) weight += w;
  }
  return weight / total;
}

inline std::vector<double> numbersOf(const PlanarMonteCarlo& filter) {
  std::vector<double> numbers;
  for (const auto& p : filter.m_particles) numbers.insert(numbers.end(), {p.d.x, p.d.y, p.d.phi, p.log_w});
  return numbers;
}

}  // namespace vmcl
