// SPDX-License-Identifier: BSD-3-Clause
#include <limits>
#include <memory>
#include <numeric>
#include <opengv/absolute_pose/CentralAbsoluteAdapter.hpp>
#include <opengv/absolute_pose/NoncentralAbsoluteAdapter.hpp>
#include <opengv/absolute_pose/methods.hpp>
#include <opengv/sac/Ransac.hpp>
#include <opengv/sac_problems/absolute_pose/AbsolutePoseSacProblem.hpp>
#include <optional>

#include "peers.h"

namespace vmcl {
namespace {

using opengv::absolute_pose::AbsoluteAdapterBase;
using opengv::absolute_pose::CentralAbsoluteAdapter;
using opengv::absolute_pose::NoncentralAbsoluteAdapter;
using opengv::sac_problems::absolute_pose::AbsolutePoseSacProblem;

/// The matches with depth, as OpenGV's adapters refer to them.
struct BearingMatches {
  opengv::bearingVectors_t bearings;  ///< unit vectors, camera frame
  opengv::points_t points_in_map;
  std::vector<int> cameras;
  opengv::translations_t camera_positions;  ///< robot frame
  opengv::rotations_t camera_rotations;     ///< robot_from_camera

  explicit BearingMatches(const PoseProblem& problem) {
    for (const QueryCamera& query : problem.query_cameras) {
      camera_positions.push_back(query.robot_from_camera.translation());
      camera_rotations.push_back(query.robot_from_camera.linear());
    }
    for (const Match& match : problem.matches) {
      if (!match.point) continue;
      const QueryCamera& query = problem.query_cameras[static_cast<std::size_t>(match.query_camera)];
      bearings.push_back(query.camera.ray(match.query_pixel).normalized());
      points_in_map.push_back(match.point->point_in_map);
      cameras.push_back(match.query_camera);
    }
  }
};

/// OpenGV's residual, one minus the cosine of the angle between rays, for a distance in the middle of the image.
double angularThreshold(const PoseProblem& problem, double threshold_px) {
  return 1 - std::cos(std::atan(threshold_px / problem.query_cameras.at(0).camera.fx));
}

struct RansacResult {
  opengv::transformation_t map_from_viewpoint;
  std::vector<int> inliers;
};

std::optional<RansacResult> ransac(AbsoluteAdapterBase& adapter, AbsolutePoseSacProblem::algorithm_t algorithm,
                                   const PoseProblem& problem, const MethodSettings& settings) {
  const auto consensus = std::make_shared<AbsolutePoseSacProblem>(adapter, algorithm, false);
  if (static_cast<int>(adapter.getNumberCorrespondences()) < consensus->getSampleSize()) return std::nullopt;
  opengv::sac::Ransac<AbsolutePoseSacProblem> ransac(
      settings.iterations, angularThreshold(problem, settings.threshold_px), settings.confidence);
  ransac.sac_model_ = consensus;
  if (!ransac.computeModel()) return std::nullopt;
  return RansacResult{ransac.model_coefficients_, ransac.inliers_};
}

opengv::transformation_t refined(AbsoluteAdapterBase& adapter, const opengv::transformation_t& start,
                                 const std::vector<int>& inliers) {
  if (inliers.size() < 3) return start;
  adapter.setR(start.leftCols<3>());
  adapter.sett(start.col(3));
  return opengv::absolute_pose::optimize_nonlinear(adapter, inliers);
}

std::vector<PlanarPose> planar(const opengv::transformation_t& map_from_viewpoint,
                               const Rigid3& viewpoint_from_robot = Rigid3::Identity()) {
  Rigid3 rigid = Rigid3::Identity();
  rigid.linear() = map_from_viewpoint.leftCols<3>();
  rigid.translation() = map_from_viewpoint.col(3);
  const PlanarPose pose = planarPart(rigid * viewpoint_from_robot);
  return isFinite(pose) ? std::vector{pose} : std::vector<PlanarPose>{};
}

std::vector<PlanarPose> p3p(const PoseProblem& problem, const MethodSettings& settings) {
  const BearingMatches matches(problem);
  CentralAbsoluteAdapter adapter(matches.bearings, matches.points_in_map);
  const auto result = ransac(adapter, AbsolutePoseSacProblem::KNEIP, problem, settings);
  if (!result) return {};
  return planar(refined(adapter, result->map_from_viewpoint, result->inliers),
                problem.query_cameras[0].robot_from_camera.inverse());
}

std::vector<PlanarPose> gp3p(const PoseProblem& problem, const MethodSettings& settings) {
  const BearingMatches matches(problem);
  NoncentralAbsoluteAdapter adapter(matches.bearings, matches.cameras, matches.points_in_map, matches.camera_positions,
                                    matches.camera_rotations);
  const auto result = ransac(adapter, AbsolutePoseSacProblem::GP3P, problem, settings);
  if (!result) return {};
  return planar(refined(adapter, result->map_from_viewpoint, result->inliers));
}

/// UPnP fits all points at once, so the inliers of GP3P's RANSAC are what it gets; of its solutions the one that agrees
/// best with them is taken.
std::vector<PlanarPose> upnp(const PoseProblem& problem, const MethodSettings& settings) {
  const BearingMatches matches(problem);
  NoncentralAbsoluteAdapter adapter(matches.bearings, matches.cameras, matches.points_in_map, matches.camera_positions,
                                    matches.camera_rotations);
  const auto result = ransac(adapter, AbsolutePoseSacProblem::GP3P, problem, settings);
  if (!result || result->inliers.size() < 4) return {};
  const AbsolutePoseSacProblem consensus(adapter, AbsolutePoseSacProblem::GP3P, false);
  opengv::transformation_t best = result->map_from_viewpoint;
  double best_sum = std::numeric_limits<double>::infinity();
  for (const opengv::transformation_t& solution : opengv::absolute_pose::upnp(adapter, result->inliers)) {
    std::vector<double> distances;
    consensus.getSelectedDistancesToModel(solution, result->inliers, distances);
    const double sum = std::accumulate(distances.begin(), distances.end(), 0.0);
    if (!(sum < best_sum)) continue;
    best_sum = sum;
    best = solution;
  }
  return planar(best);
}

}  // namespace

bool hasOpenGv() { return true; }

std::vector<PoseMethod> openGvMethods() {
  return {{"P3P", "OpenGV P3P (Kneip) in RANSAC, refined; uses the matches with depth of one camera", false, p3p},
          {"GP3P", "OpenGV GP3P in RANSAC, refined; uses the matches with depth", true, gp3p},
          {"UPnP", "OpenGV UPnP over the inliers of GP3P's RANSAC; uses the matches with depth", true, upnp}};
}

}  // namespace vmcl
