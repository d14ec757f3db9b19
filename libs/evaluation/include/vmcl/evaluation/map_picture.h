// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>

#include "vmcl/mapping/keyframe_map.h"

namespace vmcl {

/// Shows a map: `stem`.svg and `stem`.png from above, the way of each session, keyframes and landmarks; `stem`.3Dscene
/// for MRPT's SceneViewer3D. Each is written aside and renamed. Throws std::runtime_error naming the file when it
/// cannot be written, or gnuplot is missing or fails.
void drawMap(const std::filesystem::path& stem, std::shared_ptr<const KeyframeMap> map);

}  // namespace vmcl
