// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/pose_density.h"

#include <algorithm>
#include <cmath>

namespace vmcl {
namespace {

/// Lower of the two cells about a coordinate, and the share of the upper one.
struct Neighbours {
  int64_t lower;
  double upper_share;
};

Neighbours neighbours(double coordinate, double cell) {
  constexpr double last = 0x1p27 - 2;  // of the keys; what lies beyond is put there
  const double position = std::clamp(coordinate / cell, -last, last), lower = std::floor(position);
  return {static_cast<int64_t>(lower), position - lower};
}

uint64_t keyOf(int64_t x, int64_t y, int64_t phi) {
  constexpr uint64_t mask = (uint64_t{1} << 28) - 1;
  const int64_t turn = PoseDensity::cells_per_turn;
  return (static_cast<uint64_t>(x) & mask) << 36 | (static_cast<uint64_t>(y) & mask) << 8 |
         static_cast<uint64_t>(((phi % turn) + turn) % turn);
}

}  // namespace

template <typename Visit>
void PoseDensity::visitCellsAround(const PlanarPose& pose, Visit&& visit) {
  const Neighbours x = neighbours(pose.x, cell_position), y = neighbours(pose.y, cell_position),
                   phi = neighbours(pose.phi, cell_heading);
  for (int corner = 0; corner < 8; ++corner) {
    const bool up_x = corner & 1, up_y = corner & 2, up_phi = corner & 4;
    const double share = (up_x ? x.upper_share : 1 - x.upper_share) * (up_y ? y.upper_share : 1 - y.upper_share) *
                         (up_phi ? phi.upper_share : 1 - phi.upper_share);
    if (share > 0) visit(keyOf(x.lower + up_x, y.lower + up_y, phi.lower + up_phi), share);
  }
}

void PoseDensity::add(const PlanarPose& pose, double weight) {
  visitCellsAround(pose, [&](uint64_t key, double share) { cells_[key] += weight * share; });
}

double PoseDensity::operator()(const PlanarPose& pose) const {
  double mass = 0;
  visitCellsAround(pose, [&](uint64_t key, double share) {
    if (const auto cell = cells_.find(key); cell != cells_.end()) mass += cell->second * share;
  });
  return mass / (cell_position * cell_position * cell_heading);
}

}  // namespace vmcl
