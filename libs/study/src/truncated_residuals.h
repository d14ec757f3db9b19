// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "vmcl/geometry/planar_transform.h"
#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

/// The score of the paper's RANSAC: pixel residuals of the matches at a pose, squared and truncated. A match with depth
/// has its reprojection error, one without the distance from its epipolar lines (Sampson 1982). The problem must
/// outlive it.
class TruncatedResiduals {
 public:
  TruncatedResiduals(const PoseProblem& problem, bool with_depth_only, double threshold_px);

  /// Sum of the squared residuals, each at most the square of the threshold.
  double cost(const PlanarTransform& map_from_robot) const;

  /// Gauss-Newton on the matches that are within the threshold, as long as the cost falls. Returns the cost.
  double optimize(PlanarTransform& map_from_robot) const;

 private:
  using Residuals = std::vector<Eigen::Vector2d>;

  /// Of every match at the pose, infinite behind a camera; one without depth has one coordinate and zero.
  void evaluate(const PlanarTransform& map_from_robot, Residuals& residuals) const;
  double truncated(const Residuals& residuals) const;
  PlanarTransform gaussNewtonStep(const PlanarTransform& pose, const Residuals& residuals) const;

  const PoseProblem& problem_;
  std::vector<const Match*> with_depth_;
  std::vector<const Match*> without_depth_;
  double threshold2_;
};

}  // namespace vmcl
