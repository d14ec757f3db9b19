// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "vmcl/geometry/planar_pose.h"
#include "vmcl/geometry/yaml_map.h"

namespace vmcl {

/// What a surface is covered with: one of the names in materials.h, and its colour.
struct Material {
  std::string name;
  std::array<int, 3> rgb{200, 200, 200};
};

/// Something painted on a surface: its kind (decorations.h), centre and size in metres from the lower left corner.
struct Decoration {
  std::string kind;
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  Eigen::Vector2d size = Eigen::Vector2d::Zero();
};

/// A painted rectangle, of which faces show parts. Metres.
struct Surface {
  double width = 0;
  double height = 0;
  Material material;
  std::vector<Decoration> decorations;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< the side it is seen from, in the map
  double pixels_per_metre = 300;
};

/// A visible rectangle. Its frame: origin at the lower left corner, x right and y up as seen from the front, z towards
/// the viewer. It shows the surface from `offset` (m) on.
struct Face {
  Rigid3 map_from_face = Rigid3::Identity();
  double width = 0;
  double height = 0;
  std::size_t surface = 0;
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();
};

/// An upright box that blocks robot and laser beams.
struct Solid {
  std::string name;
  PlanarPose map_from_solid;  ///< at the centre of the footprint
  Eigen::Vector2d half_size = Eigen::Vector2d::Zero();
  double bottom = 0;
  double top = 0;

  /// Horizontal distance of a point on the ground from the footprint; 0 inside.
  double distance(const Eigen::Vector2d& point_in_map) const;
};

/// A furnished flat, map frame: x, y on the ground, z up.
struct Scene {
  std::vector<Surface> surfaces;
  std::vector<Face> faces;
  std::vector<Solid> solids;
};

/// Reads wall_height, floors, walls and boxes. Throws std::runtime_error naming file, line and key.
Scene readScene(YamlMap& yaml);

}  // namespace vmcl
