// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "run_result.h"
#include "vmcl/study/confidence_interval.h"

namespace vmcl {

/// A figure of a run, and how those of several runs are summed up.
struct Measure {
  enum class Summary {
    rate,    ///< share of the runs for which it is 1 and not 0, with Wilson's interval
    mean,    ///< with a bootstrap interval
    median,  ///< with a bootstrap interval
  };

  std::string key;    ///< column of a CSV file, with the unit at its end
  std::string title;  ///< for people
  std::string unit;
  int digits = 3;  ///< behind the point, for people
  Summary summary = Summary::median;
  std::function<std::optional<double>(const RunResult&)> of;
};

/// Those that are the same for the same seed.
const std::vector<Measure>& resultMeasures();

/// Those that differ from run to run: time and memory.
const std::vector<Measure>& costMeasures();

/// The runs of a method in a session from a start.
struct Cell {
  std::size_t session = 0;
  std::size_t start = 0;
  Method method;
  std::vector<const RunResult*> done;
  int failed = 0;
  int missing = 0;
};

/// In the order of the plan, so that methods of one session and start follow each other.
std::vector<Cell> cellsOf(const ExperimentResults& results);

struct SummaryValue {
  int runs = 0;  ///< that have the figure
  double value = 0;
  Interval interval;
};

/// Nothing when no run of the cell has the figure.
std::optional<SummaryValue> summarize(const Measure& measure, const Cell& cell);

/// "0.123 (0.100 to 0.150)", or "-".
std::string textOf(const Measure& measure, const std::optional<SummaryValue>& value);

}  // namespace vmcl
