// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/evaluation/lifelong_score.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vmcl {

LifelongScore lifelongScore(std::span<const TimedEstimate> estimates, const Trajectory& ground_truth,
                            const LifelongOptions& options) {
  constexpr double max_gap = 0.5;  // of the ground truth, s: as evaluate.py has it
  std::vector<PoseError> errors;
  for (const TimedEstimate& estimate : estimates)
    if (const auto error = poseError(estimate, ground_truth, max_gap); error && estimate.localized)
      errors.push_back(*error);
  LifelongScore score;
  score.relocalization_time = std::numeric_limits<double>::infinity();
  if (errors.empty()) return score;
  const auto isCorrect = [&](const PoseError& error) {
    return error.position <= options.max_position_error && error.heading <= options.max_heading_error;
  };
  const double begin = ground_truth.poses().front().time, end = ground_truth.poses().back().time;
  double correct_time = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double next = i + 1 < errors.size() ? errors[i + 1].time : end;
    if (isCorrect(errors[i])) correct_time += std::min(options.max_interval, next - errors[i].time);
  }
  if (end > begin) score.correct_rate = correct_time / (end - begin);
  score.relocalization_time = errors.front().time - begin;
  if (isCorrect(errors.front()))
    score.relocalization_score = std::exp(-score.relocalization_time / options.relocalization_time_constant);
  return score;
}

}  // namespace vmcl
