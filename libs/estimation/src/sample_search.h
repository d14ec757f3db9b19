// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "vmcl/estimation/estimator.h"

namespace vmcl {

/// The pose of a minimal sample.
struct Hypothesis {
  PlanarTransform pose;
  Solver solver;
};

/// The best hypotheses of random samples, alike ones once, the best first; nothing if no sample can be drawn.
std::optional<std::vector<Hypothesis>> searchSamples(const PoseProblem& problem, const PoseLikelihood& likelihood,
                                                     const EstimatorOptions& options);

}  // namespace vmcl
