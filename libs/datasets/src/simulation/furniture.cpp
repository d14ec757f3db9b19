// SPDX-License-Identifier: BSD-3-Clause
#include "furniture.h"

#include <numbers>

#include "scene_reader.h"
#include "shapes.h"

namespace vmcl {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Where a piece of furniture is, and its colour where a part names none.
struct Piece {
  PlanarPose map_from_piece;
  double bottom = 0;
  std::array<int, 3> rgb{200, 200, 200};
  std::size_t object = 0;
};

double readHeight(YamlMap& yaml, const std::string& key, double fallback) {
  const double height = yaml.get(key, fallback);
  if (!(height >= 0 && height <= 20)) yaml.fail(key, "is not between 0 and 20 m");
  return height;
}

Vector3d readSize(YamlMap& yaml) {
  const auto size = yaml.numbers("size", 3);
  for (const double length : size)
    if (!(length >= 0.005 && length <= 100)) yaml.fail("size", "is not between 0.005 and 100 m");
  return {size[0], size[1], size[2]};
}

void addBoxPart(Scene& scene, YamlMap& yaml, const Piece& piece, const Vector2d& center, double bottom) {
  const Vector3d size = readSize(yaml);
  const PlanarPose piece_from_part{center.x(), center.y(), yaml.get("yaw_deg", 0.0) * degree};
  const Material cover = readMaterial(yaml.map("cover"), piece.rgb);
  std::optional<Material> front;
  if (yaml.has("front")) front = readMaterial(yaml.map("front"), piece.rgb);
  const std::size_t first = scene.surfaces.size();
  addBox(scene, piece.object, {piece.map_from_piece * piece_from_part, size.head<2>() / 2, bottom, bottom + size.z()},
         cover, front);
  if (yaml.get("glows", false))
    for (std::size_t i = first; i < scene.surfaces.size(); ++i)
      scene.surfaces[i].glows = !front || i == first;  // with a front, the front alone
}

void addRoundPart(Scene& scene, YamlMap& yaml, const Piece& piece, const Vector2d& center, double bottom,
                  const std::string& shape) {
  const double radius = readLength(yaml, "radius", 0.1), height = readLength(yaml, "height", 0.1);
  const Material cover = readMaterial(yaml.map("cover"), piece.rgb);
  const double width = 2 * std::numbers::pi * radius;
  const std::size_t surface = addSurface(scene, width, height, cover, Vector3d::UnitX());
  scene.surfaces[surface].glows = yaml.get("glows", false);
  const PlanarPose map_from_part = piece.map_from_piece * PlanarPose{center.x(), center.y(), 0};
  const Vector3d foot(map_from_part.x, map_from_part.y, bottom);
  const std::size_t first = scene.faces.size();
  if (shape == "cylinder") {
    const double top_radius = yaml.get("top_radius", radius);
    if (!(top_radius >= 0 && top_radius <= 100)) yaml.fail("top_radius", "is not between 0 and 100 m");
    addLimb(scene.faces, {foot, foot + Vector3d(0, 0, height), radius, top_radius}, surface, width, height);
  } else {
    addBall(scene.faces, foot + Vector3d(0, 0, height / 2), {radius, radius, height / 2}, surface, width, height);
  }
  for (std::size_t i = first; i < scene.faces.size(); ++i) scene.faces[i].object = piece.object;
}

void addPart(Scene& scene, YamlMap yaml, const Piece& piece) {
  const auto shape = yaml.get<std::string>("shape");
  const Vector2d center = readPoint(yaml, "center");
  const double bottom = piece.bottom + readHeight(yaml, "bottom", 0);
  if (shape == "box") {
    addBoxPart(scene, yaml, piece, center, bottom);
  } else if (shape == "cylinder" || shape == "ball") {
    addRoundPart(scene, yaml, piece, center, bottom, shape);
  } else {
    yaml.fail("shape", "is not one of box, cylinder, ball");
  }
  yaml.finish();
}

}  // namespace

void addBoxFrom(Scene& scene, YamlMap yaml) {
  const auto name = yaml.get<std::string>("name");
  const Vector2d center = readPoint(yaml, "center");
  const PlanarPose map_from_box{center.x(), center.y(), yaml.get("yaw_deg", 0.0) * degree};
  const Vector3d size = readSize(yaml);
  const double bottom = readHeight(yaml, "bottom", 0);
  const Material sides = readMaterial(yaml.map("sides"));
  std::optional<Material> front;
  if (yaml.has("front")) front = readMaterial(yaml.map("front"));
  yaml.finish();
  addBox(scene, scene.addObject(name, map_from_box), {map_from_box, size.head<2>() / 2, bottom, bottom + size.z()},
         sides, front);
}

void addPieceFrom(Scene& scene, YamlMap yaml, const Prototypes& prototypes) {
  const auto kind = yaml.get<std::string>("kind");
  const auto parts = prototypes.find(kind);
  if (parts == prototypes.end()) yaml.fail("kind", "is not one of the prototypes");
  const auto at = yaml.numbers("at", 3);
  Piece piece;
  piece.map_from_piece = {at[0], at[1], at[2] * degree};
  piece.bottom = readHeight(yaml, "bottom", 0);
  piece.rgb = readColor(yaml, "rgb", piece.rgb);
  piece.object = scene.addObject(yaml.get("name", kind), piece.map_from_piece);
  yaml.finish();
  for (const YamlMap& part : parts->second) addPart(scene, part, piece);
}

}  // namespace vmcl
