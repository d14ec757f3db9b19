// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace vmcl {

/// AMCL's test for a lost robot (Thrun, Burgard, Fox: Probabilistic Robotics, table 8.3): two running averages of the
/// mean likelihood of the particles, and as share of random particles max(0, 1 - w_fast / w_slow). Kept as logarithms,
/// because MRPT's likelihoods of whole scans leave the range of a double. They go on while particles are replaced, as
/// in the book; AMCL starts them anew, which makes recovery one burst of no more than the share recovery_alpha_fast.
class RecoveryAverages {
 public:
  /// Rates in [0, 1]; recovery is off unless both are positive. Throws std::invalid_argument naming the bad rate.
  RecoveryAverages(double recovery_alpha_slow, double recovery_alpha_fast)
      : alpha_slow_(recovery_alpha_slow), alpha_fast_(recovery_alpha_fast) {
    checkRate("recovery_alpha_slow", alpha_slow_);
    checkRate("recovery_alpha_fast", alpha_fast_);
  }

  /// Takes in the logarithm of the mean likelihood of one update. The first sets both averages, as in AMCL.
  void add(double log_mean_likelihood) {
    if (!(alpha_slow_ > 0 && alpha_fast_ > 0)) return;
    log_slow_ = started_ ? blend(log_slow_, log_mean_likelihood, alpha_slow_) : log_mean_likelihood;
    log_fast_ = started_ ? blend(log_fast_, log_mean_likelihood, alpha_fast_) : log_mean_likelihood;
    started_ = true;
  }

  /// Share of the particles to replace, [0, 1).
  double randomShare() const { return started_ ? std::max(0.0, -std::expm1(log_fast_ - log_slow_)) : 0; }

 private:
  static void checkRate(const char* name, double rate) {
    if (!(rate >= 0 && rate <= 1))
      throw std::invalid_argument(std::string(name) + " = " + std::to_string(rate) + " is not in [0, 1]");
  }

  /// log((1 - rate) e^a + rate e^b).
  static double blend(double a, double b, double rate) {
    const double top = std::max(a, b);
    return top + std::log((1 - rate) * std::exp(a - top) + rate * std::exp(b - top));
  }

  double alpha_slow_;
  double alpha_fast_;
  double log_slow_ = 0;
  double log_fast_ = 0;
  bool started_ = false;
};

}  // namespace vmcl
