// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/study/confidence_interval.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

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

double rootMean(std::span<const double> squares) {
  if (squares.empty()) return 0;
  return std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0) / static_cast<double>(squares.size()));
}

Interval bootstrapRootMean(std::span<const double> squares) {
  if (squares.empty()) return {};
  constexpr std::size_t samples = 1000, tail = 25;
  std::array<double, samples> sums;
  Random random(1);
  const auto n = static_cast<uint32_t>(squares.size());
  for (double& sum : sums) {
    sum = 0;
    for (uint32_t i = 0; i < n; ++i) sum += squares[random.below(n)];
  }
  std::sort(sums.begin(), sums.end());
  return {std::sqrt(sums[tail] / n), std::sqrt(sums[samples - 1 - tail] / n)};
}

}  // namespace vmcl
