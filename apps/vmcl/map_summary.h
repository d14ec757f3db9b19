// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vmcl/mapping/map_builder.h"

namespace vmcl {

/// What was kept of the images and why, on stdout.
void printSummary(const MapBuildReport& report, const KeyframeMap& map);

/// What a map file holds: size, extents, sessions, landmarks, cameras, on stdout.
void printInfo(const std::filesystem::path& file, const KeyframeMap& map);

/// The sessions that share no landmark with any other, where there are several: nothing ties them to the others but the
/// poses that they were given.
std::vector<int> sessionsApart(const KeyframeMap& map);

}  // namespace vmcl
