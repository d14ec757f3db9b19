// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "triangles.h"

namespace vmcl {

/// A fine grid over the ground of what stands in a robot's way.
class FloorPlan {
 public:
  /// Takes in what is between the ground and the robot's height (m). Throws std::runtime_error for an empty scene.
  FloorPlan(const std::vector<Triangle>& triangles, double robot_height);

  /// Distance (m) from a place to the nearest obstacle, to about the size of a cell.
  double clearance(const Eigen::Vector2d& place) const;

  /// The object nearest to a place, none if there is no obstacle at all.
  std::optional<std::size_t> nearestObject(const Eigen::Vector2d& place) const;

  double cell() const { return cell_; }  ///< m
  const Eigen::Vector2d& low() const { return low_; }
  Eigen::Vector2d high() const { return low_ + cell_ * Eigen::Vector2d(objects_.cols, objects_.rows); }

 private:
  cv::Point cellOf(const Eigen::Vector2d& place) const;
  bool contains(const cv::Point& cell) const { return cv::Rect({}, objects_.size()).contains(cell); }
  void fill(const Triangle& triangle, double robot_height);

  double cell_ = 0.02;
  Eigen::Vector2d low_;
  cv::Mat_<int> objects_;  ///< -1 where the ground is free
  cv::Mat_<float> clearance_;
};

}  // namespace vmcl
