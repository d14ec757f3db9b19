// SPDX-License-Identifier: BSD-3-Clause
//
// The filter as a library: a robot drives about a room that it has a map of, from about where it is told it starts,
// with AMCL's options. A node for ROS or a module for MOLA does the same with its own map, odometry and observations;
// for a camera the map is a vmcl::VisualKeyframeMap and the observations are CObservationImage.
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <Eigen/Core>
#include <cmath>
#include <iostream>

#include "vmcl/mrpt/localizer.h"

namespace {

using mrpt::maps::COccupancyGridMap2D;

/// 8 m x 6 m, with a cupboard in one corner and a wall halfway across.
COccupancyGridMap2D::Ptr room() {
  auto grid = COccupancyGridMap2D::Create();
  grid->setSize(-0.5f, 8.5f, -0.5f, 6.5f, 0.05f);
  grid->fill(0);
  const auto isFree = [](double x, double y) {
    const bool inside = x > 0 && x < 8 && y > 0 && y < 6, cupboard = x < 1.5 && y > 5, wall = x > 5 && x < 5.2 && y < 3;
    return inside && !cupboard && !wall;
  };
  for (int i = 0; i < static_cast<int>(grid->getSizeX()); ++i)
    for (int j = 0; j < static_cast<int>(grid->getSizeY()); ++j)
      grid->setCell(i, j, isFree(grid->idx2x(i), grid->idx2y(j)) ? 1.0f : 0.0f);
  grid->likelihoodOptions.likelihoodMethod = COccupancyGridMap2D::lmLikelihoodField_Thrun;
  grid->likelihoodOptions.LF_decimation = 10;
  return grid;
}

mrpt::obs::CObservation2DRangeScan::Ptr scanFrom(const COccupancyGridMap2D& grid, const vmcl::PlanarPose& truth) {
  auto scan = mrpt::obs::CObservation2DRangeScan::Create();
  scan->sensorLabel = "laser";
  scan->aperture = 2 * M_PIf;
  grid.laserScanSimulator(*scan, {truth.x, truth.y, truth.phi}, 0.5f, 181, 0.01f);
  return scan;
}

}  // namespace

int main() {
  const auto grid = room();
  auto maps = mrpt::maps::CMultiMetricMap::Create();
  maps->maps.push_back(grid);

  vmcl::LocalizerOptions options = vmcl::LocalizerOptions::amcl();
  auto& odometry = *options.monte_carlo.motion_model;
  odometry.alpha1 = odometry.alpha2 = odometry.alpha3 = odometry.alpha4 = 0.01;  // AMCL's 0.2 is for a poor odometry
  vmcl::Localizer localizer(options);
  localizer.setMap(maps);
  localizer.setInitialPose({{2.8, 1.1, 0.1}, 0.04 * Eigen::Matrix3d::Identity()});

  vmcl::PlanarPose truth{3, 1, 0};
  const vmcl::PlanarPose movement{0.3, 0, 0.2};  // as the odometry tells it: round in a circle
  for (int i = 0; i < 40; ++i) {
    mrpt::obs::CSensoryFrame observations;
    observations.insert(scanFrom(*grid, truth));
    localizer.process(movement, observations);
    if (i < 39) truth = truth * movement;
  }

  const vmcl::PoseWithCovariance pose = localizer.estimate();
  const auto status = localizer.health().status;
  std::cout << vmcl::nameOf(status) << " at " << pose.robot_in_map.x << ' ' << pose.robot_in_map.y << ' '
            << pose.robot_in_map.phi << ", truly at " << truth.x << ' ' << truth.y << ' ' << truth.phi << '\n';
  const double error = std::hypot(pose.robot_in_map.x - truth.x, pose.robot_in_map.y - truth.y);
  return status == vmcl::LocalizationStatus::tracking && error < 0.2 ? 0 : 1;
}
