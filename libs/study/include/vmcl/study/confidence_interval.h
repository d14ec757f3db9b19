// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

namespace vmcl {

/// Holds the true value with 95 % confidence.
struct Interval {
  double low = 0;
  double high = 0;
};

/// Of a rate, from `successes` in `trials` > 0 (Wilson 1927).
Interval wilsonInterval(int successes, int trials);

/// Square root of the mean of squares; 0 for none.
double rootMean(std::span<const double> squares);

/// 0 for none.
double mean(std::span<const double> values);

/// Of an even number: the mean of the middle two. 0 for none.
double median(std::span<const double> values);

/// Of these: percentiles of 1000 bootstrap samples, always the same ones. {0, 0} for none.
Interval bootstrapRootMean(std::span<const double> squares);
Interval bootstrapMean(std::span<const double> values);
Interval bootstrapMedian(std::span<const double> values);

}  // namespace vmcl
