// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace vmcl {

/// Calls on_root(cos(phi), sin(phi)) for the headings that solve A cos(phi) + B sin(phi) + C = 0, two or one: where
/// noise pushes the line past the unit circle, the double root on the circle. Not for A = B = 0.
template <class OnRoot>
void solveHeading(double A, double B, double C, OnRoot&& on_root) {
  const double n = A * A + B * B, D = n - C * C;
  if (D <= 0) {
    const double r = (C > 0 ? -1 : 1) / std::sqrt(n);
    on_root(A * r, B * r);
    return;
  }
  const double root = std::sqrt(D), inverse_n = 1 / n;
  on_root((-A * C - B * root) * inverse_n, (-B * C + A * root) * inverse_n);
  on_root((-A * C + B * root) * inverse_n, (-B * C - A * root) * inverse_n);
}

}  // namespace vmcl
