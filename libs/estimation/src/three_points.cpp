// SPDX-License-Identifier: BSD-3-Clause
#include "three_points.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace vmcl {
namespace {

using Triple = Eigen::Matrix3d;  ///< of points or directions, a column each

/// Real roots of x^3 + a x^2 + b x + c.
std::vector<double> cubicRoots(double a, double b, double c) {
  const double p = a * a / 9 - b / 3, q = a * (2 * a * a - 9 * b) / 54 + c / 2, center = -a / 3;
  const double discriminant = q * q - p * p * p;
  if (discriminant > 0) {
    const double root = std::cbrt(-q - std::copysign(std::sqrt(discriminant), q));
    return {center + root + (root == 0 ? 0 : p / root)};
  }
  const double angle = std::acos(std::clamp(-q / std::sqrt(p * p * p), -1.0, 1.0)) / 3;
  std::vector<double> roots;
  for (int k = 0; k < 3; ++k)
    roots.push_back(center + 2 * std::sqrt(p) * std::cos(angle - 2 * std::numbers::pi * k / 3));
  return roots;
}

Eigen::Matrix3d adjugate(const Eigen::Matrix3d& m) {
  Eigen::Matrix3d cofactors;
  for (int i = 0; i < 3; ++i) cofactors.row(i) = m.row((i + 1) % 3).cross(m.row((i + 2) % 3));
  return cofactors.transpose();
}

/// The two lines of a real degenerate conic; none if it is none.
std::vector<Eigen::Vector3d> linesOf(const Eigen::Matrix3d& conic) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(conic);
  const Eigen::Vector3d& values = eigen.eigenvalues();  // the middle one is 0 if the lines are real
  if (!(values[0] < 0 && values[2] > 0) || std::abs(values[1]) > std::min(-values[0], values[2])) return {};
  const Eigen::Vector3d sum = std::sqrt(values[2]) * eigen.eigenvectors().col(2);
  const Eigen::Vector3d difference = std::sqrt(-values[0]) * eigen.eigenvectors().col(0);
  return {sum + difference, sum - difference};
}

/// Those of a conic of the pencil C + s E, or of E.
std::vector<Eigen::Vector3d> linesOfPencil(const Eigen::Matrix3d& C, const Eigen::Matrix3d& E) {
  constexpr double degenerate = 1e-12;
  const double leading = E.determinant();
  if (std::abs(leading) < degenerate * std::pow(E.norm(), 3)) return linesOf(E);
  const double square = (C * adjugate(E)).trace(), linear = (adjugate(C) * E).trace();
  for (const double s : cubicRoots(square / leading, linear / leading, C.determinant() / leading)) {
    const std::vector<Eigen::Vector3d> lines = linesOf(C + s * E);
    if (!lines.empty()) return lines;
  }
  return {};
}

/// Directions in which the line meets the conic.
std::vector<Eigen::Vector3d> meetings(const Eigen::Vector3d& line, const Eigen::Matrix3d& conic) {
  const Eigen::Vector3d u = line.unitOrthogonal(), v = line.normalized().cross(u);
  const double a = u.dot(conic * u), b = u.dot(conic * v), c = v.dot(conic * v);
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return {};
  const double q = -b - std::copysign(std::sqrt(discriminant), b);  // of the roots q / a and c / q of u over v
  return {q * u + a * v, c * u + q * v};
}

bool areOnALine(const Triple& points) {
  const Eigen::Vector3d a = points.col(1) - points.col(0), b = points.col(2) - points.col(0);
  return a.cross(b).norm() <= 1e-6 * a.norm() * b.norm();
}

/// Axes that tell how a triangle lies.
Eigen::Matrix3d axesOf(const Triple& corners) {
  const Eigen::Vector3d first = (corners.col(1) - corners.col(0)).normalized();
  const Eigen::Vector3d normal = first.cross(corners.col(2) - corners.col(0)).normalized();
  Eigen::Matrix3d axes;
  axes << first, normal, normal.cross(first);
  return axes;
}

}  // namespace

std::vector<Rigid3> solveThreePoints(const std::array<RayToPoint, 3>& matches) {
  Triple rays, points;
  for (int i = 0; i < 3; ++i) {
    rays.col(i) = matches[static_cast<std::size_t>(i)].ray_in_robot.direction.normalized();
    points.col(i) = matches[static_cast<std::size_t>(i)].point_in_map;
  }
  const auto distance2 = [&](int i, int k) { return (points.col(i) - points.col(k)).squaredNorm(); };
  const auto lawOfCosines = [&](int i, int k) {
    Eigen::Matrix3d Q = Eigen::Matrix3d::Zero();
    Q(i, i) = Q(k, k) = 1;
    Q(i, k) = Q(k, i) = -rays.col(i).dot(rays.col(k));
    return Q;
  };
  const Eigen::Matrix3d Q_01 = lawOfCosines(0, 1), Q_02 = lawOfCosines(0, 2), Q_12 = lawOfCosines(1, 2);
  const double scale = distance2(0, 1);
  const Eigen::Matrix3d C = Q_12 - distance2(1, 2) / scale * Q_01, E = Q_02 - distance2(0, 2) / scale * Q_01;
  // Of the two, the lines are not those of the one that is less degenerate.
  const bool swap = std::abs(C.determinant()) < std::abs(E.determinant());
  const Eigen::Matrix3d &conic = swap ? E : C, &other = swap ? C : E;
  std::vector<Rigid3> poses;
  if (areOnALine(points)) return poses;
  for (const Eigen::Vector3d& line : linesOfPencil(conic, other))
    for (const Eigen::Vector3d& direction : meetings(line, conic)) {
      const double size2 = direction.dot(Q_01 * direction) / scale;
      const Eigen::Vector3d d = direction / std::copysign(std::sqrt(size2), direction.sum());
      if (!(d.minCoeff() > 0)) continue;
      const Eigen::Vector3d& origin = matches[0].ray_in_robot.origin;
      const Triple seen = (rays * d.asDiagonal()).colwise() + origin;
      Rigid3 pose = Rigid3::Identity();
      pose.linear() = axesOf(points) * axesOf(seen).transpose();
      pose.translation() = points.col(0) - pose.linear() * seen.col(0);
      if (pose.matrix().allFinite()) poses.push_back(pose);
    }
  return poses;
}

}  // namespace vmcl
