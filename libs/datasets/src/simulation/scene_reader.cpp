// SPDX-License-Identifier: BSD-3-Clause
#include "scene_reader.h"

#include <algorithm>

#include "decorations.h"
#include "furniture.h"
#include "materials.h"
#include "model_mesh.h"
#include "walls.h"

namespace vmcl {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
constexpr double max_extent = 100;  // m
constexpr int max_includes = 4;     // nested

std::vector<Decoration> readDecorations(YamlMap& wall, const std::string& key) {
  std::vector<Decoration> decorations;
  for (YamlMap yaml : wall.list(key)) {
    Decoration decoration;
    decoration.kind = yaml.get<std::string>("kind");
    if (!isDecoration(decoration.kind)) yaml.fail("kind", "is not one of " + decorationNames());
    decoration.center = readPoint(yaml, "center");
    decoration.size = readPoint(yaml, "size");
    if (decoration.size.minCoeff() < 0.05) yaml.fail("size", "is below 0.05 m");
    yaml.finish();
    decorations.push_back(decoration);
  }
  return decorations;
}

Opening readOpening(YamlMap yaml, const Wall& wall, bool is_window) {
  const double center = yaml.get<double>("at"), width = readLength(yaml, "width", 0.9);
  Opening opening{center - width / 2, center + width / 2, 0, 0};
  if (is_window) opening.bottom = readLength(yaml, "sill", 0.9);
  opening.top = opening.bottom + readLength(yaml, "height", is_window ? 1.2 : 2.05);
  if (opening.from < 0 || opening.to > wall.length)
    yaml.fail("at", std::string("puts the ") + (is_window ? "window" : "door") + " outside of the wall");
  if (opening.top > wall.height) yaml.fail("height", "is above the wall");
  yaml.finish();
  return opening;
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
  for (const YamlMap& door : yaml.list("doors")) wall.openings.push_back(readOpening(door, wall, false));
  for (const YamlMap& window : yaml.list("windows")) wall.openings.push_back(readOpening(window, wall, true));
  std::sort(wall.openings.begin(), wall.openings.end(), [](const auto& a, const auto& b) { return a.from < b.from; });
  for (std::size_t i = 1; i < wall.openings.size(); ++i)
    if (wall.openings[i].from < wall.openings[i - 1].to) yaml.fail("doors", "and windows overlap");
  wall.left_decorations = readDecorations(yaml, "on_left");
  wall.right_decorations = readDecorations(yaml, "on_right");
  yaml.finish();
  return wall;
}

Lamp readLamp(YamlMap yaml) {
  Lamp lamp;
  const auto at = yaml.numbers("at", 3), size = yaml.has("size") ? yaml.numbers("size", 2) : std::vector{0.4, 0.4};
  const bool is_window = yaml.get("window", false);
  const double yaw = yaml.get("yaw_deg", 0.0) * degree;
  lamp.kind = is_window ? Lamp::Kind::window : Lamp::Kind::lamp;
  lamp.center = {at[0], at[1], at[2]};
  const Vector3d x(std::cos(yaw), std::sin(yaw), 0), y(-std::sin(yaw), std::cos(yaw), 0);
  lamp.half_right = size[0] / 2 * x;
  lamp.half_up = size[1] / 2 * (is_window ? Vector3d::UnitZ() : y);
  lamp.power = yaml.get("power", 1.0);
  if (!(lamp.power >= 0 && lamp.power <= 100)) yaml.fail("power", "is not between 0 and 100");
  yaml.finish();
  return lamp;
}

/// Reads a scene and the scenes it includes.
class SceneReader {
 public:
  explicit SceneReader(const std::vector<std::filesystem::path>& directories) : directories_(directories) {}

  void read(YamlMap& yaml, int depth = 0) {
    if (depth > max_includes) yaml.fail("include", "goes around in circles");
    if (yaml.has("include"))
      for (const std::string& name : yaml.texts("include")) {
        YamlMap included = YamlMap::read(find(yaml, name));
        read(included, depth + 1);
        included.finish();
      }
    if (yaml.has("prototypes")) readPrototypes(yaml.map("prototypes"));
    readRoom(yaml);
    for (const YamlMap& box : yaml.list("boxes")) addBoxFrom(scene_, box);
    for (const YamlMap& piece : yaml.list("furniture")) addPieceFrom(scene_, piece, prototypes_);
    for (const YamlMap& model : yaml.list("models")) addModel(model);
    for (const YamlMap& lamp : yaml.list("lamps")) scene_.lamps.push_back(readLamp(lamp));
    if (yaml.has("view")) readView(yaml.map("view"));
  }

  Scene scene() { return std::move(scene_); }

 private:
  std::filesystem::path find(YamlMap& yaml, const std::string& name) const {
    if (const auto beside = yaml.directory() / name; std::filesystem::exists(beside)) return beside;
    for (const auto& directory : directories_)
      if (const auto file = directory / name; std::filesystem::exists(file)) return file;
    yaml.fail("include", "names " + name + ", which is neither beside the file nor in a directory of --include");
  }

