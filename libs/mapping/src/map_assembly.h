// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruct.h"

namespace vmcl {

/// The map of a reconstructed scene: corrected cameras and pixels, adjusted poses, the points whose marginal covariance
/// is sane as landmarks (the others are counted in `result`), and how to recognize its places.
KeyframeMap assembleMap(const Reconstruction& scene, ReconstructionResult& result, const MapBuilderOptions& options);

MapBuildReport reportOf(const KeyframeMap& map, const Reconstruction& scene, const ReconstructionResult& result);

}  // namespace vmcl
