// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/evaluation/trajectory_error.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace vmcl {
namespace {

constexpr double settling_time = 0.5;  // s

struct Compared {
  PoseError error;
  bool localized = false;
  bool success = false;
};

/// The first estimate that is localized and right, and stays right for the settling time.
std::optional<std::size_t> convergence(const std::vector<Compared>& compared) {
  for (std::size_t i = 0; i < compared.size(); ++i) {
    if (!compared[i].localized || !compared[i].success) continue;
    std::size_t next = i;
    while (next < compared.size() && compared[next].success &&
           compared[next].error.time <= compared[i].error.time + settling_time)
      ++next;
    if (next == compared.size() || compared[next].success) return i;
  }
  return std::nullopt;
}

template <typename Member, typename Take>
ErrorStatistics statisticsWhere(const std::vector<Compared>& compared, Member member, Take&& take) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < compared.size(); ++i)
    if (take(i)) errors.push_back(compared[i].error.*member);
  return statisticsOf(std::move(errors));
}

}  // namespace

void EvaluationOptions::check() const {
  const auto demand = [](const char* key, double value) {
    if (!(value > 0) || !std::isfinite(value))
      throw std::invalid_argument(std::string(key) + " = " + std::to_string(value) + " is not positive");
  };
  demand("success_position", success_position);
  demand("success_heading", success_heading);
  demand("accept_position", accept_position);
  demand("accept_heading", accept_heading);
  demand("max_gap", max_gap);
}

ErrorStatistics statisticsOf(std::vector<double> errors) {
  if (errors.empty()) return {};
  std::sort(errors.begin(), errors.end());
  double squares = 0;
  for (const double error : errors) squares += error * error;
  const std::size_t middle = errors.size() / 2;
  const double median = errors.size() % 2 ? errors[middle] : (errors[middle - 1] + errors[middle]) / 2;
  return {std::sqrt(squares / static_cast<double>(errors.size())), median, errors.back()};
}

std::optional<PoseError> poseError(const TimedEstimate& estimate, const Trajectory& ground_truth, double max_gap) {
  const auto truth = ground_truth.at(estimate.time, max_gap);
  if (!truth) return std::nullopt;
  const PlanarPose true_pose = planarPart(*truth);
  return PoseError{estimate.time,
                   std::hypot(estimate.robot_in_map.x - true_pose.x, estimate.robot_in_map.y - true_pose.y),
                   std::abs(wrapAngle(estimate.robot_in_map.phi - true_pose.phi))};
}

TrajectoryEvaluation evaluateTrajectory(std::span<const TimedEstimate> estimates, const Trajectory& ground_truth,
                                        const EvaluationOptions& options) {
  options.check();
  TrajectoryEvaluation result;
  result.estimates = static_cast<int>(estimates.size());
  std::vector<Compared> compared;
  int successes = 0;
  for (const TimedEstimate& estimate : estimates) {
    const auto error = poseError(estimate, ground_truth, options.max_gap);
    if (!error) continue;
    const bool success = error->position <= options.success_position && error->heading <= options.success_heading;
    const bool wrong = error->position > options.accept_position || error->heading > options.accept_heading;
    compared.push_back({*error, estimate.localized, success});
    successes += success;
    result.localized += estimate.localized;
    result.false_accepts += estimate.localized && wrong;
  }
  result.compared = static_cast<int>(compared.size());
  if (compared.empty()) return result;
  result.ends_in_success = compared.back().success;
  result.success_share = static_cast<double>(successes) / result.compared;
  const auto localized = [&](std::size_t i) { return compared[i].localized; };
  result.position = statisticsWhere(compared, &PoseError::position, localized);
  result.heading = statisticsWhere(compared, &PoseError::heading, localized);
  if (const auto converged = convergence(compared)) {
    result.time_to_converge = compared[*converged].error.time - estimates.front().time;
    const auto after = [&](std::size_t i) { return i >= *converged; };
    result.position_after = statisticsWhere(compared, &PoseError::position, after);
    result.heading_after = statisticsWhere(compared, &PoseError::heading, after);
  }
  return result;
}

}  // namespace vmcl
