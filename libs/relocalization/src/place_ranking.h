// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "vmcl/relocalization/relocalizer.h"
#include "vmcl/vision/place_recognition.h"

namespace vmcl {

/// The `options.retrieved` keyframes among the places of whose matches most are expected to be right, best first; ties
/// as the places came. All places, as they came, where there is no choice. The strongest features of the query alone
/// are matched, which tells places apart at a third of the time.
std::vector<int> bestMatched(std::span<const RetrievedPlace> places, const FeatureSet& query, const KeyframeMap& map,
                             const RelocalizerOptions& options);

}  // namespace vmcl
