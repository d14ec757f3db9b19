// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>

namespace vmcl {

/// The observation of a camera joined by another of the same kind that stands `baseline` (m) to its right. The images
/// are left out.
mrpt::obs::CObservationStereoImages stereoObservation(const mrpt::obs::CObservationImage& left, double baseline);

}  // namespace vmcl
