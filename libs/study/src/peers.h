// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vmcl/study/pose_method.h"

namespace vmcl {

/// The estimators of the paper as it describes them, on vmcl's minimal solvers: 500 samples scored by truncated
/// squared residuals, and local optimization of each best one.
std::vector<PoseMethod> inlierCountingMethods();

/// EPnP and AP3P in OpenCV's RANSAC, and OpenCV's MAGSAC++. Sets OpenCV to one thread, for the whole process.
std::vector<PoseMethod> openCvMethods();

/// P3P, GP3P and UPnP of OpenGV; none where vmcl was built without it.
std::vector<PoseMethod> openGvMethods();

}  // namespace vmcl
