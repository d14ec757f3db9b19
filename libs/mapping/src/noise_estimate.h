// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "measurement_noise.h"
#include "reconstruction.h"

namespace vmcl {

/// The noise that the residuals of an adjusted scene show. Robust: the median residual, enlarged by what its point took
/// up of it. What too few residuals tell of stays as assumed.
MeasurementNoise estimatedNoise(const Reconstruction& scene, const MeasurementNoise& assumed);

}  // namespace vmcl
