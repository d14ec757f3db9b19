// SPDX-License-Identifier: BSD-3-Clause
#include "floor_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace vmcl {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double step_height = 0.04;  // m that wheels run over: carpets, door sills
constexpr double max_cells = 4e6;
constexpr double scene_margin = 0.5;  // m around the scene

/// The part of a polygon above (sign 1) or below (sign -1) a height.
std::vector<Vector3d> clipped(const std::vector<Vector3d>& polygon, double height, double sign) {
  std::vector<Vector3d> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double from = sign * (a.z() - height), to = sign * (b.z() - height);
    if (from >= 0) kept.push_back(a);
    if ((from > 0 && to < 0) || (from < 0 && to > 0)) kept.push_back(a + from / (from - to) * (b - a));
  }
  return kept;
}

}  // namespace

FloorPlan::FloorPlan(const std::vector<Triangle>& triangles, double robot_height) {
  if (triangles.empty()) throw std::runtime_error("there is nothing in the scene");
  Vector2d low = triangles.front().corners[0].head<2>(), high = low;
  for (const Triangle& triangle : triangles)
    for (const Vector3d& corner : triangle.corners) {
      low = low.cwiseMin(corner.head<2>());
      high = high.cwiseMax(corner.head<2>());
    }
  low_ = low - Vector2d::Constant(scene_margin);
  const Vector2d extent = high - low + Vector2d::Constant(2 * scene_margin);
  cell_ = std::max(cell_, std::sqrt(extent.prod() / max_cells));
  objects_ = cv::Mat_<int>(static_cast<int>(std::ceil(extent.y() / cell_)),
                           static_cast<int>(std::ceil(extent.x() / cell_)), -1);
  for (const Triangle& triangle : triangles) fill(triangle, robot_height);
  cv::Mat_<uchar> free = objects_ < 0;
  cv::distanceTransform(free, clearance_, cv::DIST_L2, cv::DIST_MASK_PRECISE);
}

cv::Point FloorPlan::cellOf(const Vector2d& place) const {
  const Vector2d cell = (place - low_) / cell_;
  return {static_cast<int>(std::floor(cell.x())), static_cast<int>(std::floor(cell.y()))};
}

void FloorPlan::fill(const Triangle& triangle, double robot_height) {
  const std::vector<Vector3d> corners(triangle.corners.begin(), triangle.corners.end());
  const auto part = clipped(clipped(corners, step_height, 1), robot_height, -1);
  if (part.empty()) return;
  std::vector<cv::Point> outline;
  for (const Vector3d& corner : part) outline.push_back(cellOf(corner.head<2>()));
  cv::fillConvexPoly(objects_, outline, static_cast<int>(triangle.object), cv::LINE_8);
}

double FloorPlan::clearance(const Vector2d& place) const {
  const cv::Point cell = cellOf(place);
  return contains(cell) ? cell_ * clearance_(cell) : std::numeric_limits<double>::infinity();
}

std::optional<std::size_t> FloorPlan::nearestObject(const Vector2d& place) const {
  const cv::Point center = cellOf(place);
  double nearest = std::numeric_limits<double>::infinity();
  std::optional<std::size_t> object;
  for (int y = 0; y < objects_.rows; ++y)
    for (int x = 0; x < objects_.cols; ++x) {
      const double distance = std::hypot(x - center.x, y - center.y);
      if (objects_(y, x) < 0 || distance >= nearest) continue;
      nearest = distance;
      object = static_cast<std::size_t>(objects_(y, x));
    }
  return object;
}

}  // namespace vmcl
