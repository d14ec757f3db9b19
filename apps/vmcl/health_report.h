// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <ostream>
#include <vector>

#include "vmcl/mrpt/localizer.h"

namespace vmcl {

/// health.csv: a line an update, the status and its evidence. Throws std::runtime_error naming the file.
void writeHealth(const std::filesystem::path& file, const std::vector<LocalizationFrame>& frames);

/// health.json: updates of each status, the last status, and the times (s) at which the robot became lost. Throws
/// std::runtime_error naming the file.
void writeHealthSummary(const std::filesystem::path& file, const std::vector<LocalizationFrame>& frames);

/// The share of the updates with each status, in one line.
void printHealth(std::ostream& out, const std::vector<LocalizationFrame>& frames);

}  // namespace vmcl
