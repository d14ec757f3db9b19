// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>

#include <filesystem>
#include <optional>

#include "vmcl/geometry/pose_problem.h"
#include "vmcl/mrpt/visual_map_options.h"

namespace vmcl {

/// Keeps what images have in common with a map in a directory, a file an image, so that of many runs on one log and one
/// map only the first need find it. An image is known by its sensor label and time, and by all options as they are in
/// effect: matches found with other ones, or with other defaults of another version, are others.
class MatchStore {
 public:
  /// Of options without a match_directory: keeps nothing.
  explicit MatchStore(const VisualMapOptions& options);

  /// Nothing where none was kept, or not whole.
  std::optional<PoseProblem> find(const mrpt::obs::CObservation& image) const;

  /// What cannot be written is not kept.
  void keep(const mrpt::obs::CObservation& image, const PoseProblem& problem) const;

 private:
  std::filesystem::path fileOf(const mrpt::obs::CObservation& image) const;

  std::filesystem::path directory_;
  uint32_t options_checksum_;
};

}  // namespace vmcl
