// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <string>

#include "vmcl/vision/image.h"

namespace vmcl {

/// A neural network that tells from the heat map of a keyframe which solution suits matches with it, 1P1DP or 2DP. An
/// ONNX file: in, 1 x 3 x height x width of fixed size, RGB in [0, 1]; out, two numbers, the larger for the better
/// solution, 1P1DP's first. share/selector makes such files. Thread safe, one run at a time.
class SolutionNetwork {
 public:
  /// Throws std::runtime_error naming the file: missing, no ONNX file or cut off, another shape.
  explicit SolutionNetwork(const std::string& file);
  ~SolutionNetwork();
  SolutionNetwork(SolutionNetwork&&) noexcept;

  /// Of the heat maps that it takes, pixels.
  int width() const;
  int height() const;

  /// The two outputs. Throws std::invalid_argument for another size, std::runtime_error when the network fails.
  std::array<float, 2> operator()(const ImageView& heat_map) const;

 private:
  std::unique_ptr<class Network> network_;
};

}  // namespace vmcl
