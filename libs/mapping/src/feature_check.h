// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "vmcl/vision/features.h"

namespace vmcl {

/// Throws std::invalid_argument, beginning with `name`, for features of another kind, more than an image may have,
/// arrays that differ in length, descriptors of another size, or values that are not finite.
void checkFeatures(const FeatureSet& features, FeatureKind kind, const std::string& name);

}  // namespace vmcl
