// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "vmcl/evaluation/localization_report.h"

namespace vmcl {

/// Draws the path over the map seen from above with gnuplot: occupied cells, landmarks and keyframes, the path, the
/// ground truth. `stem`.svg and `stem`.png, each written aside and renamed. Throws std::runtime_error naming the file
/// when gnuplot is missing, or fails and then with what it said.
void drawPath(const std::filesystem::path& stem, const LocalizationRun& run, const mrpt::maps::CMultiMetricMap& maps);

/// The map, the particles, the path and the ground truth for SceneViewer3D. Throws std::runtime_error naming the file.
void writeScene(const std::filesystem::path& file, const LocalizationRun& run, const Localizer& localizer);

}  // namespace vmcl
