// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>

#include <opencv2/core.hpp>

namespace vmcl {

/// A colour image's observation joined by a depth image that is aligned with it: 16 bit, millimetres along the optical
/// axis, 0 where nothing was measured. The colour image itself is left out.
mrpt::obs::CObservation3DRangeScan depthObservation(const mrpt::obs::CObservationImage& colour,
                                                    const cv::Mat& millimetres);

}  // namespace vmcl
