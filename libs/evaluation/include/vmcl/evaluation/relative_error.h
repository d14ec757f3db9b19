// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "vmcl/evaluation/trajectory_error.h"

namespace vmcl {

/// Error of the movement between two estimates, RMSE over all pairs; 0 when there are none.
struct RelativeError {
  int pairs = 0;
  double position = 0;  ///< m
  double heading = 0;   ///< rad
};

/// Relative pose error over `interval` s (Sturm et al. 2012): each localized estimate is paired with the first one at
/// least so much and less than 1.5 times so much later, and the movement between them compared with the true one.
RelativeError relativeError(std::span<const TimedEstimate> estimates, const Trajectory& ground_truth,
                            double interval = 1.0, double max_gap = 0.5);

}  // namespace vmcl
