// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "vmcl/estimation/sample_worth.h"
#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

/// Share of random 1P1DP or 2DP samples of the matches that give a pose within the tolerance of the truth: what
/// SampleWorth::chance() predicts. Of two roots either counts. 0 where no sample can be drawn. Throws
/// std::invalid_argument for other solvers.
double sampleSuccess(Solver solver, const PoseProblem& problem, const PlanarPose& map_from_robot, int samples,
                     uint64_t seed, const Tolerance& tolerance = {});

}  // namespace vmcl
