// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/config/CConfigFileBase.h>

#include <string>

#include "vmcl/mapping/map_builder.h"
#include "vmcl/relocalization/relocalizer.h"

namespace vmcl {

/// What the ini says about a visual map, in the three sections that MRPT gives every map. A particle's log likelihood
/// is
///
///     L(pose) / (1 + (n - 1) match_correlation), with L at particle_sigma_px in place of sigma_px
///
/// and n the number of matches. Those of an image err together: an error of the mount, of a group of landmarks, of the
/// time stamp moves many at once, and a repeated texture brings a dozen wrong matches that agree. So many tell hardly
/// more than some, and a few nearly as much as if they were independent (the design effect of cluster sampling: Kish,
/// Survey Sampling, 1965). AMCL uses laser_max_beams of the beams for the like reason. The wider noise gives each
/// particle the likelihood of its neighbourhood: a few thousand particles lie centimetres apart, where an image tells
/// millimetres.
struct VisualMapOptions {
  std::string map_file;          ///< [.._creationOpts] a .vmap; empty: the map is built from inserted images
  std::string image_directory;   ///< [.._creationOpts] where a log's outside images lie, for stock programs, which do
                                 ///< not look in <rawlog>_Images; sets MRPT's process-wide base directory of images
  std::string match_directory;   ///< [.._creationOpts] keeps the matches of images, for other runs on the same log and
                                 ///< map, with the same options; empty: none
  double particle_sigma_px = 5;  ///< [.._likelihoodOpts] pixel noise when particles are weighed
  double match_correlation = 0.1;  ///< [.._likelihoodOpts] of the errors of an image's matches, [0, 1]
  int max_matches = 0;  ///< [.._likelihoodOpts] most matches of an image that particles are weighed by, which
                        ///< count as all do; 0: all
  RelocalizerOptions relocalizer;  ///< [.._likelihoodOpts] retrieved, ranked, reliable_depth, max_point_sigma,
                                   ///< max_ratio, sigma_px, inlier_prior, sigma_tilt (rad), sigma_height, iterations,
                                   ///< max_modes, setting, dense_network
  std::string features = "sift";   ///< [.._insertOpts] sift or orb
  MapBuilderOptions builder;       ///< [.._insertOpts] max_features, mask_rows_from_top, keyframe_distance,
                                   ///< keyframe_rotation, sigma_mount_tilt, words

  /// Throws std::invalid_argument naming the bad key.
  void check() const;

  /// Reads `prefix`_creationOpts, `prefix`_likelihoodOpts and `prefix`_insertOpts. Throws std::invalid_argument naming
  /// section and key, also for a key that is not known.
  void read(const mrpt::config::CConfigFileBase& ini, const std::string& prefix);

  /// The sections as read() takes them.
  void write(mrpt::config::CConfigFileBase& ini, const std::string& prefix) const;
};

}  // namespace vmcl
