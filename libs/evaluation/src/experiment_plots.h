// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiment_tables.h"
#include "map_layers.h"

namespace vmcl {

/// A picture of a group: its file and what it shows.
struct GroupPicture {
  std::filesystem::path svg;
  std::string caption;
};

/// Draws plots/GROUP.*.svg: paths over the map, errors over time, success against threshold, distributions over the
/// runs. None for a group of which no run is done. `map` is drawn under the paths. Throws std::runtime_error naming the
/// picture when gnuplot is missing or fails.
std::vector<GroupPicture> drawGroup(const std::filesystem::path& directory, const ExperimentResults& results,
                                    const CellGroup& group, const std::vector<PlotLayer>& map);

}  // namespace vmcl
