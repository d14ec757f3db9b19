// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace vmcl {

/// Refuses an option that is not valid: std::invalid_argument with key, value and range.
template <class Number>
void demand(bool valid, const char* key, Number value, const std::string& range) {
  if (valid) return;
  std::ostringstream message;
  message << key << " = " << value << " is not " << range;
  throw std::invalid_argument(message.str());
}

inline void demandPositive(const char* key, double value) {
  demand(value > 0 && std::isfinite(value), key, value, "positive and finite");
}

inline void demandNotNegative(const char* key, double value) {
  demand(value >= 0 && std::isfinite(value), key, value, "at least 0 and finite");
}

}  // namespace vmcl
