// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>

#include <span>

#include "vmcl/estimation/estimator.h"
#include "vmcl/mrpt/pose_region.h"
#include "vmcl/mrpt/pose_with_covariance.h"

namespace vmcl {

/// What a metric map may offer beyond mrpt::maps::CMetricMap: to weigh all particles at once, and to say from an
/// observation alone where it was taken.
class RelocalizingMap {
 public:
  virtual ~RelocalizingMap() = default;

  /// Adds the log likelihood of the observation at each pose; sizes must agree. The sums do not depend on `threads`.
  /// Returns of how many independent matches the log likelihood is the sum, so that images with many and with few can
  /// be compared. Never throws: an observation that cannot be used adds nothing and gives 0.
  virtual double addLogLikelihoods(const mrpt::obs::CObservation& observation, std::span<const PlanarPose> robot_in_map,
                                   int threads, std::span<double> log_likelihoods) const = 0;

  /// Where the robot may have been, by samples drawn with this seed; nothing found: no modes and a reason. Throws
  /// std::runtime_error naming the sensor when the observation is broken.
  virtual PoseEstimate relocalize(const mrpt::obs::CObservation& observation, uint64_t seed) const = 0;

  /// Tells, before an observation is used, where the robot is believed to be then. A map may look there first for what
  /// it knows, but must find a robot that is elsewhere. Never throws.
  virtual void expect(const mrpt::obs::CObservation& /*observation*/, const PoseWithCovariance& /*robot*/) const {}

  /// Widens the box to what the map covers.
  virtual void extend(PoseBox& box) const = 0;
};

}  // namespace vmcl
