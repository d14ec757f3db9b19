// SPDX-License-Identifier: BSD-3-Clause
#include "scene_builder.h"

#include <algorithm>

namespace vmcl {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double floor_pixels_per_metre = 120;  // seen from low above, floors show no more than this

enum class Side { front, back, left, right, top, bottom };  // +x, -x, +y, -y, +z, -z of a solid

Vector3d normalOf(Side side) {
  switch (side) {
    case Side::front:
      return Vector3d::UnitX();
    case Side::back:
      return -Vector3d::UnitX();
    case Side::left:
      return Vector3d::UnitY();
    case Side::right:
      return -Vector3d::UnitY();
    case Side::top:
      return Vector3d::UnitZ();
    case Side::bottom:
      return -Vector3d::UnitZ();
  }
  return Vector3d::Zero();
}

/// The face of a side, without a surface yet.
Face faceOf(const Solid& solid, Side side) {
  const Vector3d half(solid.half_size.x(), solid.half_size.y(), (solid.top - solid.bottom) / 2);
  const Vector3d normal = normalOf(side);
  const bool upright = normal.z() == 0;
  const Vector3d up = upright ? Vector3d(0, 0, 1) : Vector3d(0, normal.z(), 0);
  const Vector3d right = up.cross(normal);
  Face face;
  face.width = 2 * right.cwiseAbs().dot(half);
  face.height = 2 * up.cwiseAbs().dot(half);
  Rigid3 solid_from_face = Rigid3::Identity();
  solid_from_face.linear() << right, up, normal;
  solid_from_face.translation() = Vector3d(0, 0, (solid.bottom + solid.top) / 2) +
                                  normal.cwiseAbs().dot(half) * normal - face.width / 2 * right - face.height / 2 * up;
  face.map_from_face = toRigid3(solid.map_from_solid) * solid_from_face;
  return face;
}

std::size_t addSurface(Scene& scene, double width, double height, const Material& material, const Vector3d& normal) {
  scene.surfaces.push_back({width, height, material, {}, normal});
  return scene.surfaces.size() - 1;
}

void addSide(Scene& scene, const Solid& solid, Side side, const Material& material) {
  Face face = faceOf(solid, side);
  face.surface = addSurface(scene, face.width, face.height, material, face.map_from_face.linear().col(2));
  scene.faces.push_back(face);
}

Solid slab(const Vector2d& low, const Vector2d& high, double bottom, double top) {
  const Vector2d center = (low + high) / 2;
  return {"", {center.x(), center.y(), 0}, (high - low) / 2, bottom, top};
}

/// The part of a wall between two places along it and two heights.
Solid piece(const Wall& wall, double from, double to, double bottom, double top) {
  return {wall.name,
          wall.map_from_wall * PlanarPose{(from + to) / 2, 0, 0},
          {(to - from) / 2, wall.thickness / 2},
          bottom,
          top};
}

struct WallSurfaces {
  std::size_t left;
  std::size_t right;
};

void addPiece(Scene& scene, const Wall& wall, const WallSurfaces& surfaces, double from, double to, double bottom) {
  if (to - from < 1e-6 || wall.height - bottom < 1e-6) return;
  const Solid solid = piece(wall, from, to, bottom, wall.height);
  Face left = faceOf(solid, Side::left), right = faceOf(solid, Side::right);
  left.surface = surfaces.left;
  left.offset = {wall.length - to, bottom};  // seen from the left, the wall runs from right to left
  right.surface = surfaces.right;
  right.offset = {from, bottom};
  scene.faces.push_back(left);
  scene.faces.push_back(right);
  const Material trim{"plain", {225, 222, 215}};
  if (bottom > 0) {
    addSide(scene, solid, Side::bottom, trim);
  } else {
    addSide(scene, solid, Side::front, trim);
    addSide(scene, solid, Side::back, trim);
  }
  scene.solids.push_back(solid);
}

}  // namespace

void addFloor(Scene& scene, const Vector2d& low, const Vector2d& high, const Material& material) {
  addSide(scene, slab(low, high, -0.1, 0), Side::top, material);
  scene.surfaces.back().pixels_per_metre = floor_pixels_per_metre;
}

void addCeiling(Scene& scene, const Vector2d& low, const Vector2d& high, double height, const Material& material) {
  addSide(scene, slab(low, high, height, height + 0.1), Side::bottom, material);
  scene.surfaces.back().pixels_per_metre = floor_pixels_per_metre;
}

void addWall(Scene& scene, const Wall& wall) {
  const Eigen::Matrix3d map_from_wall = toRigid3(wall.map_from_wall).linear();
  const WallSurfaces surfaces{
      addSurface(scene, wall.length, wall.height, wall.left, map_from_wall * Vector3d::UnitY()),
      addSurface(scene, wall.length, wall.height, wall.right, map_from_wall * -Vector3d::UnitY())};
  scene.surfaces[surfaces.left].decorations = wall.left_decorations;
  scene.surfaces[surfaces.right].decorations = wall.right_decorations;
  for (Decoration& decoration : scene.surfaces[surfaces.left].decorations)
    decoration.center.x() = wall.length - decoration.center.x();
  double from = 0;
  for (const Opening& opening : wall.openings) {
    addPiece(scene, wall, surfaces, from, opening.from, 0);
    addPiece(scene, wall, surfaces, opening.from, opening.to, opening.top);
    from = opening.to;
  }
  addPiece(scene, wall, surfaces, from, wall.length, 0);
}

void addBox(Scene& scene, const Box& box) {
  for (const Side side : {Side::front, Side::back, Side::left, Side::right, Side::top, Side::bottom}) {
    if (side == Side::bottom && box.solid.bottom <= 0) continue;
    addSide(scene, box.solid, side, side == Side::front && box.front ? *box.front : box.material);
  }
  scene.solids.push_back(box.solid);
}

}  // namespace vmcl
