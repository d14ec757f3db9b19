// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "scene.h"
#include "vmcl/geometry/yaml_map.h"

namespace vmcl {

/// Reads what is there: include, prototypes, floors, walls, boxes, furniture, models, lamps and view, of `yaml` and of
/// the files it includes (looked for beside it, then in `include_directories`). Throws std::runtime_error naming file,
/// line and key.
Scene readScene(YamlMap& yaml, const std::vector<std::filesystem::path>& include_directories = {});

/// What a surface is covered with; `rgb` if it names no colour.
Material readMaterial(YamlMap yaml, const std::array<int, 3>& rgb = Material{}.rgb);

std::array<int, 3> readColor(YamlMap& yaml, const std::string& key, const std::array<int, 3>& fallback);

/// Lengths and places within 100 m.
Eigen::Vector2d readPoint(YamlMap& yaml, const std::string& key);
double readLength(YamlMap& yaml, const std::string& key, double fallback);

}  // namespace vmcl
