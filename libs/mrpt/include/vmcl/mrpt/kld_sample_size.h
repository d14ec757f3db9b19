// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/slam/TKLDParams.h>

#include <array>
#include <set>

#include "vmcl/geometry/planar_pose.h"

namespace vmcl {

/// How many particles a distribution needs that has been drawn from so far (Fox: KLD-sampling, NIPS 2001): so many that
/// with probability 1 - KLD_delta the divergence of the drawn from the true distribution over the bins is at most
/// KLD_epsilon, between KLD_minSampleSize and KLD_maxSampleSize. AMCL's pf_err is KLD_epsilon, its pf_z 1 - KLD_delta,
/// taken as the probability that it is documented as (AMCL itself takes the number for the normal quantile).
class KldSampleSize {
 public:
  static constexpr int most_particles = 10'000'000;

  /// Throws std::invalid_argument naming the key out of range.
  explicit KldSampleSize(const mrpt::slam::TKLDParams& options);

  /// Counts the bin of a particle; returns the number needed by the bins known.
  std::size_t add(const PlanarPose& pose);

  /// The number needed for a distribution over so many bins.
  std::size_t needed(std::size_t bins) const;

 private:
  mrpt::slam::TKLDParams options_;
  double quantile_;  ///< of the standard normal at 1 - KLD_delta
  std::set<std::array<long, 3>> bins_;
  std::size_t needed_;
};

}  // namespace vmcl
