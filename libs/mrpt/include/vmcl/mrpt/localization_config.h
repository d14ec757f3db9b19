// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CMultiMetricMap.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vmcl/mrpt/localizer_options.h"
#include "vmcl/mrpt/pose_with_covariance.h"
#include "vmcl/mrpt/sensors.h"

namespace vmcl {

/// A localization experiment as pf-localization's ini describes it, with our own section [vmcl]:
///
///     recovery_alpha_slow, recovery_alpha_fast, injection_share, kidnapping_probability, aliasing_probability,
///     slip_probability, guided_updates
///     update_min_d, update_min_a, degraded_after, lost_after, lost_reset_after
///     max_position_deviation, max_heading_deviation_deg, min_share, min_frames
///
/// (PlanarMonteCarloOptions, LocalizerOptions, HealthOptions and LocalizedRule), and a section [amcl] with AMCL's
/// parameters in place of [KLD_options], [PF_options], [DummyOdometryParams] and particles_count (doc/parameters.md).
///
/// Of the stock sections these are read: [KLD_options] and [PF_options] whole, [DummyOdometryParams] minStdXY and
/// minStdPHI, [MetricMap] and the sections of its maps whole, [LocalizationExperiment] map_file, rawlog_file,
/// rawlog_offset, particles_count (the first, if several), init_PDF_mode, init_PDF_min_x and so on, use_3D_poses (must
/// be false). What concerns windows, repetitions and stock's own output is left alone.
struct LocalizationConfig : LocalizerOptions {
  std::filesystem::path ini_file;  ///< for messages
  mrpt::maps::TSetOfMetricMapInitializers maps;
  std::filesystem::path map_file;  ///< .simplemap(.gz) or .gridmap(.gz); empty: the maps bring their own content
  std::filesystem::path rawlog_file;
  int rawlog_offset = 0;  ///< steps skipped
  PoseBox start;
  bool start_in_free_space = false;                ///< of the grid map; else anywhere in the box
  bool start_anywhere = false;                     ///< instead: wherever the maps allow
  std::optional<PoseWithCovariance> initial_pose;  ///< instead: about here
};

/// What is changed of an ini without editing it.
struct IniChanges {
  std::vector<std::string> values;  ///< "section.key=value" each
  std::optional<Sensors> sensors;   ///< whose maps are used; nothing: all
};

/// Reads the ini. `map_files` take the place of map_file, or, for a .vmap, of the map_file of the first visual map; a
/// `rawlog_file` takes the place of rawlog_file. Map files of which no map is used are left out. Relative paths in the
/// ini start at the working directory or, if there is no such file, at the directory of the ini. Throws
/// std::runtime_error naming the file and what is wrong: missing, a key or value that is bad or not known, a `*_count`
/// of no known map, a changed key that MRPT would ignore if it were misspelt because the ini does not have it.
LocalizationConfig loadLocalizationConfig(const std::filesystem::path& ini,
                                          const std::vector<std::filesystem::path>& map_files = {},
                                          const std::filesystem::path& rawlog_file = {},
                                          const IniChanges& changes = {});

/// Creates the maps and fills them. Throws std::runtime_error naming the ini or the map file and what is wrong.
mrpt::maps::CMultiMetricMap::Ptr loadMaps(const LocalizationConfig& config);

}  // namespace vmcl
