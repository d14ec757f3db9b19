// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "vmcl/study/study.h"

namespace vmcl {
namespace {

/// At the share q of the sorted values; 0 for none.
double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  const auto k = static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<std::size_t>(k)];
}

ErrorSummary errorSummary(const std::vector<double>& errors) {
  std::vector<double> squares;
  for (const double error : errors) squares.push_back(error * error);
  return {rootMean(squares), bootstrapRootMean(squares), quantile(errors, 0.5)};
}

/// Counts and errors of one row, over what error_of(trial) gives.
template <class ErrorOf>
MethodSummary summarizeErrors(const std::string& name, const std::vector<TrialResult>& trials, ErrorOf&& error_of) {
  MethodSummary summary;
  summary.method = name;
  summary.trials = static_cast<int>(trials.size());
  std::vector<double> distances, angles, over_bound;
  for (const TrialResult& trial : trials) {
    const std::optional<EstimationError>& error = error_of(trial);
    if (!error) continue;
    ++summary.answered;
    summary.successes += error->isSuccess();
    distances.push_back(error->distance);
    angles.push_back(error->angle);
    if (error->isSuccess()) over_bound.push_back(error->squared_over_bound / 3);
  }
  summary.distance = errorSummary(distances);
  summary.angle = errorSummary(angles);
  summary.over_bound = rootMean(over_bound);
  summary.over_bound_interval = bootstrapRootMean(over_bound);
  return summary;
}

}  // namespace

std::vector<MethodSummary> summarize(const std::vector<PoseMethod>& methods, const std::vector<TrialResult>& trials) {
  std::vector<MethodSummary> rows;
  for (std::size_t m = 0; m <= methods.size(); ++m) {
    const auto outcome = [m](const TrialResult& trial) -> const MethodOutcome& { return trial.outcomes[m]; };
    MethodSummary& row = rows.emplace_back(summarizeErrors(
        m < methods.size() ? methods[m].name : bound_name, trials,
        [&](const TrialResult& trial) -> const std::optional<EstimationError>& { return outcome(trial).error; }));
    std::vector<double> seconds;
    for (const TrialResult& trial : trials) {
      row.any_successes += outcome(trial).any_success;
      seconds.push_back(outcome(trial).seconds);
    }
    row.seconds = {quantile(seconds, 0.25), quantile(seconds, 0.5), quantile(seconds, 0.75)};
  }
  rows.push_back(summarizeErrors(
      cramer_rao_name, trials, [](const TrialResult& trial) -> const auto& { return trial.cramer_rao; }));
  return rows;
}

}  // namespace vmcl
