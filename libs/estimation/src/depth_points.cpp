// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/estimation/depth_points.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vmcl {
namespace {

struct Vector {
  double x = 0, y = 0;
};
inline Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y}; }
inline Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y}; }
inline Vector operator*(double s, Vector a) { return {s * a.x, s * a.y}; }
inline double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y; }

struct SymmetricMatrix {
  double xx = 0, xy = 0, yy = 0;
};
inline Vector operator*(const SymmetricMatrix& A, Vector v) {
  return {A.xx * v.x + A.xy * v.y, A.xy * v.x + A.yy * v.y};
}

/// The two equations of a match, divided by its range, as a quadratic form over the point y in the robot frame,
/// y^T N y - 2 g^T y: the sum of (n . (y - o) - d)^2 over the bearing, n = (-f_y, f_x) / |f_h|, and the height,
/// n = f_v f_h / (|f_h| |f|).
///
/// The inverse range is known from the height, f_v / |f| = height / range, to some angle; of points at the height of
/// the camera it is only known that they are in the room.
struct Constraint {
  SymmetricMatrix N;
  Vector g;

  explicit Constraint(const RayToPoint& match) {
    constexpr double usual = 0.25, spread = 0.2, angle = 0.003;  // 1/m, 1/m, rad
    constexpr double prior = (angle / spread) * (angle / spread), vague = prior * usual * prior * usual;
    const Eigen::Vector3d& o = match.ray_in_robot.origin;
    const Eigen::Vector3d& f = match.ray_in_robot.direction;
    const double vertical2 = f.z() * f.z(), horizontal2 = f.x() * f.x() + f.y() * f.y();
    const double length2 = horizontal2 + vertical2;
    if (!(horizontal2 > 1e-18 * length2)) return;  // straight up or down: no heading in it
    const double height = match.point_in_map.z() - o.z(), height2 = height * height;
    const double information2 = (height2 + prior) * (height2 + prior);
    const double divisor = 1 / (length2 * horizontal2 * information2),
                 per_length2 = divisor * horizontal2 * information2;
    const double across = (vertical2 * height2 + vague * length2) * divisor;  // over |f_h|^2 and range^2
    const double along = vertical2 * per_length2 * across, lift = f.z() * height * horizontal2 * per_length2 * across;
    N = {across * f.y() * f.y() + along * f.x() * f.x(), (along - across) * f.x() * f.y(),
         across * f.x() * f.x() + along * f.y() * f.y()};
    g = N * Vector{o.x(), o.y()} + lift * Vector{f.x(), f.y()};
  }
};

/// The unit v that minimizes v^T Q v - 2 p^T v: (Q + mu I) v = p with the largest mu that gives |v| = 1. Over the
/// eigenvectors of Q, of eigenvalues gap apart, and with nu = mu + the smaller one, that is the secular equation
/// (p_0 / nu)^2 + (p_1 / (nu + gap))^2 = 1; the left side's inverse root is nearly linear in nu, and Chebyshev's method
/// takes its curvature along. To 1e-7 of nu. Nothing where v is ambiguous.
inline std::optional<Vector> minimizeOnCircle(const SymmetricMatrix& Q, Vector p) {
  const double a = 0.5 * (Q.xx - Q.yy), b = Q.xy, r2 = a * a + b * b, gap = 2 * std::sqrt(r2);
  const Vector Qp{a * p.x + b * p.y, b * p.x - a * p.y};  // less Q's mean eigenvalue
  const double p2 = dot(p, p), skew = 0.5 * gap * (dot(p, Qp) / (r2 + 1e-300));
  const double p2_0 = std::max(0.5 * (p2 - skew), 0.0), p2_1 = std::max(0.5 * (p2 + skew), 0.0);
  double nu = std::max(std::sqrt(p2_0), std::sqrt(p2) - gap);  // from below
  for (int i = 0; i < 20; ++i) {
    const double other = nu + gap, first = p2_0 * other, second = p2_1 * nu;
    const double sum = first * other + second * nu, cubes = first * other * other + second * nu * nu;
    const double per_both = 1 / (sum * cubes);
    const double newton = (std::sqrt(sum) - nu * other) * (sum * sum * per_both);
    const double curvature = 1.5 * (cubes * (first + second) - sum * sum) * per_both;
    const double step = newton * (1 + newton * curvature);
    nu += step;
    if (!(step > 3e-3 * nu)) break;  // converges cubically
  }
  if (!(nu > 1e-9 * std::sqrt(p2)) || !std::isfinite(nu)) return std::nullopt;
  const Vector v = (1 / (nu * (nu + gap))) * ((nu + 0.5 * gap) * p - Qp);
  return (1.5 - 0.5 * dot(v, v)) * v;
}

