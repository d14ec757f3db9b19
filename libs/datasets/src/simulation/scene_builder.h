// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene.h"

namespace vmcl {

struct Opening {
  double from = 0;  ///< m along the wall
  double to = 0;
  double top = 0;  ///< height (m)
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

struct Box {
  Solid solid;
  Material material;
  std::optional<Material> front;  ///< of the side towards +x of the box
};

void addFloor(Scene& scene, const Eigen::Vector2d& low, const Eigen::Vector2d& high, const Material& material);
void addCeiling(Scene& scene, const Eigen::Vector2d& low, const Eigen::Vector2d& high, double height,
                const Material& material);
void addWall(Scene& scene, const Wall& wall);
void addBox(Scene& scene, const Box& box);

}  // namespace vmcl
