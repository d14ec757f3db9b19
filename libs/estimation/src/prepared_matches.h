// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "match_likelihood.h"
#include "vmcl/estimation/likelihood.h"
#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

/// Matches with depth seen by one query camera.
struct PointGroup {
  int query = 0;
  std::vector<int> match;  ///< index in the problem
  std::vector<Eigen::Vector2d> pixel;
  std::vector<Eigen::Vector3d> point_in_map;
  std::vector<Eigen::Matrix3d> covariance;
};

/// Matches without depth between one query and one reference camera.
struct RayGroup {
  int query = 0;
  int reference = 0;
  std::vector<int> match;
  std::vector<Eigen::Vector2d> query_pixel;
  std::vector<Eigen::Vector2d> reference_pixel;
};

/// What every evaluation of the likelihood needs, laid out for its loops.
struct PoseLikelihood::Prepared {
  Prepared(const PoseProblem& problem, const LikelihoodOptions& options);

  LikelihoodOptions options;
  std::vector<QueryCamera> query_cameras;
  std::vector<ReferenceCamera> reference_cameras;
  std::vector<PointGroup> point_groups;
  std::vector<RayGroup> ray_groups;
  int match_count = 0;

  /// Evaluates every match at one pose: on_point(view, group, i, residual) and on_ray(view, group, i, residual) for
  /// those in front of the cameras and near enough to count.
  template <class OnPoint, class OnRay>
  void visit(const Rigid3& map_from_robot, OnPoint&& on_point, OnRay&& on_ray) const {
    PointView::Residual point;
    for (const PointGroup& group : point_groups) {
      const PointView view(query_cameras[static_cast<std::size_t>(group.query)], map_from_robot, options.sigma_px);
      for (std::size_t i = 0; i < group.pixel.size(); ++i) {
        view.evaluate(group.pixel[i], group.point_in_map[i], group.covariance[i], point);
        if (point.likelihood_ratio > 0) on_point(view, group, i, point);
      }
    }
    EpipolarView::Residual ray;
    for (const RayGroup& group : ray_groups) {
      const EpipolarView view(query_cameras[static_cast<std::size_t>(group.query)],
                              reference_cameras[static_cast<std::size_t>(group.reference)], map_from_robot,
                              options.sigma_px);
      for (std::size_t i = 0; i < group.query_pixel.size(); ++i) {
        view.evaluate(group.query_pixel[i], group.reference_pixel[i], ray);
        if (ray.likelihood_ratio > 0) on_ray(view, group, i, ray);
      }
    }
  }
};

}  // namespace vmcl
