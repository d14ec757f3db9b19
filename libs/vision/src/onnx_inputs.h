// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vmcl {

/// An input that an ONNX file declares; a dimension that is free is 0.
struct OnnxInput {
  std::string name;
  std::vector<uint64_t> dimensions;
};

/// The inputs of the graph that no stored weights fill. OpenCV does not tell them. Throws std::runtime_error for bytes
/// that are no ONNX model.
std::vector<OnnxInput> onnxInputs(std::string_view model);

}  // namespace vmcl
