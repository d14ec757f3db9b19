// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>

#include "vmcl/vision/features.h"
#include "vmcl/vision/image_mask.h"

namespace vmcl {

/// A neural network that describes whole images for place recognition, of an ONNX file as doc/features.md has it.
/// Thread safe, one run at a time.
class PlaceNetwork {
 public:
  static constexpr int max_size = 65536;

  /// Sets the model's checksum if it is 0. Throws std::runtime_error naming the file: missing, no ONNX file or cut off,
  /// another checksum, another shape.
  explicit PlaceNetwork(FeatureModel& model);
  ~PlaceNetwork();
  PlaceNetwork(PlaceNetwork&&) noexcept;

  /// Entries of a descriptor.
  int size() const { return size_; }

  /// Unit vector; zero if the network gives zeros. What the mask hides is grey to it. Throws std::invalid_argument for
  /// an empty image or a mask that does not fit, std::runtime_error naming the file when the network fails.
  Eigen::VectorXf describe(const ImageView& image, const ImageMask& mask) const;

 private:
  std::unique_ptr<class Network> network_;
  int size_ = 0;
};

}  // namespace vmcl
