// SPDX-License-Identifier: BSD-3-Clause
#include "triangulation.h"

#include <Eigen/Dense>
#include <limits>
#include <optional>

namespace vmcl {
namespace {

constexpr double min_depth = 0.05;  // m; nearer is no scene

struct NormalEquations {
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double cost = 0;
};

/// Of the sum of squared errors in standard deviations; nothing when the point lies behind a view.
std::optional<NormalEquations> linearize(std::span<const Sighting> sightings, const Eigen::Vector3d& point_in_map,
                                         const MeasurementNoise& noise) {
  NormalEquations sum;
  for (const auto& [view, pixel, depth] : sightings) {
    const Eigen::Vector3d p = view.map_from_camera.inverse() * point_in_map;
    if (!(p.z() > min_depth)) return std::nullopt;
    Eigen::Matrix<double, 2, 3> pixel_by_point;
    pixel_by_point << view.camera.fx / p.z(), 0, -view.camera.fx * p.x() / (p.z() * p.z()),  //
        0, view.camera.fy / p.z(), -view.camera.fy * p.y() / (p.z() * p.z());
    const Eigen::Matrix3d camera_from_map = view.map_from_camera.linear().transpose();
    const Eigen::Matrix<double, 2, 3> J = pixel_by_point * camera_from_map / noise.pixel;
    const Eigen::Vector2d error = (view.camera.project(p) - pixel) / noise.pixel;
    sum.hessian += J.transpose() * J;
    sum.gradient += J.transpose() * error;
    sum.cost += error.squaredNorm();
    if (!(depth > 0)) continue;
    const Eigen::RowVector3d depth_by_point = -camera_from_map.row(2) / (p.z() * p.z() * noise.inverse_depth);
    const double depth_error = (1 / p.z() - 1 / depth) / noise.inverse_depth;
    sum.hessian += depth_by_point.transpose() * depth_by_point;
    sum.gradient += depth_by_point.transpose() * depth_error;
    sum.cost += depth_error * depth_error;
  }
  return sum;
}

/// Nearest to all rays in the least-squares sense; linear.
std::optional<Eigen::Vector3d> nearestToRays(std::span<const Sighting> sightings) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const auto& [view, pixel, depth] : sightings) {
    const Eigen::Vector3d ray = (view.map_from_camera.linear() * view.camera.ray(pixel)).normalized();
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - ray * ray.transpose();
    A += across;
    b += across * view.map_from_camera.translation();
  }
  const Eigen::LDLT<Eigen::Matrix3d> solver(A);
  if (!(solver.rcond() > 1e-12)) return std::nullopt;
  return solver.solve(b);
}

std::optional<Eigen::Vector3d> firstGuess(std::span<const Sighting> sightings) {
  for (const auto& [view, pixel, depth] : sightings)
    if (depth > 0) return view.map_from_camera * (depth * view.camera.ray(pixel));
  return nearestToRays(sightings);
}

}  // namespace

Triangulation triangulate(std::span<const Sighting> sightings, const MeasurementNoise& noise) {
  auto point = firstGuess(sightings);
  if (!point) return {{}, TriangulationFailure::parallel_rays};
  auto equations = linearize(sightings, *point, noise);
  if (!equations) return {{}, TriangulationFailure::behind_a_view};
  double damping = 1e-3;
  for (int iteration = 0; iteration < 30 && damping < 1e6; ++iteration) {
    Eigen::Matrix3d damped = equations->hessian;
    damped.diagonal() *= 1 + damping;
    const Eigen::Vector3d moved = *point - damped.ldlt().solve(equations->gradient);
    const auto moved_equations = linearize(sightings, moved, noise);
    if (!moved_equations || !(moved_equations->cost <= equations->cost)) {
      damping *= 10;
      continue;
    }
    const bool converged = (moved - *point).norm() < 1e-9 * (1 + moved.norm());
    point = moved;
    equations = moved_equations;
    if (converged) break;
    damping /= 10;
  }
  const Eigen::LDLT<Eigen::Matrix3d> information(equations->hessian);
  if (!(information.rcond() > 1e-14)) return {{}, TriangulationFailure::parallel_rays};
  const Eigen::Matrix3d covariance = information.solve(Eigen::Matrix3d::Identity());
  return {{*point, (covariance + covariance.transpose()) / 2}};
}

bool isWellPlaced(const MapPoint& point, std::span<const Sighting> sightings) {
  double distance = std::numeric_limits<double>::infinity();
  for (const Sighting& sighting : sightings)
    distance = std::min(distance, (sighting.view.map_from_camera.translation() - point.point_in_map).norm());
  if (!point.covariance.allFinite()) return false;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(point.covariance, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues()[0] > 0 && std::sqrt(eigen.eigenvalues()[2]) < distance / 3;
}

double reprojectionError(const Sighting& sighting, const Eigen::Vector3d& point_in_map) {
  const Eigen::Vector3d p = sighting.view.map_from_camera.inverse() * point_in_map;
  if (!(p.z() > min_depth)) return std::numeric_limits<double>::infinity();
  return (sighting.view.camera.project(p) - sighting.pixel).norm();
}

}  // namespace vmcl
