// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene.h"
#include "vmcl/geometry/yaml_map.h"

namespace vmcl {

/// The parts of each kind of furniture of a scene file, as they stand there.
using Prototypes = std::map<std::string, std::vector<YamlMap>>;

/// Reads one of `boxes` and adds it.
void addBoxFrom(Scene& scene, YamlMap yaml);

/// Reads one of `furniture`, a piece of a kind at a place, and adds its parts.
void addPieceFrom(Scene& scene, YamlMap yaml, const Prototypes& prototypes);

}  // namespace vmcl
