// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/pose_density.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

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

/// Where the key is, or would be put.
std::size_t PoseDensity::slotOf(uint64_t key) const {
  constexpr uint64_t golden = 0x9E3779B97F4A7C15;  // 2^64 over the golden ratio (Knuth, vol. 3, 6.4)
  const std::size_t last = cells_.size() - 1;
  auto slot = static_cast<std::size_t>((key * golden) >> std::countl_zero(last));
  while (cells_[slot].key != key && cells_[slot].key != no_key) slot = (slot + 1) & last;
  return slot;
}

void PoseDensity::grow() {
  const std::vector<Cell> before = std::exchange(cells_, std::vector<Cell>(2 * cells_.size()));
  for (const Cell& cell : before)
    if (cell.key != no_key) cells_[slotOf(cell.key)] = cell;
}

void PoseDensity::add(const PlanarPose& pose, double weight) {
  visitCellsAround(pose, [&](uint64_t key, double share) {
    if (2 * (used_ + 1) > cells_.size()) grow();
    Cell& cell = cells_[slotOf(key)];
    used_ += cell.key == no_key;
    cell.key = key;
    cell.mass += weight * share;
  });
}

double PoseDensity::operator()(const PlanarPose& pose) const {
  double mass = 0;
  visitCellsAround(pose, [&](uint64_t key, double share) { mass += cells_[slotOf(key)].mass * share; });
  return mass / (cell_position * cell_position * cell_heading);
}

}  // namespace vmcl
