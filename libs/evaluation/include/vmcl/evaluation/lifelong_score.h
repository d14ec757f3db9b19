// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "vmcl/evaluation/trajectory_error.h"

namespace vmcl {

/// What counts as correct, and for how long.
struct LifelongOptions {
  double max_position_error = 1;             ///< m
  double max_heading_error = 30 * degree;    ///< rad
  double max_interval = 1;                   ///< an estimate stands for no longer than this, s
  double relocalization_time_constant = 60;  ///< s
};

/// The scores of Shi et al. 2020 (OpenLORIS-Scene), as their evaluate.py computes them, but that nothing is aligned:
/// the map frame is given.
struct LifelongScore {
  double correct_rate = 0;         ///< CR: share of the ground truth's time for which the last estimate is correct
  double relocalization_time = 0;  ///< s from the start of the ground truth to the first estimate; infinite: none
  /// C-RS: exp(-relocalization time / time constant) when the first estimate is correct, else 0.
  double relocalization_score = 0;
};

/// Only estimates while localized count: a method that says nothing is not wrong, but late.
LifelongScore lifelongScore(std::span<const TimedEstimate> estimates, const Trajectory& ground_truth,
                            const LifelongOptions& options = {});

}  // namespace vmcl
