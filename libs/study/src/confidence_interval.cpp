// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/study/confidence_interval.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "vmcl/geometry/random.h"

namespace vmcl {

Interval wilsonInterval(int successes, int trials) {
  if (trials <= 0 || successes < 0 || successes > trials)
    throw std::invalid_argument("no rate: " + std::to_string(successes) + " of " + std::to_string(trials));
  constexpr double z = 1.959963985;
  const double n = trials, p = successes / n;
  const double centre = (p + z * z / (2 * n)) / (1 + z * z / n);
  const double half = z / (1 + z * z / n) * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  return {successes == 0 ? 0 : centre - half, successes == trials ? 1 : centre + half};
}

double mean(std::span<const double> values) {
  if (values.empty()) return 0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double rootMean(std::span<const double> squares) { return std::sqrt(mean(squares)); }

double median(std::span<const double> values) {
  if (values.empty()) return 0;
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const std::size_t middle = sorted.size() / 2;
  return sorted.size() % 2 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

namespace {

template <class Statistic>
Interval bootstrap(std::span<const double> values, Statistic&& statistic) {
  if (values.empty()) return {};
  constexpr std::size_t samples = 1000, tail = 25;
  std::array<double, samples> statistics;
  std::vector<double> sample(values.size());
  Random random(1);
  for (double& value : statistics) {
    for (double& drawn : sample) drawn = values[random.below(static_cast<uint32_t>(values.size()))];
    value = statistic(sample);
  }
  std::sort(statistics.begin(), statistics.end());
  return {statistics[tail], statistics[samples - 1 - tail]};
}

}  // namespace

Interval bootstrapRootMean(std::span<const double> squares) { return bootstrap(squares, rootMean); }
Interval bootstrapMean(std::span<const double> values) { return bootstrap(values, mean); }
Interval bootstrapMedian(std::span<const double> values) { return bootstrap(values, median); }

}  // namespace vmcl
