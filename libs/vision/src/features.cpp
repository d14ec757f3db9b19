// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/vision/features.h"

#include <stdexcept>
#include <string>

namespace vmcl {

FeatureKind featureKindFromName(std::string_view name) {
  if (name == "orb") return FeatureKind::orb;
  if (name == "sift") return FeatureKind::sift;
  throw std::invalid_argument("feature kind is \"" + std::string(name) + "\", not orb or sift");
}

std::string_view nameOf(FeatureKind kind) { return kind == FeatureKind::orb ? "orb" : "sift"; }

int descriptorBytes(FeatureKind kind) { return kind == FeatureKind::orb ? 32 : 128; }

void FeatureOptions::check() const {
  if (kind != FeatureKind::orb && kind != FeatureKind::sift)
    throw std::invalid_argument("kind is " + std::to_string(static_cast<int>(kind)) + ", not orb or sift");
  if (max_features < 1 || max_features > most_features)
    throw std::invalid_argument("max_features is " + std::to_string(max_features) + ", not in [1, " +
                                std::to_string(most_features) + "]");
  if (mask_rows_from_top < 0)
    throw std::invalid_argument("mask_rows_from_top is " + std::to_string(mask_rows_from_top) + ", negative");
}

}  // namespace vmcl
