// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "vmcl/geometry/planar_pose.h"

namespace vmcl {

struct ModelMesh;

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
  bool glows = false;  ///< shines by itself: a lamp, a screen, the view from a window
};

/// A visible quadrangle: corners in the map, counter-clockwise from the lower left one as seen from the front, with the
/// outward normals there (round bodies are smooth). It shows `width` x `height` of the surface from `offset` (m) on.
struct Face {
  std::array<Eigen::Vector3d, 4> corners;
  std::array<Eigen::Vector3d, 4> normals;
  double width = 0;
  double height = 0;
  std::size_t surface = 0;
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();
  std::size_t object = 0;
};

/// A mesh from a file, placed in the map.
struct Model {
  std::shared_ptr<const ModelMesh> mesh;
  Rigid3 map_from_model = Rigid3::Identity();
  double scale = 1;
  std::size_t object = 0;
};

/// What a robot may run into, and what a session may move or remove.
struct Object {
  std::string name;
  PlanarPose map_from_object;
  bool present = true;
};

/// A light that shines from a rectangle: a lamp downwards and to the sides, a window to both sides.
struct Lamp {
  enum class Kind { lamp, window };
  Kind kind = Kind::lamp;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d half_right = Eigen::Vector3d::Zero();  ///< half of the rectangle's sides (m)
  Eigen::Vector3d half_up = Eigen::Vector3d::Zero();
  double power = 1;  ///< relative to a common ceiling lamp, or to a window by day
};

/// Furnished rooms, map frame: x, y on the ground, z up. Walls and furniture are faces, models are read from files.
struct Scene {
  std::vector<Surface> surfaces;
  std::vector<Face> faces;
  std::vector<Model> models;
  std::vector<Object> objects;
  std::vector<Lamp> lamps;     ///< none: the scene is lit evenly
  std::vector<Face> backdrop;  ///< the view from the windows: seen, but neither touched nor scanned

  std::size_t addObject(const std::string& name, const PlanarPose& map_from_object = {});
};

}  // namespace vmcl
