// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "study_picture.h"

namespace vmcl {

/// success_WORLD_N_cameras.svg: a map a method, outlier rate across, depth rate up, each cell with its success rate and
/// interval. Throws as drawSvg does.
void drawSuccessMaps(const std::filesystem::path& directory, const StudyPicture& cells);

}  // namespace vmcl
