// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "vmcl/relocalization/relocalizer.h"
#include "vmcl/study/pose_method.h"

namespace vmcl {

/// Other ways to a pose from the same matches: vmcl with each kind of samples, and the methods of the study that take
/// rigs, among them Mix (Jiao et al. 2020, section IV-B), the paper's 1P1DP or 2DP as the map's keyframes say.
class PeerMethods {
 public:
  PeerMethods(const KeyframeMap& map, const RelocalizerOptions& options);

  /// By name; nothing where none is found.
  std::vector<std::pair<std::string, std::optional<PlanarPose>>> poses(const RelocalizationResult& matched) const;

 private:
  const KeyframeMap& map_;
  RelocalizerOptions options_;
  std::vector<PoseMethod> methods_;
};

/// Keyframes that the matches are with, and how many are with each.
std::vector<std::pair<int, int>> referencesOf(const RelocalizationResult& matched);

}  // namespace vmcl
