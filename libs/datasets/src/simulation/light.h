// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "triangle_tree.h"

namespace vmcl {

/// The light of a session.
struct Light {
  double brightness = 1;                  ///< of everything, 1: as painted
  double daylight_azimuth = 0;            ///< direction towards the sun, in the map (rad)
  double lamps = 1;                       ///< of the lamps, 0: switched off
  double daylight = 1;                    ///< through the windows and of the view from them, 0: night
  std::array<int, 3> rgb{255, 255, 255};  ///< colour of the light
};

/// How brightly surfaces are lit: straight from lamps and windows with the shadows in between, and by an even rest that
/// is weaker in corners and under furniture (ambient occlusion, Zhukov et al. 1998).
class LightTracer {
 public:
  LightTracer(const std::vector<Triangle>& triangles, const std::vector<Lamp>& lamps, const Light& light);

  /// At a point of a surface with this outward normal; 1 shows a surface as it is painted. At most `most`.
  float at(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

  static constexpr float most = 1.7f;

 private:
  double powerOf(const Lamp& lamp) const;
  float fromLamp(const Lamp& lamp, const Eigen::Vector3f& point, const Eigen::Vector3f& normal) const;
  float openness(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) const;

  TriangleTree tree_;
  std::vector<Lamp> lamps_;
  Light light_;
};

}  // namespace vmcl
