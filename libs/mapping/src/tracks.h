// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "reconstruction.h"

namespace vmcl {

/// Two features taken for the same scene point; a smaller ratio is more trusted.
struct ObservationMatch {
  Observation first;
  Observation second;
  float ratio = 1;
};

/// Joins matches to tracks, the most trusted first; a match that would put two features of one keyframe into a track is
/// left out. Only tracks of at least `min_length` observations are returned, by their first observation.
std::vector<Track> joinTracks(std::span<const int> feature_counts, std::vector<ObservationMatch> matches,
                              int min_length);

}  // namespace vmcl
