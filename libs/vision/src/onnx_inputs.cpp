// SPDX-License-Identifier: BSD-3-Clause
#include "onnx_inputs.h"

#include <algorithm>
#include <stdexcept>

namespace vmcl {
namespace {

/// A field of a message in protocol buffers' wire format.
struct Field {
  uint64_t number = 0;
  uint64_t value = 0;      ///< of type 0
  std::string_view bytes;  ///< of the others
};

class FieldReader {
 public:
  explicit FieldReader(std::string_view message) : rest_(message) {}

  bool next(Field& field) {
    if (rest_.empty()) return false;
    const uint64_t key = number();
    field = {key >> 3, 0, {}};
    switch (key & 7) {
      case 0:
        field.value = number();
        break;
      case 1:
        field.bytes = take(8);
        break;
      case 2:
        field.bytes = take(number());
        break;
      case 5:
        field.bytes = take(4);
        break;
      default:
        throw std::runtime_error("not an ONNX model");
    }
    return true;
  }

 private:
  uint64_t number() {
    uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const auto byte = static_cast<uint8_t>(take(1)[0]);
      value |= static_cast<uint64_t>(byte & 0x7f) << shift;
      if (byte < 0x80) return value;
    }
    throw std::runtime_error("not an ONNX model");
  }

  std::string_view take(uint64_t count) {
    if (count > rest_.size()) throw std::runtime_error("no ONNX model, or cut off");
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  std::string_view rest_;
};

std::vector<std::string_view> all(std::string_view message, uint64_t number) {
  std::vector<std::string_view> found;
  Field field;
  for (FieldReader reader(message); reader.next(field);)
    if (field.number == number) found.push_back(field.bytes);
  return found;
}

std::string_view first(std::string_view message, uint64_t number) {
  const auto found = all(message, number);
  return found.empty() ? std::string_view() : found.front();
}

/// TypeProto.tensor_type.shape.dim of a ValueInfoProto.
std::vector<uint64_t> dimensionsOf(std::string_view value_info) {
  std::vector<uint64_t> dimensions;
  for (const std::string_view dimension : all(first(first(first(value_info, 2), 1), 2), 1)) {
    dimensions.push_back(0);
    Field field;
    for (FieldReader reader(dimension); reader.next(field);)
      if (field.number == 1) dimensions.back() = field.value;
  }
  return dimensions;
}

}  // namespace

std::vector<OnnxInput> onnxInputs(std::string_view model) {
  const std::string_view graph = first(model, 7);
  std::vector<std::string_view> stored;
  for (const std::string_view tensor : all(graph, 5)) stored.push_back(first(tensor, 8));
  std::vector<OnnxInput> inputs;
  for (const std::string_view value_info : all(graph, 11)) {
    const std::string_view name = first(value_info, 1);
    if (std::ranges::find(stored, name) == stored.end())
      inputs.push_back({std::string(name), dimensionsOf(value_info)});
  }
  return inputs;
}

}  // namespace vmcl
