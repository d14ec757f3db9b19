// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bundle_adjustment.h"
#include "reconstruction.h"
#include "triangulation.h"
#include "vmcl/mapping/map_builder.h"

namespace vmcl {

/// Fewest keyframes that a landmark without measured depth is seen from: with two, a false match along the epipolar
/// line goes unnoticed.
inline constexpr int min_observations = 3;

struct ReconstructionResult {
  AdjustmentNoise noise;    ///< with the measurements' as estimated
  TrackCounts tracks;       ///< `covariance` is left to the caller
  double shared_error = 1;  ///< by how much less the measurements counted beside the given poses, see reconstruct()
  double next_shared_error = 1;  ///< by how much less they would in another round
};

/// Matches overlapping keyframes, joins the matches to tracks, triangulates them and adjusts everything. Done in
/// rounds: as poses and mounts get better, what does not fit them is told apart more sharply. At last every feature
/// with a measured depth that no track has becomes a point, seen once.
///
/// Errors that many features share (of lens, time stamps, the way that a detector drifts as it comes nearer) do not
/// average out as their number says, and would bend the drive. They show where the poses end farther from those given
/// than these are uncertain; in each of the rounds after, measurements count for less beside them by as
/// much.
ReconstructionResult reconstruct(Reconstruction& scene, const MapBuilderOptions& options,
                                 const BuildProgress& progress);

/// The observations of a track with their views as they are now thought to be.
std::vector<Sighting> sightings(const Reconstruction& scene, const Track& track);

}  // namespace vmcl
