// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vmcl/estimation/rays.h"
#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

/// The query ray in robot axes and the reference ray in the map of a match.
inline RayToRay raysOfMatch(const PoseProblem& problem, const Match& match) {
  const QueryCamera& query = problem.query_cameras[static_cast<std::size_t>(match.query_camera)];
  const ReferenceCamera& reference = problem.reference_cameras[static_cast<std::size_t>(match.reference_camera)];
  return {
      {query.robot_from_camera.translation(), query.robot_from_camera.linear() * query.camera.ray(match.query_pixel)},
      {reference.map_from_camera.translation(),
       reference.map_from_camera.linear() * reference.camera.ray(match.reference_pixel)}};
}

}  // namespace vmcl
