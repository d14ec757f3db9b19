// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "experiment_tables.h"

namespace vmcl {

/// The errors of all runs of a group at the same times, so that they can be compared.
struct ErrorGrid {
  struct Series {
    uint64_t seed = 0;
    std::vector<std::optional<PoseError>> errors;  ///< at each time, of the last update; nothing after 1 s without one
  };
  std::vector<double> times;               ///< s from the first update of any run; those at which some run has an error
  std::vector<std::vector<Series>> cells;  ///< the runs of each cell
};

ErrorGrid errorGridOf(const CellGroup& group);

/// Of the runs that have an error at a time.
struct ErrorQuartiles {
  double time = 0;
  std::array<double, 3> position{};  ///< m
  std::array<double, 3> heading{};   ///< rad
};

/// At the times at which at least half of the cell's runs have an error.
std::vector<ErrorQuartiles> quartilesOverTime(const ErrorGrid& grid, std::size_t cell);

/// How often each cell of a group succeeds.
struct SuccessRates {
  std::vector<double> absolute;    ///< shares of all times and seeds
  std::vector<double> normalized;  ///< shares of those at which any cell succeeds; 0 when none ever does
};

/// A run succeeds at a time when its error is within `distance` (m) and 5 deg. The normalized rate is that of Jiao et
/// al. 2020, who so compare sessions of unlike difficulty: 1 is what always picking the best of the methods would
/// reach.
SuccessRates successRates(const ErrorGrid& grid, double distance);

}  // namespace vmcl
