// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "vmcl/mapping/keyframe_map.h"

namespace vmcl {

/// Scene points at any pixel of a keyframe: where its depth was measured from that, else from the landmarks about the
/// pixel, if they are alike in depth.
class ReferenceDepth {
 public:
  /// The map must outlive it. `is_reliable` says of each landmark whether to rely on it.
  ReferenceDepth(const KeyframeMap& map, const Keyframe& keyframe, const std::vector<bool>& is_reliable);

  std::optional<MapPoint> at(const Eigen::Vector2d& ideal_pixel) const;

 private:
  struct KnownDepth {
    Eigen::Vector2d pixel;  ///< ideal
    double depth;           ///< m
  };
  struct DepthWithSigma {
    double depth, sigma;
  };

  std::optional<DepthWithSigma> measured(const Eigen::Vector2d& ideal_pixel) const;
  std::optional<DepthWithSigma> interpolated(const Eigen::Vector2d& ideal_pixel) const;

  const Keyframe& keyframe_;
  const MapCamera& camera_;
  Rigid3 map_from_camera_;
  std::vector<KnownDepth> landmarks_;
};

}  // namespace vmcl
