// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fake_map.h"
#include "vmcl/mrpt/relocalizing_map.h"

namespace vmcl {

/// A map with a camera whose images have so many matches, each of this log likelihood.
class FakeCameraMap : public FakeMap, public RelocalizingMap {
 public:
  explicit FakeCameraMap(std::function<double(const PlanarPose&)> log_likelihood_of_match)
      : FakeMap([](const PlanarPose&) { return 0; }), likelihood_of_match_(std::move(log_likelihood_of_match)) {}

  double addLogLikelihoods(const mrpt::obs::CObservation&, std::span<const PlanarPose> poses, int,
                           std::span<double> log_likelihoods) const override {
    for (std::size_t i = 0; i < poses.size(); ++i) log_likelihoods[i] += matches * likelihood_of_match_(poses[i]);
    return matches;
  }
  PoseEstimate relocalize(const mrpt::obs::CObservation&, uint64_t seed) const override {
    seeds.push_back(seed);
    PoseEstimate nothing;
    nothing.failure = NoPose::no_better_than_chance;
    return nothing;
  }
  void expect(const mrpt::obs::CObservation&, const PoseWithCovariance& robot) const override {
    expected.emplace_back(seeds.size(), robot.robot_in_map);
  }
  void extend(PoseBox&) const override {}

  double matches = 20;
  mutable std::vector<uint64_t> seeds;                               ///< that relocalize() was called with
  mutable std::vector<std::pair<std::size_t, PlanarPose>> expected;  ///< after so many calls of it

 private:
  std::function<double(const PlanarPose&)> likelihood_of_match_;
};

}  // namespace vmcl
