// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/evaluation/run_measures.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace vmcl {
namespace {

std::vector<TimedEstimate> estimatesOf(const std::vector<RunUpdate>& updates) {
  std::vector<TimedEstimate> estimates;
  for (const RunUpdate& update : updates) estimates.push_back(update.estimate);
  return estimates;
}

double successShare(std::span<const TimedEstimate> estimates, const Trajectory& ground_truth, double distance) {
  EvaluationOptions options;
  options.success_position = distance;
  return evaluateTrajectory(estimates, ground_truth, options).success_share;
}

std::optional<double> meanNees(const std::vector<RunUpdate>& updates, const Trajectory& ground_truth, double max_gap) {
  double sum = 0;
  int count = 0;
  for (const RunUpdate& update : updates) {
    const auto truth = ground_truth.at(update.estimate.time, max_gap);
    if (!update.estimate.localized || !truth) continue;
    const auto nees = normalizedSquaredError(update.estimate.robot_in_map, update.covariance, planarPart(*truth));
    if (!nees) continue;
    sum += *nees;
    ++count;
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

/// Distance on the ground between the true poses around the time without sight.
std::optional<double> carriedDistance(const Trajectory& ground_truth, const Kidnapped& kidnapped) {
  const auto before = ground_truth.at(kidnapped.from), after = ground_truth.at(kidnapped.until);
  if (!before || !after) return std::nullopt;
  return (after->translation() - before->translation()).head<2>().norm();
}

bool localizedBefore(double time, const std::vector<RunUpdate>& updates) {
  const auto next = std::find_if(updates.begin(), updates.end(),
                                 [&](const RunUpdate& update) { return update.estimate.time >= time; });
  return next != updates.begin() && std::prev(next)->estimate.localized;
}

/// From the first update to the first that says lost, if that comes before the robot recovers.
std::optional<double> timeToNotice(const std::vector<RunUpdate>& updates, const std::optional<double>& recovery_time) {
  const auto lost = std::find_if(updates.begin(), updates.end(), [](const RunUpdate& update) { return update.lost; });
  if (lost == updates.end()) return std::nullopt;
  const double time = lost->estimate.time - updates.front().estimate.time;
  return recovery_time && time >= *recovery_time ? std::nullopt : std::optional(time);
}

void measureRecovery(const std::vector<RunUpdate>& updates, const Trajectory& ground_truth, const Kidnapped& kidnapped,
                     RunMeasures& measures) {
  const auto seeing = std::find_if(updates.begin(), updates.end(),
                                   [&](const RunUpdate& update) { return update.estimate.time >= kidnapped.until; });
  const std::vector<RunUpdate> since(seeing, updates.end());
  measures.recovery_time = evaluateTrajectory(estimatesOf(since), ground_truth).time_to_converge;
  measures.kidnapped_distance = carriedDistance(ground_truth, kidnapped);
  if (!localizedBefore(kidnapped.from, updates)) return;  // it has no pose to lose
  constexpr double soon = 2;                              // s
  measures.notice_time = timeToNotice(since, measures.recovery_time);
  measures.noticed = measures.notice_time && *measures.notice_time <= soon;
}

}  // namespace

double distanceAlong(const Trajectory& path, double from, double to) {
  double distance = 0;
  std::optional<Eigen::Vector2d> last;
  const auto visit = [&](const Rigid3& map_from_robot) {
    const Eigen::Vector2d position = map_from_robot.translation().head<2>();
    if (last) distance += (position - *last).norm();
    last = position;
  };
  if (const auto start = path.at(from)) visit(*start);
  for (const StampedPose& pose : path.poses())
    if (pose.time > from && pose.time < to) visit(pose.map_from_robot);
  if (const auto end = path.at(to)) visit(*end);
  return distance;
}

std::optional<double> normalizedSquaredError(const PlanarPose& estimate, const Eigen::Matrix3d& covariance,
                                             const PlanarPose& truth) {
  const Eigen::LLT<Eigen::Matrix3d> factor(covariance);
  if (factor.info() != Eigen::Success) return std::nullopt;
  const Eigen::Vector3d error(estimate.x - truth.x, estimate.y - truth.y, wrapAngle(estimate.phi - truth.phi));
  const double squared = factor.matrixL().solve(error).squaredNorm();
  return std::isfinite(squared) ? std::optional(squared) : std::nullopt;
}

RunMeasures measureRun(const std::vector<RunUpdate>& updates, const Trajectory& ground_truth,
                       const std::optional<Kidnapped>& kidnapped) {
  const std::vector<TimedEstimate> estimates = estimatesOf(updates);
  const TrajectoryEvaluation evaluation = evaluateTrajectory(estimates, ground_truth);
  RunMeasures measures;
  measures.updates = evaluation.compared;
  if (evaluation.localized > 0) {
    measures.position_rmse = evaluation.position.rmse;
    measures.position_median = evaluation.position.median;
    measures.heading_rmse = evaluation.heading.rmse;
    measures.heading_median = evaluation.heading.median;
    measures.false_accept_share = static_cast<double>(evaluation.false_accepts) / evaluation.localized;
  }
  if (const RelativeError relative = relativeError(estimates, ground_truth); relative.pairs > 0) {
    measures.relative_position = relative.position;
    measures.relative_heading = relative.heading;
  }
  for (std::size_t i = 0; i < success_distances.size(); ++i)
    measures.success[i] = successShare(estimates, ground_truth, success_distances[i]);
  if ((measures.time_to_converge = evaluation.time_to_converge)) {
    const double begin = estimates.front().time;
    measures.distance_to_converge = distanceAlong(ground_truth, begin, begin + *evaluation.time_to_converge);
  }
  constexpr double soon = 30;  // s
  const auto& time = evaluation.time_to_converge;
  measures.found = time && *time <= soon && evaluation.ends_in_success;
  if (kidnapped) measureRecovery(updates, ground_truth, *kidnapped, measures);
  measures.lifelong = lifelongScore(estimates, ground_truth);
  measures.nees = meanNees(updates, ground_truth, EvaluationOptions().max_gap);
  for (const RunUpdate& update : updates) measures.particles += update.particles;
  if (!updates.empty()) measures.particles /= static_cast<double>(updates.size());
  return measures;
}

}  // namespace vmcl
