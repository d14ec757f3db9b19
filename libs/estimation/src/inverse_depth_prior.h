// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

/// What is known of the inverse depth (1/m, along the reference's optical axis) of a match without depth.
struct InverseDepthPrior {
  double mean = 0.25;
  double sigma = 0.2;
};

/// Matches without depth lie among those with depth: mean and spread of the latter's inverse depths, together with two
/// pseudo-observations that stand for a room.
InverseDepthPrior inverseDepthPrior(const PoseProblem& problem);

}  // namespace vmcl
