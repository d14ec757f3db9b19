// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <ostream>
#include <vector>

#include "vmcl/study/study.h"

namespace vmcl {

/// A run of the simulation study.
struct StudyRun {
  uint64_t seed = 1;
  int trials = 0;  ///< of each cell
  std::vector<CellSummary> cells;
};

/// results.csv (a row a cell and method), summary.json and timings.csv; only the last differs between runs of one seed.
/// doc/benchmark.md says what each column is. Throws std::runtime_error naming the file that cannot be written.
void writeStudyTables(const std::filesystem::path& directory, const StudyRun& run);

/// The same for reading: methods across, cells down.
void printStudy(std::ostream& out, const StudyRun& run);

/// accuracy_*.svg, success_*.svg and cost_*.svg, those of the figures that were run; the last show times. Throws
/// std::runtime_error when gnuplot is missing or fails.
void drawStudy(const std::filesystem::path& directory, const StudyRun& run);

}  // namespace vmcl
