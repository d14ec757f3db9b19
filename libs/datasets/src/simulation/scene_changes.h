// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>

#include "scene.h"

namespace vmcl {

/// What is different from one session to the next, by the names of the objects.
struct SceneChanges {
  std::map<std::string, PlanarPose> moved;  ///< map_from_object from now on
  std::set<std::string> removed;
};

/// Surfaces keep their looks, whatever is moved or removed. Throws std::invalid_argument for a name that no object or
/// several objects have.
void applyChanges(Scene& scene, const SceneChanges& changes);

}  // namespace vmcl
