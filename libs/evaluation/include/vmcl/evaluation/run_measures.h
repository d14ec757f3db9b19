// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "vmcl/evaluation/lifelong_score.h"
#include "vmcl/evaluation/localization_report.h"
#include "vmcl/evaluation/relative_error.h"
#include "vmcl/evaluation/trajectory_error.h"

namespace vmcl {

/// The paper's thresholds of success: distances (m), each together with EvaluationOptions::success_heading.
inline constexpr std::array<double, 3> success_distances{0.25, 0.5, 1.0};

/// What a run says after an update.
struct RunUpdate {
  TimedEstimate estimate;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x, y, phi): m, m, rad
  int particles = 0;
  bool lost = false;  ///< says that it is
};

/// All that is measured of one run against its ground truth. A measure without a value did not come to pass, or has
/// nothing to be measured on.
struct RunMeasures {
  int updates = 0;                      ///< compared with the ground truth
  std::optional<double> position_rmse;  ///< unaligned, while localized, m
  std::optional<double> position_median;
  std::optional<double> heading_rmse;  ///< rad
  std::optional<double> heading_median;
  std::optional<double> relative_position;                 ///< over 1 s, while localized, RMSE, m
  std::optional<double> relative_heading;                  ///< rad
  std::array<double, success_distances.size()> success{};  ///< shares of all updates, localized or not
  std::optional<double> time_to_converge;                  ///< s
  std::optional<double> distance_to_converge;              ///< m, along the true path
  bool found = false;                                      ///< converges within 30 s and succeeds in the last update
  std::optional<double> recovery_time;                     ///< from when the kidnapped robot sees again, s
  std::optional<double> notice_time;                       ///< from then until it says that it is lost, s; none if it
                                                           ///< recovers first, or was not localized when carried off
  std::optional<bool> noticed;               ///< that within 2 s; only if it was localized when carried off
  std::optional<double> kidnapped_distance;  ///< that it was carried, m; only if it was
  double false_accept_share = 0;             ///< of the updates at which it is localized; 0: never localized
  LifelongScore lifelong;
  std::optional<double> nees;  ///< normalized estimation error squared, mean while localized; 3 when consistent
  double particles = 0;        ///< mean
};

RunMeasures measureRun(const std::vector<RunUpdate>& updates, const Trajectory& ground_truth,
                       const std::optional<Kidnapped>& kidnapped = std::nullopt);

/// Squared Mahalanobis length of the error (3 on average if the covariance is right; Bar-Shalom et al. 2001, 5.4).
/// Nothing when the covariance is not positive definite.
std::optional<double> normalizedSquaredError(const PlanarPose& estimate, const Eigen::Matrix3d& covariance,
                                             const PlanarPose& truth);

/// Of the true positions between two times, m.
double distanceAlong(const Trajectory& path, double from, double to);

}  // namespace vmcl
