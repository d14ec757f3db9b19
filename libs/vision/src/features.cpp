// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/features.h"

#include <stdexcept>
#include <string>

namespace vmcl {

std::string_view nameOf(FeatureKind kind) {
  switch (kind) {
    case FeatureKind::orb:
      return "orb";
    case FeatureKind::sift:
      return "sift";
    case FeatureKind::akaze:
      return "akaze";
    case FeatureKind::network:
      return "network";
  }
  throw std::invalid_argument("feature kind is " + std::to_string(static_cast<int>(kind)));
}

bool isBinary(FeatureKind kind) { return kind == FeatureKind::orb || kind == FeatureKind::akaze; }

bool isDescriptorLength(FeatureKind kind, Eigen::Index bytes) {
  switch (kind) {
    case FeatureKind::orb:
      return bytes == 32;
    case FeatureKind::sift:
      return bytes == 128;
    case FeatureKind::akaze:
      return bytes == 64;
    case FeatureKind::network:
      return bytes > 0 && bytes <= max_descriptor_bytes;
  }
  return false;
}

void FeatureOptions::choose(std::string_view kind_or_model) {
  model = {};
  for (FeatureKind classical : {FeatureKind::orb, FeatureKind::sift, FeatureKind::akaze})
    if (kind_or_model == nameOf(classical)) {
      kind = classical;
      return;
    }
  if (!kind_or_model.ends_with(".onnx"))
    throw std::invalid_argument("features are \"" + std::string(kind_or_model) +
                                "\", not orb, sift, akaze or a .onnx file");
  kind = FeatureKind::network;
  model.file = kind_or_model;
}

void FeatureOptions::check() const {
  nameOf(kind);
  if ((kind == FeatureKind::network) != !model.file.empty())
    throw std::invalid_argument("model is \"" + model.file + "\" for features of kind " + std::string(nameOf(kind)));
  if (max_features < 1 || max_features > most_features)
    throw std::invalid_argument("max_features is " + std::to_string(max_features) + ", not in [1, " +
                                std::to_string(most_features) + "]");
  if (mask_rows_from_top < 0)
    throw std::invalid_argument("mask_rows_from_top is " + std::to_string(mask_rows_from_top) + ", negative");
}

}  // namespace vmcl
