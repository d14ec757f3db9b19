// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/estimation/sample_worth.h"

#include <Eigen/Dense>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "vmcl/estimation/depth_points.h"
#include "vmcl/estimation/match_information.h"
#include "vmcl/estimation/one_point_one_depth.h"
#include "vmcl/geometry/random.h"

namespace vmcl {
namespace {

using IndexPair = std::pair<uint32_t, uint32_t>;

void checkSolver(Solver solver) {
  if (solver != Solver::one_point_one_depth && solver != Solver::two_depth)
    throw std::invalid_argument("solver must be 1p1dp or 2dp, not " + std::string(nameOf(solver)));
}

bool isInSight(const QueryCamera& query, const PlanarPose& map_from_robot, const Eigen::Vector3d& point_in_map) {
  constexpr double nearest = 0.1;  // m
  const Eigen::Vector3d point = (toRigid3(map_from_robot) * query.robot_from_camera).inverse() * point_in_map;
  return point.z() > nearest && query.camera.contains(query.camera.project(point));
}

PlanarPose drawPose(const QuerySpread& spread, Random& random) {
  return {spread.map_from_robot.x + spread.sigma_position * random.normal(),
          spread.map_from_robot.y + spread.sigma_position * random.normal(),
          wrapAngle(spread.map_from_robot.phi + spread.sigma_heading * random.normal())};
}

/// One with depth and another, both in sight; nothing if none is found.
std::optional<IndexPair> drawPair(Solver solver, const ReferenceView& view, const QueryCamera& query,
                                  const PlanarPose& map_from_robot, Random& random) {
  constexpr int max_tries = 30;
  const std::size_t others = solver == Solver::two_depth ? view.with_depth : view.points.size();
  if (view.with_depth == 0 || others < 2) return std::nullopt;
  for (int i = 0; i < max_tries; ++i) {
    const uint32_t first = random.below(static_cast<uint32_t>(view.with_depth));
    const uint32_t second = random.below(static_cast<uint32_t>(others));
    if (first != second && isInSight(query, map_from_robot, view.points[first].point_in_map) &&
        isInSight(query, map_from_robot, view.points[second].point_in_map))
      return IndexPair{first, second};
  }
  return std::nullopt;
}

/// Nothing for a degenerate sample.
std::optional<Eigen::Matrix3d> covarianceOf(const Eigen::Matrix3d& information) {
  constexpr double least = 1e-9;
  const Eigen::Vector3d scale = information.diagonal().cwiseSqrt().cwiseInverse();
  if (!scale.allFinite()) return std::nullopt;
  const Eigen::Matrix3d scaled = scale.asDiagonal() * information * scale.asDiagonal();
  if (!(scaled.determinant() > least)) return std::nullopt;
  return scale.asDiagonal() * scaled.inverse() * scale.asDiagonal();
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Draws the errors of two right matches and solves them: the solvers are far from linear where roots are double.
class NoisySample {
 public:
  NoisySample(const QueryCamera& query, const ReferenceCamera& reference, const PlanarPose& map_from_robot,
              double sigma_px, Random& random)
      : query_(query),
        reference_(reference),
        robot_from_map_(toRigid3(map_from_robot).inverse()),
        sigma_px_(sigma_px),
        random_(random) {}

  /// 1P1DP of the first point's depth and the rays to the second.
  PlanarRoots onePointOneDepth(const MapPoint& first, const MapPoint& second) {
    const Ray in_map{reference_.map_from_camera.translation(),
                     reference_.map_from_camera.linear() *
                         noisyRay(reference_.camera, reference_.map_from_camera.inverse() * second.point_in_map)};
    return solveOnePointOneDepth(withDepth(first), {queryRay(second.point_in_map), in_map});
  }

  std::optional<PlanarTransform> twoDepth(const MapPoint& first, const MapPoint& second) {
    return solveDepthPoints(std::array{withDepth(first), withDepth(second)});
  }

 private:
  Eigen::Vector3d noisyRay(const PinholeCamera& camera, const Eigen::Vector3d& point_in_camera) {
    const Eigen::Vector2d noise(random_.normal(), random_.normal());
    return camera.ray(camera.project(point_in_camera) + sigma_px_ * noise);
  }

  Ray queryRay(const Eigen::Vector3d& point_in_map) {
    const Rigid3& mount = query_.robot_from_camera;
    return {mount.translation(),
            mount.linear() * noisyRay(query_.camera, mount.inverse() * (robot_from_map_ * point_in_map))};
  }

  /// The map has the point where it believes it to be; the camera sees it where it is.
  RayToPoint withDepth(const MapPoint& point) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(point.covariance);
    const Eigen::Vector3d normal(random_.normal(), random_.normal(), random_.normal());
    const Eigen::Vector3d error = axes.eigenvectors() * axes.eigenvalues().cwiseMax(0).cwiseSqrt().cwiseProduct(normal);
    return {queryRay(point.point_in_map + error), point.point_in_map};
  }

  const QueryCamera& query_;
  const ReferenceCamera& reference_;
  Rigid3 robot_from_map_;
  double sigma_px_;
  Random& random_;
};

}  // namespace

bool Tolerance::holds(const PlanarTransform& found, const PlanarPose& truth) const {
  const Eigen::Vector3d error = difference(found.pose(), truth);
  return error.head<2>().norm() <= position && std::abs(error.z()) <= heading;
}

void MatchRates::check() const {
  const auto rate = [](const char* key, double value) {
    if (!(value >= 0 && value <= 1))
      throw std::invalid_argument(std::string(key) + " is " + std::to_string(value) + ", not in [0, 1]");
  };
  rate("sparse_inliers", sparse_inliers);
  rate("dense_inliers", dense_inliers);
  rate("reliable_depth", reliable_depth);
}

double chanceOfGoodSample(Solver solver, const MatchRates& rates) {
  checkSolver(solver);
  rates.check();
  const double with_depth = rates.sparse_inliers * rates.reliable_depth;
  return with_depth * (solver == Solver::two_depth ? with_depth : rates.dense_inliers);
}

SampleWorth sampleWorth(Solver solver, const ReferenceView& view, const QueryCamera& query, const QuerySpread& spread,
                        const MatchRates& rates, double sigma_px, const Tolerance& tolerance) {
  constexpr int samples = 256, draws = 4;  // of pairs, and of the errors of each
  SampleWorth worth;
  worth.chance_good = chanceOfGoodSample(solver, rates);
  Random random(1);
  int drawn = 0, within = 0;
  std::vector<double> positions, headings;
  for (int i = 0; i < samples; ++i) {
    const PlanarPose map_from_robot = drawPose(spread, random);
    const auto pair = drawPair(solver, view, query, map_from_robot, random);
    if (!pair) continue;
    ++drawn;
    const MapPoint &first = view.points[pair->first], &second = view.points[pair->second];
    const auto covariance =
        covarianceOf(informationWithDepth(query, map_from_robot, first, sigma_px) +
                     (solver == Solver::two_depth ? informationWithDepth(query, map_from_robot, second, sigma_px)
                                                  : informationWithoutDepth(query, view.camera, map_from_robot,
                                                                            second.point_in_map, sigma_px)));
    NoisySample sample(query, view.camera, map_from_robot, sigma_px, random);
    for (int draw = 0; draw < draws; ++draw) {
      if (solver == Solver::two_depth) {
        const auto found = sample.twoDepth(first, second);
        within += found && tolerance.holds(*found, map_from_robot);
      } else {
        const PlanarRoots found = sample.onePointOneDepth(first, second);
        within += (found.count > 0 && tolerance.holds(found.roots[0], map_from_robot)) ||
                  (found.count > 1 && tolerance.holds(found.roots[1], map_from_robot));
      }
    }
    if (!covariance) continue;
    positions.push_back(std::sqrt(covariance->topLeftCorner<2, 2>().trace()));
    headings.push_back(std::sqrt((*covariance)(2, 2)));
  }
  if (positions.empty()) return {};
  worth.chance_within = static_cast<double>(within) / (draws * drawn);
  worth.sigma_position = median(positions);
  worth.sigma_heading = median(headings);
  return worth;
}

}  // namespace vmcl
