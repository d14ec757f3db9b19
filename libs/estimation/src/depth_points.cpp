// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/estimation/depth_points.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace vmcl {
namespace {

/// Normal equations of the rows a v + b t = d over v = (cos, sin) and t = -R^T t.
struct NormalEquations {
  Eigen::Matrix2d vv = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d vt = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d tt = Eigen::Matrix2d::Zero();
  Eigen::Vector2d vd = Eigen::Vector2d::Zero();
  Eigen::Vector2d td = Eigen::Vector2d::Zero();

  void add(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double d, double weight) {
    vv += weight * a * a.transpose();
    vt += weight * a * b.transpose();
    tt += weight * b * b.transpose();
    vd += weight * d * a;
    td += weight * d * b;
  }
};

/// The unit v that minimizes v^T Q v - 2 p^T v: (Q + mu I) v = p with the largest mu that gives |v| = 1.
std::optional<Eigen::Vector2d> minimizeOnCircle(const Eigen::Matrix2d& Q, const Eigen::Vector2d& p) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen;
  eigen.computeDirect(Q);
  const Eigen::Vector2d q = eigen.eigenvectors().transpose() * p;
  const double gap = eigen.eigenvalues()[1] - eigen.eigenvalues()[0];
  const double norm = q.norm();
  if (!(norm > 0) || !std::isfinite(norm)) return std::nullopt;
  // With nu = mu + smallest eigenvalue: (q0 / nu)^2 + (q1 / (nu + gap))^2 = 1, decreasing and convex for nu > 0.
  double nu = std::max(std::abs(q[0]), norm - gap);
  if (!(nu > 0)) {  // q0 = 0: the minimum is along the first eigenvector's side
    const double y = std::clamp(q[1] / gap, -1.0, 1.0);
    return eigen.eigenvectors() * Eigen::Vector2d(std::sqrt(1 - y * y), y);
  }
  for (int i = 0; i < 20; ++i) {
    const double u0 = q[0] / nu, u1 = q[1] / (nu + gap);
    const double length = std::hypot(u0, u1);
    const double slope = (u0 * u0 / nu + u1 * u1 / (nu + gap)) / length;
    const double step = (length - 1) * length / slope;  // Newton on 1 / length, nearly linear in nu
    nu += step;
    if (std::abs(step) < 1e-14 * nu) break;
  }
  const Eigen::Vector2d v = eigen.eigenvectors() * Eigen::Vector2d(q[0] / nu, q[1] / (nu + gap));
  return v.allFinite() && v.squaredNorm() > 0 ? std::optional<Eigen::Vector2d>(v.normalized()) : std::nullopt;
}

/// One weighted solve; `previous` supplies the ranges, none at first.
std::optional<PlanarTransform> solveOnce(std::span<const RayToPoint> matches, const PlanarTransform* previous) {
  NormalEquations normal;
  for (const RayToPoint& match : matches) {
    const Eigen::Vector3d& o = match.ray_in_robot.origin;
    const Eigen::Vector3d f = match.ray_in_robot.direction.normalized();
    const Eigen::Vector3d& X = match.point_in_map;
    const double fh = f.head<2>().norm();
    if (!(fh > 1e-9)) continue;  // straight up or down: no heading in it
    const Eigen::Vector2d along = f.head<2>() / fh, across(-along.y(), along.x());
    double weight = 1;
    if (previous) {
      const double dx = X.x() - previous->x, dy = X.y() - previous->y;
      const Eigen::Vector3d Y(previous->c * dx + previous->s * dy, -previous->s * dx + previous->c * dy, X.z());
      weight = 1 / std::max((Y - o).squaredNorm(), 1e-6);
    }
    // n . Y_h with Y_h = (cX + sY, -sX + cY) + t, for a horizontal direction n.
    const auto row = [&](const Eigen::Vector2d& n) {
      return Eigen::Vector2d(n.x() * X.x() + n.y() * X.y(), n.x() * X.y() - n.y() * X.x());
    };
    normal.add(row(across), across, across.dot(o.head<2>()), weight);
    normal.add(f.z() * row(along), f.z() * along, f.z() * along.dot(o.head<2>()) + fh * (X.z() - o.z()), weight);
  }
  const double determinant = normal.tt.determinant();
  if (!(determinant > 1e-18 * normal.tt.squaredNorm())) return std::nullopt;
  const Eigen::Matrix2d tt_inverse = normal.tt.inverse();
  const Eigen::Matrix2d elimination = normal.vt * tt_inverse;
  const Eigen::Matrix2d Q = normal.vv - elimination * normal.vt.transpose();
  if (!(Q.trace() > 1e-12 * normal.vv.trace())) return std::nullopt;  // the points coincide
  const auto v = minimizeOnCircle(Q, normal.vd - elimination * normal.td);
  if (!v) return std::nullopt;
  const Eigen::Vector2d t = tt_inverse * (normal.td - normal.vt.transpose() * *v);
  const double c = v->x(), s = v->y();
  return PlanarTransform{c, s, -(c * t.x() - s * t.y()), -(s * t.x() + c * t.y())};
}

bool allInFront(std::span<const RayToPoint> matches, const PlanarTransform& pose) {
  return std::all_of(matches.begin(), matches.end(), [&](const RayToPoint& match) {
    const double dx = match.point_in_map.x() - pose.x, dy = match.point_in_map.y() - pose.y;
    const Eigen::Vector3d Y(pose.c * dx + pose.s * dy, -pose.s * dx + pose.c * dy, match.point_in_map.z());
    return (Y - match.ray_in_robot.origin).dot(match.ray_in_robot.direction) > 0;
  });
}

}  // namespace

std::optional<PlanarTransform> solveDepthPoints(std::span<const RayToPoint> matches) {
  if (matches.size() < 2) return std::nullopt;
  auto pose = solveOnce(matches, nullptr);
  if (pose) pose = solveOnce(matches, &*pose);
  if (!pose || !allInFront(matches, *pose)) return std::nullopt;
  return pose;
}

}  // namespace vmcl
