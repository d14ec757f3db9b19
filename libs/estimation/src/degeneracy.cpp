// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/estimation/degeneracy.h"

#include <cmath>
#include <numbers>

#include "vmcl/estimation/match_rays.h"
#include "vmcl/estimation/one_point_one_depth.h"

namespace vmcl {
namespace {

constexpr double sigmas = 3;

/// Counts of the matches that could show a degeneracy, and of those that do.
struct Census {
  int all = 0, degenerate = 0;

  void add(bool is_degenerate) {
    ++all;
    degenerate += is_degenerate;
  }
  bool nearlyAll() const { return degenerate >= 2 && degenerate >= 0.9 * all; }
};

/// Whether the point might as well be infinitely far.
bool hasNoParallax(const PoseProblem& problem, const Match& match, const Rigid3& map_from_robot, double sigma_px) {
  const QueryCamera& query = problem.query_cameras[static_cast<std::size_t>(match.query_camera)];
  const ReferenceCamera& reference = problem.reference_cameras[static_cast<std::size_t>(match.reference_camera)];
  const Eigen::Vector3d direction = (map_from_robot * query.robot_from_camera).linear().transpose() *
                                    (reference.map_from_camera.linear() * reference.camera.ray(match.reference_pixel));
  return direction.z() > 0 &&
         (query.camera.project(direction) - match.query_pixel).norm() < sigmas * std::numbers::sqrt2 * sigma_px;
}

/// Whether the two headings that explain the pair are nearly the same.
bool isDoubleRoot(const RayToPoint& depth, const RayToRay& match) {
  constexpr double near = 0.1;  // rad
  const PlanarRoots found = solveOnePointOneDepth(depth, match);
  if (found.count < 2) return found.count == 1;
  const auto& [a, b] = found.roots;
  return a.c * b.c + a.s * b.s > std::cos(near);
}

}  // namespace

std::string_view nameOf(Degeneracy degeneracy) {
  switch (degeneracy) {
    case Degeneracy::no_baseline:
      return "no_baseline";
    case Degeneracy::horizon:
      return "horizon";
    case Degeneracy::wall:
      break;
  }
  return "wall";
}

std::vector<Degeneracy> degeneracies(const PoseProblem& problem, const std::vector<int>& inliers,
                                     const PlanarPose& map_from_robot, double sigma_px) {
  Census parallax, horizon, wall;
  const Rigid3 pose = toRigid3(map_from_robot);
  for (std::size_t i = 0; i < inliers.size(); ++i) {
    const Match& match = problem.matches[static_cast<std::size_t>(inliers[i])];
    parallax.add(hasNoParallax(problem, match, pose, sigma_px));
    if (!match.point) continue;
    const RayToPoint depth{raysOfMatch(problem, match).ray_in_robot, match.point->point_in_map};
    const Eigen::Vector3d& f = depth.ray_in_robot.direction;
    const double focal = problem.query_cameras[static_cast<std::size_t>(match.query_camera)].camera.fy;
    horizon.add(std::abs(f.z()) * focal < sigmas * sigma_px * f.head<2>().norm());
    const Match& other = problem.matches[static_cast<std::size_t>(inliers[(i + inliers.size() / 2) % inliers.size()])];
    if (&other != &match) wall.add(isDoubleRoot(depth, raysOfMatch(problem, other)));
  }
  std::vector<Degeneracy> found;
  if (parallax.nearlyAll()) found.push_back(Degeneracy::no_baseline);
  if (horizon.nearlyAll()) found.push_back(Degeneracy::horizon);
  if (wall.nearlyAll()) found.push_back(Degeneracy::wall);
  return found;
}

}  // namespace vmcl
