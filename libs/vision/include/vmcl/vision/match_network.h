// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "vmcl/vision/dense_matching.h"

namespace vmcl {

/// A neural network that finds what one image shows in another, of an ONNX file as doc/features.md has it: for each
/// cell of the reference a place in the query, and how sure it is. Thread safe, one run at a time.
class MatchNetwork {
 public:
  /// Throws std::runtime_error naming the file: missing, no ONNX file or cut off, another shape.
  explicit MatchNetwork(const std::string& file);
  ~MatchNetwork();

  /// A matcher for this query image, that takes what lies between cells that are sure (0.5) and agree to lie between
  /// their places. The network, the image and the mask must outlive it, whose match() also throws std::runtime_error
  /// when the network fails. Throws std::invalid_argument for an empty image or a mask that does not fit.
  std::unique_ptr<DenseMatcher> matcher(const ImageView& query, const ImageMask& mask) const;

 private:
  std::unique_ptr<class Network> network_;
};

}  // namespace vmcl
