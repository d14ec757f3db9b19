// SPDX-License-Identifier: BSD-3-Clause
#include "floor_slope.h"

#include "vmcl/geometry/random.h"

namespace vmcl {

FloorSlope::FloorSlope(double sigma, uint64_t seed) : sigma_(sigma) {
  Random random(seed, 77);
  for (Wave* waves : {pitch_, roll_})
    for (int i = 0; i < count_; ++i) {
      const double direction = random.uniform(0, 2 * std::numbers::pi);
      const double frequency = 2 * std::numbers::pi / random.uniform(0.8, 3.0);
      waves[i] = {frequency * std::cos(direction), frequency * std::sin(direction),
                  random.uniform(0, 2 * std::numbers::pi)};
    }
}

double FloorSlope::at(const Wave* waves, double x, double y) const {
  double sum = 0;
  for (int i = 0; i < count_; ++i) sum += std::sin(waves[i].along_x * x + waves[i].along_y * y + waves[i].phase);
  return sigma_ * sum / std::sqrt(count_ / 2.0);
}

Rigid3 FloorSlope::tilted(const PlanarPose& map_from_robot) const {
  const double x = map_from_robot.x, y = map_from_robot.y;
  Rigid3 pose = Rigid3::Identity();
  pose.translate(Eigen::Vector3d(x, y, 0));
  pose.rotate(Eigen::AngleAxisd(at(pitch_, x, y), Eigen::Vector3d::UnitY()));  // of the floor: axes of the map
  pose.rotate(Eigen::AngleAxisd(at(roll_, x, y), Eigen::Vector3d::UnitX()));
  pose.rotate(Eigen::AngleAxisd(map_from_robot.phi, Eigen::Vector3d::UnitZ()));
  return pose;
}

}  // namespace vmcl
