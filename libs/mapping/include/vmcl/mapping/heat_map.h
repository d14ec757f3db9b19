// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vmcl/mapping/keyframe_map.h"
#include "vmcl/vision/image.h"

namespace vmcl {

/// What a network sees of a keyframe to choose the solution: a colour image of what is known of its landmarks (Jiao et
/// al. 2020, section IV-B and Fig. 4).
///
/// Each landmark is a Gaussian of 1/32 of the image's width (20 of 640 pixels) about its feature, and they add up. Its
/// height is in red the landmark's depth along the optical axis, full at 10 m or more; in green its standard deviation
/// along the ray, full at 0.5 m or more; in blue the number of its observations, full at 20 or more. 255 is what eight
/// landmarks of full height at one place come to. Any size in pixels, at least 1, for the whole image; a keyframe
/// without landmarks is black.
ColourImage heatMap(const KeyframeMap& map, const Keyframe& keyframe, int width, int height);

}  // namespace vmcl
