// SPDX-License-Identifier: BSD-3-Clause
#include "walls.h"

#include <cmath>
#include <numbers>

#include "shapes.h"

namespace vmcl {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double floor_pixels_per_metre = 120;  // seen from low above, floors show no more than this
const Material trim{"plain", {225, 222, 215}};

Solid slab(const Vector2d& low, const Vector2d& high, double bottom, double top) {
  const Vector2d center = (low + high) / 2;
  return {{center.x(), center.y(), 0}, (high - low) / 2, bottom, top};
}

/// A wall on its way into the scene.
struct WallInScene {
  Scene& scene;
  const Wall& wall;
  std::size_t object;
  std::size_t left_surface;
  std::size_t right_surface;

  Solid solid(double from, double to, double bottom, double top, double thickness) const {
    return {wall.map_from_wall * PlanarPose{(from + to) / 2, 0, 0}, {(to - from) / 2, thickness / 2}, bottom, top};
  }

  /// The part between two places along the wall and two heights, with trims where it ends below the wall's own ends.
  void addPiece(double from, double to, double bottom, double top) const {
    if (to - from < 1e-6 || top - bottom < 1e-6) return;
    const Solid piece = solid(from, to, bottom, top, wall.thickness);
    Face left = sideOf(piece, Side::left), right = sideOf(piece, Side::right);
    left.surface = left_surface;
    left.offset = {wall.length - to, bottom};  // seen from the left, the wall runs from right to left
    right.surface = right_surface;
    right.offset = {from, bottom};
    for (Face* face : {&left, &right}) {
      face->object = object;
      scene.faces.push_back(*face);
    }
    const bool above_opening = bottom > 0, below_opening = top < wall.height;
    if (above_opening) addSide(scene, object, piece, Side::bottom, trim);
    if (below_opening) addSide(scene, object, piece, Side::top, trim);
    if (above_opening || below_opening) return;
    addSide(scene, object, piece, Side::front, trim);
    addSide(scene, object, piece, Side::back, trim);
  }

  void addWindowFrame(const Opening& opening) const {
    constexpr double thick = 0.05, deep = 0.06;
    const double middle = (opening.from + opening.to) / 2, low = opening.bottom + thick, high = opening.top - thick;
    const auto bar = [&](double from, double to, double bottom, double top) {
      addBox(scene, object, solid(from, to, bottom, top, deep), trim, {});
    };
    bar(opening.from, opening.to, opening.bottom, low);
    bar(opening.from, opening.to, high, opening.top);
    bar(opening.from, opening.from + thick, low, high);
    bar(opening.to - thick, opening.to, low, high);
    bar(middle - thick / 2, middle + thick / 2, low, high);
    const Rigid3 map_from_wall = toRigid3(wall.map_from_wall);
    scene.lamps.push_back({Lamp::Kind::window, map_from_wall * Vector3d(middle, 0, (low + high) / 2),
                           map_from_wall.linear() * Vector3d((opening.to - opening.from) / 2, 0, 0),
                           Vector3d(0, 0, (high - low) / 2), 1});
  }
};

}  // namespace

void addFloor(Scene& scene, const Vector2d& low, const Vector2d& high, const Material& material) {
  addSide(scene, scene.addObject("floor"), slab(low, high, -0.1, 0), Side::top, material);
  scene.surfaces.back().pixels_per_metre = floor_pixels_per_metre;
}

void addCeiling(Scene& scene, const Vector2d& low, const Vector2d& high, double height, const Material& material) {
  addSide(scene, scene.addObject("ceiling"), slab(low, high, height, height + 0.1), Side::bottom, material);
  scene.surfaces.back().pixels_per_metre = floor_pixels_per_metre;
}

void addWall(Scene& scene, const Wall& wall) {
  const Eigen::Matrix3d map_from_wall = toRigid3(wall.map_from_wall).linear();
  const std::size_t left = addSurface(scene, wall.length, wall.height, wall.left, map_from_wall * Vector3d::UnitY());
  const std::size_t right = addSurface(scene, wall.length, wall.height, wall.right, map_from_wall * -Vector3d::UnitY());
  scene.surfaces[left].decorations = wall.left_decorations;
  scene.surfaces[right].decorations = wall.right_decorations;
  for (Decoration& decoration : scene.surfaces[left].decorations)
    decoration.center.x() = wall.length - decoration.center.x();
  const WallInScene in_scene{scene, wall, scene.addObject(wall.name), left, right};
  double from = 0;
  for (const Opening& opening : wall.openings) {
    in_scene.addPiece(from, opening.from, 0, wall.height);
    in_scene.addPiece(opening.from, opening.to, opening.top, wall.height);
    in_scene.addPiece(opening.from, opening.to, 0, opening.bottom);
    if (opening.bottom > 0) in_scene.addWindowFrame(opening);
    from = opening.to;
  }
  in_scene.addPiece(from, wall.length, 0, wall.height);
}

void addBackdrop(Scene& scene, const Vector2d& center, const std::string& kind) {
  constexpr int sides = 48;
  constexpr double radius = 60, low = -24, high = 36, circumference = 2 * std::numbers::pi * radius;
  const std::size_t surface = addSurface(scene, circumference, high - low, {kind, {200, 200, 200}}, Vector3d::UnitZ());
  scene.surfaces[surface].glows = true;
  scene.surfaces[surface].pixels_per_metre = 16;
  const auto at = [&](int side, double z) {
    const double angle = -2 * std::numbers::pi * side / sides;  // seen from inside, it runs clockwise
    return Vector3d(center.x() + radius * std::cos(angle), center.y() + radius * std::sin(angle), z);
  };
  for (int side = 0; side < sides; ++side) {
    Face face;
    face.corners = {at(side, low), at(side + 1, low), at(side + 1, high), at(side, high)};
    face.width = circumference / sides;
    face.height = high - low;
    face.surface = surface;
    face.offset = {face.width * side, 0};
    face.normals.fill(normalOf(face));
    scene.backdrop.push_back(face);
  }
}

}  // namespace vmcl
