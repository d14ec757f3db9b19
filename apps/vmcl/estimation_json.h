// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <set>
#include <string>

#include "vmcl/estimation/estimator.h"
#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

struct IdentifiedProblem {
  std::string id;
  PoseProblem problem;
  std::set<std::string> unknown_keys;  ///< that were passed over: often a known one, misspelt
};

/// Reads one line of `vmcl estimate`'s input (doc/file_formats.md). Sets `id` as soon as it is known, so that an error
/// can name it. Throws std::invalid_argument saying what is wrong.
IdentifiedProblem parseProblem(const std::string& line, std::string& id);

/// One line of output for an estimate, with the time it took where that is wanted, and for a problem that could not be
/// read.
std::string formatEstimate(const std::string& id, const PoseEstimate& estimate, std::optional<double> time_us);
std::string formatError(const std::string& id, const std::string& message);

}  // namespace vmcl