/// Normal equations over v = (cos phi, sin phi) and y, the first point in the robot frame: with X from the first point,
/// the others are y + M(X) v, M(X) = (X_x X_y; X_y -X_x).
struct NormalEquations {
  SymmetricMatrix vv, yy;
  Vector vy_0, vy_1;  // rows
  Vector v, y;

  void addFirst(const Constraint& constraint) {
    yy = constraint.N;
    y = constraint.g;
  }

  void add(const Constraint& constraint, Vector X) {
    const auto& [N, g] = constraint;
    const Vector first = N * X, second = N * Vector{X.y, -X.x};
    vv = {vv.xx + X.x * first.x + X.y * first.y, vv.xy + X.x * second.x + X.y * second.y,
          vv.yy + X.y * second.x - X.x * second.y};
    vy_0 = vy_0 + first;
    vy_1 = vy_1 + second;
    yy = {yy.xx + N.xx, yy.xy + N.xy, yy.yy + N.yy};
    v = v + Vector{dot(X, g), X.y * g.x - X.x * g.y};
    y = y + g;
  }

  /// The best v and y; nothing when points coincide.
  std::optional<std::pair<Vector, Vector>> solve() const {
    const double determinant = yy.xx * yy.yy - yy.xy * yy.xy, trace = yy.xx + yy.yy;
    if (!(determinant > 1e-18 * trace * trace)) return std::nullopt;
    // y = yy^-1 (...) put in and all multiplied by the determinant, which moves no minimum.
    const SymmetricMatrix adjugate{yy.yy, -yy.xy, yy.xx};
    const Vector row_0 = adjugate * vy_0, row_1 = adjugate * vy_1;
    const SymmetricMatrix Q{determinant * vv.xx - dot(row_0, vy_0), determinant * vv.xy - dot(row_0, vy_1),
                            determinant * vv.yy - dot(row_1, vy_1)};
    if (!(Q.xx + Q.yy > 1e-12 * determinant * (vv.xx + vv.yy))) return std::nullopt;
    const auto turn = minimizeOnCircle(Q, determinant * v - Vector{dot(row_0, y), dot(row_1, y)});
    if (!turn) return std::nullopt;
    return std::pair{*turn, (1 / determinant) * (adjugate * y - (turn->x * row_0 + turn->y * row_1))};
  }
};

}  // namespace

std::optional<PlanarTransform> solveDepthPoints(std::span<const RayToPoint> matches) {
  if (matches.size() < 2) return std::nullopt;
  const Eigen::Vector3d& place = matches.front().point_in_map;
  const auto fromPlace = [&](const RayToPoint& match) {
    return Vector{match.point_in_map.x() - place.x(), match.point_in_map.y() - place.y()};
  };
  NormalEquations normal;
  normal.addFirst(Constraint(matches.front()));
  for (const RayToPoint& match : matches.subspan(1)) normal.add(Constraint(match), fromPlace(match));
  const auto solution = normal.solve();
  if (!solution) return std::nullopt;
  const auto& [v, y] = *solution;
  bool in_front = true;
  for (const RayToPoint& match : matches) {
    const auto& [o, f] = match.ray_in_robot;
    const Vector X = fromPlace(match);
    const double x_from_ray = y.x + dot(X, v) - o.x(), y_from_ray = y.y + X.y * v.x - X.x * v.y - o.y();
    in_front &= x_from_ray * f.x() + y_from_ray * f.y() + (match.point_in_map.z() - o.z()) * f.z() > 0;
  }
  if (!in_front) return std::nullopt;
  return PlanarTransform{v.x, v.y, place.x() - dot(v, {y.x, -y.y}), place.y() - (v.y * y.x + v.x * y.y)};
}

}  // namespace vmcl
