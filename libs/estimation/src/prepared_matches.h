// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <mutex>
#include <optional>
#include <vector>

#include "likelihood_terms.h"
#include "match_groups.h"
#include "match_likelihood.h"
#include "outlier_density.h"
#include "vmcl/estimation/likelihood.h"
#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

/// log(1 - e + e r) = log(1 - e) + log(1 + e r / (1 - e)), summed over the likelihood ratios r of matches: most add
/// only the first part, outlier_sum over all, and the product of the second runs several matches to a logarithm.
class LogLikelihoodSum {
 public:
  LogLikelihoodSum(double inlier_prior, double outlier_sum)
      : sum_(outlier_sum), odds_(inlier_prior / (1 - inlier_prior)) {}

  void add(double likelihood_ratio) {
    product_ *= 1 + odds_ * likelihood_ratio;
    if (product_ < 1e200) return;
    sum_ += std::log(product_);
    product_ = 1;
  }

  double total() const { return sum_ + std::log(product_); }

 private:
  double sum_, odds_, product_ = 1;
};

/// What every evaluation of the likelihood needs, laid out for its loops.
struct PoseLikelihood::Prepared {
  Prepared(const PoseProblem& problem, const LikelihoodOptions& options);
  Prepared(const Prepared& other, const LikelihoodOptions& options);

  LikelihoodOptions options;
  InverseDepthPrior inverse_depth_prior;
  std::optional<OutlierDensity> outlier_density;  ///< uniform if there is none
  MatchGroups matches;
  std::vector<double> inlier_odds;  ///< by match, over those of the share of inliers; empty where all are 1
  double outlier_sum = 0;           ///< L of a pose that explains nothing

  /// For many planar poses at once; made when first asked for.
  const std::optional<LikelihoodTerms>& terms() const;

  /// Evaluates every match at one pose: on_match(index, residual) for those that the pose explains at all. Without
  /// derivatives, the residual holds only the likelihood ratio.
  template <bool with_derivatives = true, class OnMatch>
  void visit(const Rigid3& map_from_robot, OnMatch&& on_match) const {
    MatchResidual residual;
    for (const PointGroup& group : matches.points) {
      const PointView view(matches.query_cameras[static_cast<std::size_t>(group.query)], map_from_robot, options);
      for (std::size_t i = 0; i < group.pixel.size(); ++i) {
        view.template evaluate<with_derivatives>(group.pixel[i], group.point_in_map[i], group.covariance[i], residual);
        residual.likelihood_ratio *= group.worth[i];
        if (residual.likelihood_ratio > 0) on_match(group.match[i], residual);
      }
    }
    for (const RayGroup& group : matches.rays) {
      const RayView view(matches.query_cameras[static_cast<std::size_t>(group.query)],
                         matches.reference_cameras[static_cast<std::size_t>(group.reference)], map_from_robot, options,
                         inverse_depth_prior);
      for (std::size_t i = 0; i < group.query_pixel.size(); ++i) {
        view.template evaluate<with_derivatives>(group.query_pixel[i], group.reference_pixel[i], residual);
        residual.likelihood_ratio *= group.worth[i];
        if (residual.likelihood_ratio > 0) on_match(group.match[i], residual);
      }
    }
  }

 private:
  void weighMatches();

  mutable std::once_flag terms_asked_for_;
  mutable std::optional<LikelihoodTerms> terms_;
};

}  // namespace vmcl
