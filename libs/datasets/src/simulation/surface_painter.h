// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "light.h"
#include "scene.h"

namespace vmcl {

/// The BGR image of a surface as it is painted, lower left corner at the lower left. The same seed and number give the
/// same image, another number another image.
cv::Mat paintSurface(const Surface& surface, uint64_t seed, uint64_t number);

/// Shades the image of a surface where no lamps are placed in the scene: evenly lit, with some daylight from one side.
void shadeEvenly(cv::Mat& image, const Surface& surface, const Light& light);

}  // namespace vmcl
