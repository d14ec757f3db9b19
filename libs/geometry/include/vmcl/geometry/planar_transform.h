// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "vmcl/geometry/planar_pose.h"

namespace vmcl {

/// A planar pose with its heading kept as cosine and sine: what solvers find and scoring needs, without trigonometry.
struct PlanarTransform {
  double c = 1;
  double s = 0;
  double x = 0;
  double y = 0;

  PlanarTransform() = default;
  PlanarTransform(double c_, double s_, double x_, double y_) : c(c_), s(s_), x(x_), y(y_) {}
  explicit PlanarTransform(const PlanarPose& pose)
      : c(std::cos(pose.phi)), s(std::sin(pose.phi)), x(pose.x), y(pose.y) {}

  PlanarPose pose() const { return {x, y, std::atan2(s, c)}; }

  Rigid3 rigid() const {
    Rigid3 rigid = Rigid3::Identity();
    rigid.linear().topLeftCorner<2, 2>() << c, -s, s, c;
    rigid.translation() << x, y, 0;
    return rigid;
  }
};

}  // namespace vmcl
