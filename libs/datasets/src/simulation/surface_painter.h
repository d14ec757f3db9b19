// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "scene.h"

namespace vmcl {

/// Light of a session: lamps everywhere, and some daylight from one side.
struct Light {
  double brightness = 1;        ///< of everything, 1: as painted
  double daylight_azimuth = 0;  ///< direction towards the windows, in the map (rad)
};

/// The BGR image of a surface, lower left corner at the lower left. The same seed and number give the same image
/// but for the light; another number another image.
cv::Mat paintSurface(const Surface& surface, const Light& light, uint64_t seed, uint64_t number);

}  // namespace vmcl
