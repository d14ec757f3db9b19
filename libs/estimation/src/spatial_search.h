// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "vmcl/estimation/estimator.h"

namespace vmcl {

/// A pose of a minimal sample that need not be on the plane.
struct SpatialHypothesis {
  Rigid3 map_from_robot;
  Solver solver;
};

/// The best hypotheses of random samples of two matches with depth (Motion::upright) or three of one camera
/// (Motion::free), drawn whatever their odds; alike ones once, the best first; nothing if no sample can be
/// drawn.
std::optional<std::vector<SpatialHypothesis>> searchSpatialSamples(const PoseProblem& problem,
                                                                   const PoseLikelihood& likelihood,
                                                                   const EstimatorOptions& options);

}  // namespace vmcl
