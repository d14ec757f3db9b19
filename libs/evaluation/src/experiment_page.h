// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "run_result.h"

namespace vmcl {

/// report.html, whole in itself: what was run, tables and pictures of each group, failures, how to repeat it. The
/// pictures lie also in plots. Throws std::runtime_error naming the file that is broken or cannot be written.
void writePage(const std::filesystem::path& directory, const ExperimentResults& results, const std::string& version);

}  // namespace vmcl
