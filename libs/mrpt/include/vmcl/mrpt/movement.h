// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/poses/CPosePDFGaussian.h>

#include <optional>

namespace vmcl {

/// How the robot moved by an action, on the plane, in its frame before; nothing when the action tells of no movement,
/// or of one without its change of pose.
std::optional<mrpt::poses::CPosePDFGaussian> movementOf(const mrpt::obs::CActionCollection* action);

}  // namespace vmcl
