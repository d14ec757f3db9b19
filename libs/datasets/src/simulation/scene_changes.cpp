// SPDX-License-Identifier: BSD-3-Clause
#include "scene_changes.h"

#include <algorithm>
#include <stdexcept>

namespace vmcl {
namespace {

std::size_t objectNamed(const Scene& scene, const std::string& name) {
  const auto has_name = [&](const Object& object) { return object.name == name; };
  const auto found = std::find_if(scene.objects.begin(), scene.objects.end(), has_name);
  if (found == scene.objects.end()) throw std::invalid_argument(name + " is not in the scene");
  if (std::find_if(found + 1, scene.objects.end(), has_name) != scene.objects.end())
    throw std::invalid_argument(name + " is there more than once");
  return static_cast<std::size_t>(found - scene.objects.begin());
}

void move(Scene& scene, std::size_t object, const PlanarPose& map_from_object) {
  const Rigid3 moved_from_map = toRigid3(map_from_object * inverse(scene.objects[object].map_from_object));
  scene.objects[object].map_from_object = map_from_object;
  std::set<std::size_t> surfaces;
  for (Face& face : scene.faces) {
    if (face.object != object) continue;
    for (Eigen::Vector3d& corner : face.corners) corner = moved_from_map * corner;
    for (Eigen::Vector3d& normal : face.normals) normal = moved_from_map.linear() * normal;
    surfaces.insert(face.surface);
  }
  for (const std::size_t surface : surfaces)
    scene.surfaces[surface].normal = moved_from_map.linear() * scene.surfaces[surface].normal;
  for (Model& model : scene.models)
    if (model.object == object) model.map_from_model = moved_from_map * model.map_from_model;
}

}  // namespace

std::size_t Scene::addObject(const std::string& name, const PlanarPose& map_from_object) {
  objects.push_back({name, map_from_object});
  return objects.size() - 1;
}

void applyChanges(Scene& scene, const SceneChanges& changes) {
  for (const auto& [name, map_from_object] : changes.moved) move(scene, objectNamed(scene, name), map_from_object);
  for (const std::string& name : changes.removed) scene.objects[objectNamed(scene, name)].present = false;
  const auto is_gone = [&](const auto& part) { return !scene.objects[part.object].present; };
  std::erase_if(scene.faces, is_gone);
  std::erase_if(scene.models, is_gone);
}

}  // namespace vmcl