  void readPrototypes(YamlMap yaml) {
    for (const std::string& kind : yaml.keys()) prototypes_[kind] = yaml.list(kind);
  }

  void readRoom(YamlMap& yaml) {
    const double wall_height = readLength(yaml, "wall_height", 2.6);
    Vector2d low = Vector2d::Constant(max_extent), high = -low;
    const auto floors = yaml.list("floors");
    for (YamlMap floor : floors) {
      const Vector2d a = readPoint(floor, "from"), b = readPoint(floor, "to");
      if (!((b - a).minCoeff() > 0.1)) floor.fail("to", "is not right of and above `from`");
      addFloor(scene_, a, b, readMaterial(floor.map("cover")));
      floor.finish();
      low = low.cwiseMin(a);
      high = high.cwiseMax(b);
    }
    const Material cover =
        yaml.has("ceiling") ? readMaterial(yaml.map("ceiling")) : Material{"ceiling", {238, 236, 230}};
    if (!floors.empty()) addCeiling(scene_, low, high, wall_height, cover);
    for (const YamlMap& wall : yaml.list("walls")) addWall(scene_, readWall(wall, wall_height));
  }

  void addModel(YamlMap yaml) {
    const auto name = yaml.get<std::string>("name");
    const auto file = yaml.directory() / yaml.get<std::string>("uri");
    const auto pose = yaml.numbers("pose", 6);
    const double scale = yaml.get("scale", 1.0);
    if (!(scale > 1e-4 && scale < 1e4)) yaml.fail("scale", "is not between 0.0001 and 10000");
    const auto up = yaml.get("up_axis", std::string("Z_UP"));
    if (up != "Z_UP" && up != "Y_UP") yaml.fail("up_axis", "is neither Z_UP nor Y_UP");
    yaml.finish();
    Rigid3 map_from_model(
        Eigen::Translation3d(pose[0], pose[1], pose[2]) * Eigen::AngleAxisd(pose[3], Vector3d::UnitZ()) *
        Eigen::AngleAxisd(pose[4], Vector3d::UnitY()) * Eigen::AngleAxisd(pose[5], Vector3d::UnitX()));
    if (up == "Y_UP") map_from_model.rotate(Eigen::AngleAxisd(90 * degree, Vector3d::UnitX()));
    auto& mesh = meshes_[file];
    try {
      if (!mesh) mesh = std::make_shared<ModelMesh>(readModelMesh(file));
    } catch (const std::runtime_error& error) {
      yaml.fail("uri", std::string(": ") + error.what());
    }
    for (const ModelPart& part : mesh->parts)
      for (const ModelPart::Vertex& vertex : part.vertices)
        if (!(scale * vertex.point.norm() <= max_extent)) yaml.fail("scale", "makes the mesh larger than 100 m");
    scene_.models.push_back(
        {mesh, map_from_model, scale, scene_.addObject(name, PlanarPose{pose[0], pose[1], pose[3]})});
  }

  void readView(YamlMap yaml) {
    const auto kind = yaml.get<std::string>("kind");
    if (!isMaterial(kind)) yaml.fail("kind", "is not one of " + materialNames());
    addBackdrop(scene_, readPoint(yaml, "center"), kind);
    yaml.finish();
  }

  const std::vector<std::filesystem::path>& directories_;
  Scene scene_;
  Prototypes prototypes_;
  std::map<std::filesystem::path, std::shared_ptr<const ModelMesh>> meshes_;
};

}  // namespace

Vector2d readPoint(YamlMap& yaml, const std::string& key) {
  const auto p = yaml.numbers(key, 2);
  if (std::max(std::abs(p[0]), std::abs(p[1])) > max_extent) yaml.fail(key, "is over 100 m away");
  return {p[0], p[1]};
}

double readLength(YamlMap& yaml, const std::string& key, double fallback) {
  const double length = yaml.get(key, fallback);
  if (!(length > 0.005 && length <= max_extent)) yaml.fail(key, "is not between 0.005 and 100 m");
  return length;
}

std::array<int, 3> readColor(YamlMap& yaml, const std::string& key, const std::array<int, 3>& fallback) {
  if (!yaml.has(key)) return fallback;
  const auto rgb = yaml.numbers(key, 3);
  std::array<int, 3> color{};
  for (int i = 0; i < 3; ++i) {
    if (rgb[i] < 0 || rgb[i] > 255) yaml.fail(key, "is not within 0 and 255");
    color[i] = static_cast<int>(rgb[i]);
  }
  return color;
}

Material readMaterial(YamlMap yaml, const std::array<int, 3>& rgb) {
  Material material;
  material.name = yaml.get<std::string>("material");
  if (!isMaterial(material.name)) yaml.fail("material", "is not one of " + materialNames());
  material.rgb = readColor(yaml, "rgb", rgb);
  yaml.finish();
  return material;
}

Scene readScene(YamlMap& yaml, const std::vector<std::filesystem::path>& include_directories) {
  SceneReader reader(include_directories);
  reader.read(yaml);
  Scene scene = reader.scene();
  if (scene.faces.empty() && scene.models.empty()) yaml.fail("floors", "are missing, and so is all else");
  return scene;
}

}  // namespace vmcl
