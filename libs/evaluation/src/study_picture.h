// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "vmcl/evaluation/study_report.h"

namespace vmcl {

/// The cells that one picture or printed table shows: of one figure and world and, unless it is about them, of one
/// number of cameras. Never empty; all have rows for the same methods.
using StudyPicture = std::vector<const CellSummary*>;

std::vector<StudyPicture> picturesOf(const StudyRun& run, Figure figure);

/// "1 camera", "3 cameras".
std::string camerasOf(const WorldSettings& world);

/// "1_camera", "3_cameras": ends the name of a picture's file.
std::string fileSuffix(const WorldSettings& world);

}  // namespace vmcl
