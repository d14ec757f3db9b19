// SPDX-License-Identifier: BSD-3-Clause
#include "scene.h"

#include <algorithm>

#include "decorations.h"
#include "materials.h"
#include "scene_builder.h"

namespace vmcl {
namespace {

using Eigen::Vector2d;
constexpr double max_extent = 100;  // m

Vector2d readPoint(YamlMap& yaml, const std::string& key) {
  const auto p = yaml.numbers(key, 2);
  if (std::max(std::abs(p[0]), std::abs(p[1])) > max_extent) yaml.fail(key, "is over 100 m away");
  return {p[0], p[1]};
}

double readLength(YamlMap& yaml, const std::string& key, double fallback) {
  const double length = yaml.get(key, fallback);
  if (!(length > 0.01 && length <= max_extent)) yaml.fail(key, "is not between 0.01 and 100 m");
  return length;
}

Material readMaterial(YamlMap yaml) {
  Material material;
  material.name = yaml.get<std::string>("material");
  if (!isMaterial(material.name)) yaml.fail("material", "is not one of " + materialNames());
  if (yaml.has("rgb")) {
    const auto rgb = yaml.numbers("rgb", 3);
    for (int i = 0; i < 3; ++i) {
      if (rgb[i] < 0 || rgb[i] > 255) yaml.fail("rgb", "is not within 0 and 255");
      material.rgb[i] = static_cast<int>(rgb[i]);
    }
  }
  yaml.finish();
  return material;
}

Decoration readDecoration(YamlMap yaml) {
  Decoration decoration;
  decoration.kind = yaml.get<std::string>("kind");
  if (!isDecoration(decoration.kind)) yaml.fail("kind", "is not one of " + decorationNames());
  decoration.center = readPoint(yaml, "center");
  decoration.size = readPoint(yaml, "size");
  if (decoration.size.minCoeff() < 0.05) yaml.fail("size", "is below 0.05 m");
  yaml.finish();
  return decoration;
}

std::vector<Decoration> readDecorations(YamlMap& wall, const std::string& key) {
  std::vector<Decoration> decorations;
  for (const YamlMap& yaml : wall.list(key)) decorations.push_back(readDecoration(yaml));
  return decorations;
}

std::vector<Opening> readDoors(YamlMap& wall_yaml, const Wall& wall) {
  std::vector<Opening> doors;
  for (YamlMap yaml : wall_yaml.list("doors")) {
    const double center = yaml.get<double>("at"), width = readLength(yaml, "width", 0.9);
    doors.push_back({center - width / 2, center + width / 2, readLength(yaml, "height", 2.05)});
    const double previous = doors.size() > 1 ? doors[doors.size() - 2].to : 0;
    if (doors.back().from < previous || doors.back().to > wall.length)
      yaml.fail("at", "puts the door outside of the wall or into the door before");
    if (doors.back().top > wall.height) yaml.fail("height", "is above the wall");
    yaml.finish();
  }
  return doors;
}

Wall readWall(YamlMap yaml, double height) {
  Wall wall;
  wall.name = yaml.get("name", std::string("wall"));
  const Vector2d from = readPoint(yaml, "from"), along = readPoint(yaml, "to") - from;
  wall.length = along.norm();
  if (wall.length < 0.1) yaml.fail("to", "makes a wall shorter than 0.1 m");
  wall.map_from_wall = {from.x(), from.y(), std::atan2(along.y(), along.x())};
  wall.thickness = readLength(yaml, "thickness", 0.12);
  wall.height = height;
  wall.left = readMaterial(yaml.map("left"));
  wall.right = readMaterial(yaml.map("right"));
  wall.openings = readDoors(yaml, wall);
  wall.left_decorations = readDecorations(yaml, "on_left");
  wall.right_decorations = readDecorations(yaml, "on_right");
  yaml.finish();
  return wall;
}

Box readBox(YamlMap yaml) {
  Box box;
  box.solid.name = yaml.get<std::string>("name");
  const Vector2d center = readPoint(yaml, "center");
  box.solid.map_from_solid = {center.x(), center.y(), yaml.get("yaw_deg", 0.0) * degree};
  const auto size = yaml.numbers("size", 3);
  for (const double length : size)
    if (!(length >= 0.01 && length <= max_extent)) yaml.fail("size", "is not between 0.01 and 100 m");
  box.solid.half_size = Vector2d(size[0], size[1]) / 2;
  box.solid.bottom = yaml.get("bottom", 0.0);
  if (box.solid.bottom < 0) yaml.fail("bottom", "is below the floor");
  box.solid.top = box.solid.bottom + size[2];
  box.material = readMaterial(yaml.map("sides"));
  if (yaml.has("front")) box.front = readMaterial(yaml.map("front"));
  yaml.finish();
  return box;
}

}  // namespace

double Solid::distance(const Vector2d& point_in_map) const {
  const PlanarPose p = inverse(map_from_solid) * PlanarPose{point_in_map.x(), point_in_map.y(), 0};
  return (Vector2d(p.x, p.y).cwiseAbs() - half_size).cwiseMax(0).norm();
}

Scene readScene(YamlMap& yaml) {
  Scene scene;
  const double wall_height = readLength(yaml, "wall_height", 2.6);
  Vector2d low = Vector2d::Constant(max_extent), high = -low;
  for (YamlMap floor : yaml.list("floors")) {
    const Vector2d a = readPoint(floor, "from"), b = readPoint(floor, "to");
    if (!((b - a).minCoeff() > 0.1)) floor.fail("to", "is not right of and above `from`");
    addFloor(scene, a, b, readMaterial(floor.map("cover")));
    floor.finish();
    low = low.cwiseMin(a);
    high = high.cwiseMax(b);
  }
  if (scene.faces.empty()) yaml.fail("floors", "is missing or empty");
  addCeiling(scene, low, high, wall_height, {"ceiling", {238, 236, 230}});
  for (const YamlMap& wall : yaml.list("walls")) addWall(scene, readWall(wall, wall_height));
  for (const YamlMap& box : yaml.list("boxes")) addBox(scene, readBox(box));
  return scene;
}

}  // namespace vmcl
