// SPDX-License-Identifier: BSD-3-Clause
#include "study_picture.h"

#include <algorithm>

namespace vmcl {

std::vector<StudyPicture> picturesOf(const StudyRun& run, Figure figure) {
  std::vector<StudyPicture> pictures;
  const auto belong = [&](const WorldSettings& a, const WorldSettings& b) {
    return a.world == b.world && (a.cameras == b.cameras || figure == Figure::cost_of_cameras);
  };
  for (const CellSummary& cell : run.cells) {
    if (cell.cell.figure != figure) continue;
    if (pictures.empty() || !belong(pictures.back().front()->cell.world, cell.cell.world)) pictures.emplace_back();
    pictures.back().push_back(&cell);
  }
  return pictures;
}

std::string camerasOf(const WorldSettings& world) {
  return std::to_string(world.cameras) + (world.cameras == 1 ? " camera" : " cameras");
}

std::string fileSuffix(const WorldSettings& world) {
  std::string suffix = camerasOf(world);
  std::replace(suffix.begin(), suffix.end(), ' ', '_');
  return suffix;
}

}  // namespace vmcl
