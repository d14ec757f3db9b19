// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/obs/CObservationOdometry.h>

#include <Eigen/Geometry>
#include <cmath>
#include <iostream>

#include "vmcl/estimation/estimator.h"
#include "vmcl/geometry/pose_problem.h"
#include "vmcl/mrpt/camera_observation.h"

namespace {

/// Points in front of a camera that the robot saw when the map was made and sees again from `robot_in_map`.
vmcl::PoseProblem noiselessProblem(const vmcl::PlanarPose& robot_in_map) {
  vmcl::PinholeCamera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 500;
  camera.cx = 320;
  camera.cy = 240;
  vmcl::Rigid3 robot_from_camera = vmcl::Rigid3::Identity();
  robot_from_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const vmcl::Rigid3 query_from_map = (vmcl::toRigid3(robot_in_map) * robot_from_camera).inverse();

  vmcl::PoseProblem problem;
  problem.query_cameras = {{camera, robot_from_camera}};
  problem.reference_cameras = {{camera, robot_from_camera}};
  for (int i = 0; i < 20; ++i) {
    vmcl::Match match;
    match.point.emplace().point_in_map = {5 + i % 3, 0.2 * (i % 7) - 0.6, 0.2 * (i % 5) - 0.4};
    match.query_pixel = camera.project(query_from_map * match.point->point_in_map);
    match.reference_pixel = camera.project(robot_from_camera.inverse() * match.point->point_in_map);
    problem.matches.push_back(match);
  }
  return problem;
}

}  // namespace

int main() {
  const vmcl::PlanarPose truth{0.5, -0.2, 0.1};
  const vmcl::PoseEstimate estimate = vmcl::estimatePose(noiselessProblem(truth), {});
  if (!estimate.found()) {
    std::cerr << "no pose: " << estimate.reason << '\n';
    return 1;
  }
  const vmcl::PlanarPose error = inverse(truth) * estimate.modes.front().robot_in_map;
  std::cout << "error " << error.x << ' ' << error.y << ' ' << error.phi << '\n';
  const bool camera_found = vmcl::cameraObservation(mrpt::obs::CObservationOdometry()).has_value();
  return std::hypot(error.x, error.y) < 1e-3 && std::abs(error.phi) < 1e-3 && !camera_found ? 0 : 1;
}
