// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/movement.h"

#include <mrpt/obs/CActionRobotMovement3D.h>

namespace vmcl {

std::optional<mrpt::poses::CPosePDFGaussian> movementOf(const mrpt::obs::CActionCollection* action) {
  if (!action) return std::nullopt;
  for (const auto& one : *action)
    if (const auto* planar = dynamic_cast<const mrpt::obs::CActionRobotMovement2D*>(one.get_ptr().get());
        planar && !planar->poseChange)  // MRPT would follow it
      return std::nullopt;
  mrpt::poses::CPosePDFGaussian movement;
  if (const auto planar = action->getBestMovementEstimation()) {
    movement.copyFrom(*planar->poseChange);
    if (planar->estimationMethod == mrpt::obs::CActionRobotMovement2D::emOdometry)
      movement.mean = planar->rawOdometryIncrementReading;  // a mean of samples is not quite that
    return movement;
  }
  const auto spatial = action->getActionByClass<mrpt::obs::CActionRobotMovement3D>();
  if (!spatial) return std::nullopt;
  movement.copyFrom(spatial->poseChange);
  return movement;
}

}  // namespace vmcl
