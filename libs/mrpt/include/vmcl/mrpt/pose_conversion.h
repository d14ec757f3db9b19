// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/poses/CPose2D.h>
#include <mrpt/poses/CPose3D.h>

#include "vmcl/geometry/planar_pose.h"

namespace vmcl {

/// MRPT's poses as ours: the same frames, metres and radians.
inline Rigid3 toRigid3(const mrpt::poses::CPose3D& pose) {
  Rigid3 rigid = Rigid3::Identity();
  rigid.matrix() = pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen();
  return rigid;
}

inline PlanarPose toPlanarPose(const mrpt::poses::CPose2D& pose) { return {pose.x(), pose.y(), pose.phi()}; }

}  // namespace vmcl
