// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "measure_table.h"

namespace vmcl {

/// The cells of one session and start: what stands side by side.
struct CellGroup {
  std::size_t session = 0;
  std::size_t start = 0;
  std::vector<Cell> cells;
};

std::vector<CellGroup> groupsOf(const ExperimentResults& results);

/// "SESSION, START".
std::string titleOf(const ExperimentResults& results, const CellGroup& group);

/// Measures that some cell of the group has a value for.
std::vector<Measure> measuresIn(const CellGroup& group, const std::vector<Measure>& measures);

/// results.csv (a row a cell) and results.md (a table a group), runs.csv (a row a run): the same bytes for the same
/// experiment. costs.csv (a row a run): time and memory. All throw std::runtime_error naming the file.
void writeTables(const std::filesystem::path& directory, const ExperimentResults& results);

}  // namespace vmcl
