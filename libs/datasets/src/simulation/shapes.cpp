// SPDX-License-Identifier: BSD-3-Clause
#include "shapes.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace vmcl {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int around = 14;  // sides of a round body
constexpr int rings = 8;    // of a ball

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

/// A point of a round body's skin, with its outward normal there.
struct SkinPoint {
  Vector3d point;
  Vector3d normal;
};

/// The part of a skin between two rings of points, counted counter-clockwise as seen from above.
template <class PointAt>
void addRing(std::vector<Face>& faces, const PointAt& lower, const PointAt& upper, std::size_t surface, double width,
             double from_height, double to_height) {
  for (int i = 0; i < around; ++i) {
    const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * (i + 1) / around;
    const SkinPoint corners[] = {lower(a), lower(b), upper(b), upper(a)};
    Face face;
    for (int corner = 0; corner < 4; ++corner) {
      face.corners[corner] = corners[corner].point;
      face.normals[corner] = corners[corner].normal;
    }
    face.surface = surface;
    face.width = width / around;
    face.height = to_height - from_height;
    face.offset = {width * i / around, from_height};
    faces.push_back(face);
  }
}

}  // namespace

Face sideOf(const Solid& solid, Side side) {
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
  const Rigid3 map_from_face = toRigid3(solid.map_from_solid) * solid_from_face;
  face.corners = {map_from_face * Vector3d(0, 0, 0), map_from_face * Vector3d(face.width, 0, 0),
                  map_from_face * Vector3d(face.width, face.height, 0), map_from_face * Vector3d(0, face.height, 0)};
  face.normals.fill(map_from_face.linear().col(2));
  return face;
}

Vector3d normalOf(const Face& face) {
  return (face.corners[1] - face.corners[0]).cross(face.corners[3] - face.corners[0]).normalized();
}

std::size_t addSurface(Scene& scene, double width, double height, const Material& material, const Vector3d& normal) {
  scene.surfaces.push_back({width, height, material, {}, normal});
  return scene.surfaces.size() - 1;
}

void addSide(Scene& scene, std::size_t object, const Solid& solid, Side side, const Material& material) {
  Face face = sideOf(solid, side);
  face.surface = addSurface(scene, face.width, face.height, material, face.normals[0]);
  face.object = object;
  scene.faces.push_back(face);
}

void addBox(Scene& scene, std::size_t object, const Solid& solid, const Material& material,
            const std::optional<Material>& front) {
  for (const Side side : {Side::front, Side::back, Side::left, Side::right, Side::top, Side::bottom}) {
    if (side == Side::bottom && solid.bottom <= 0) continue;
    addSide(scene, object, solid, side, side == Side::front && front ? *front : material);
  }
}

void addLimb(std::vector<Face>& faces, const Limb& limb, std::size_t surface, double width, double height) {
  const Vector3d along = (limb.to - limb.from).normalized();
  const Vector3d x = (limb.wide_axis - limb.wide_axis.dot(along) * along).normalized();
  const Vector3d y = along.cross(x);
  const auto ring = [&](const Vector3d& center, double radius, bool is_end) {
    return [=](double angle) {
      const Vector3d outward = std::cos(angle) * x + limb.flatness * std::sin(angle) * y;
      const Vector3d normal = (limb.flatness * std::cos(angle) * x + std::sin(angle) * y).normalized();
      return SkinPoint{center + radius * outward, is_end ? along : normal};
    };
  };
  addRing(faces, ring(limb.from, limb.from_radius, false), ring(limb.to, limb.to_radius, false), surface, width, 0,
          height);
  const auto addEnd = [&](const Vector3d& center, double radius, double sign) {
    const std::size_t first = faces.size();
    addRing(faces, ring(center, sign > 0 ? radius : 0.0, true), ring(center, sign > 0 ? 0.0 : radius, true), surface,
            width, 0, std::min(radius, height));
    for (std::size_t i = first; i < faces.size(); ++i) faces[i].normals.fill(sign * along);
  };
  if (limb.from_end) addEnd(limb.from, limb.from_radius, -1);
  if (limb.to_end) addEnd(limb.to, limb.to_radius, 1);
}

void addBall(std::vector<Face>& faces, const Vector3d& center, const Vector3d& radii, std::size_t surface, double width,
             double height) {
  const auto ring = [&](double latitude) {
    return [=](double angle) {
      const Vector3d unit(std::cos(latitude) * std::cos(angle), std::cos(latitude) * std::sin(angle),
                          std::sin(latitude));
      return SkinPoint{center + radii.cwiseProduct(unit), unit.cwiseQuotient(radii).normalized()};
    };
  };
  for (int i = 0; i < rings; ++i) {
    const auto latitude = [&](int number) { return std::numbers::pi * (static_cast<double>(number) / rings - 0.5); };
    addRing(faces, ring(latitude(i)), ring(latitude(i + 1)), surface, width, height * i / rings,
            height * (i + 1) / rings);
  }
}

}  // namespace vmcl
