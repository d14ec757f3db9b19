// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "scene.h"

namespace vmcl {

/// A doorway, or a window if it does not begin at the floor.
struct Opening {
  double from = 0;  ///< m along the wall
  double to = 0;
  double bottom = 0;  ///< height (m)
  double top = 0;
};

/// A straight wall from `start` along the x axis of its frame; left is its +y side.
struct Wall {
  std::string name;
  PlanarPose map_from_wall;  ///< at the start, on the centre line
  double length = 0;
  double thickness = 0;
  double height = 0;
  Material left;
  Material right;
  std::vector<Opening> openings;  ///< by increasing `from`, not overlapping
  std::vector<Decoration> left_decorations;
  std::vector<Decoration> right_decorations;
};

void addFloor(Scene& scene, const Eigen::Vector2d& low, const Eigen::Vector2d& high, const Material& material);
void addCeiling(Scene& scene, const Eigen::Vector2d& low, const Eigen::Vector2d& high, double height,
                const Material& material);

/// Windows get a frame and let daylight in.
void addWall(Scene& scene, const Wall& wall);

/// A distant view all around the place given, painted with the material `kind`.
void addBackdrop(Scene& scene, const Eigen::Vector2d& center, const std::string& kind);

}  // namespace vmcl
