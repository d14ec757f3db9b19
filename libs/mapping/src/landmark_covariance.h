// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bundle_adjustment.h"

namespace vmcl {

/// Marginal covariance of every point of an adjusted scene, map frame: noise of pixels and depths and what is left
/// uncertain in poses and mounts; infinite where the observations do not fix the point (Triggs et al., "Bundle
/// adjustment - a modern synthesis", 2000, section 9).
std::vector<Eigen::Matrix3d> pointCovariances(const Reconstruction& scene, const AdjustmentNoise& noise);

}  // namespace vmcl
