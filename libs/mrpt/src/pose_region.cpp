// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/pose_region.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace vmcl {
namespace {

constexpr double max_coordinate = 1e7;  // m: a quarter of the earth's circumference, as far as UTM goes
constexpr float min_free_probability = 0.7F;

void checkRange(const char* name, double low, double high) {
  if (!std::isfinite(low) || !std::isfinite(high))
    throw std::invalid_argument(std::string("range of ") + name + " is not finite");
  if (low < -max_coordinate || high > max_coordinate)
    throw std::invalid_argument(std::string("range of ") + name + " goes beyond 1e7");
  if (low > high)
    throw std::invalid_argument(std::string("range of ") + name + " is empty: from " + std::to_string(low) + " to " +
                                std::to_string(high));
}

}  // namespace

void PoseBox::check() const {
  checkRange("x", min_x, max_x);
  checkRange("y", min_y, max_y);
  checkRange("phi", min_phi, max_phi);
}

PoseRegion::PoseRegion(const PoseBox& box)
    : box_(box), volume_((box.max_x - box.min_x) * (box.max_y - box.min_y) * (box.max_phi - box.min_phi)) {
  box_.check();
}

PoseRegion::PoseRegion(const PoseBox& box, const mrpt::maps::COccupancyGridMap2D& grid)
    : box_(box), resolution_(grid.getResolution()) {
  box_.check();
  const int size_x = static_cast<int>(grid.getSizeX()), size_y = static_cast<int>(grid.getSizeY());
  const auto cell = [](double coordinate, double origin, double resolution, int size) {
    return static_cast<int>(std::clamp(std::floor((coordinate - origin) / resolution), 0.0, size - 1.0));
  };
  const int first_x = cell(box.min_x, grid.getXMin(), resolution_, size_x);
  const int last_x = cell(box.max_x, grid.getXMin(), resolution_, size_x);
  const int first_y = cell(box.min_y, grid.getYMin(), resolution_, size_y);
  const int last_y = cell(box.max_y, grid.getYMin(), resolution_, size_y);
  for (int x = first_x; x <= last_x; ++x)
    for (int y = first_y; y <= last_y; ++y)
      if (grid.getCell(x, y) >= min_free_probability) free_cells_.emplace_back(grid.idx2x(x), grid.idx2y(y));
  if (free_cells_.empty()) throw std::invalid_argument("the grid map has no free cell where the robot may be");
  volume_ = static_cast<double>(free_cells_.size()) * resolution_ * resolution_ * (box.max_phi - box.min_phi);
}

PlanarPose PoseRegion::draw(Random& random) const {
  const double phi = wrapAngle(random.uniform(box_.min_phi, box_.max_phi));
  if (free_cells_.empty()) return {random.uniform(box_.min_x, box_.max_x), random.uniform(box_.min_y, box_.max_y), phi};
  const Eigen::Vector2f& cell = free_cells_[random.below(static_cast<uint32_t>(free_cells_.size()))];
  const double half = resolution_ / 2;
  return {cell.x() + random.uniform(-half, half), cell.y() + random.uniform(-half, half), phi};
}

}  // namespace vmcl
