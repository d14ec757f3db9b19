// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/odometry_motion_model.h"

#include <algorithm>
#include <utility>

#include "option_range.h"

namespace vmcl {
namespace {

constexpr double least_way = 0.01;  // m: of less no direction can be told

double square(double value) { return value * value; }

/// Of a turn or of the half turn beyond it, the smaller.
double turnOrBacking(double turn) { return std::min(std::abs(turn), std::abs(wrapAngle(turn - std::numbers::pi))); }

PlanarPose drawDifferential(const OdometryMotionModel& model, const PlanarPose& movement, Random& random) {
  const double way = std::hypot(movement.x, movement.y);
  const double first_turn = way < least_way ? 0 : std::atan2(movement.y, movement.x);
  const double last_turn = wrapAngle(movement.phi - first_turn);
  const double first = square(turnOrBacking(first_turn)), last = square(turnOrBacking(last_turn));
  const auto noise = [&](double variance) { return std::sqrt(variance) * random.normal(); };
  const double drawn_first = first_turn + noise(model.alpha1 * first + model.alpha2 * square(way));
  const double drawn_way = way + noise(model.alpha3 * square(way) + model.alpha4 * (first + last));
  const double drawn_last = last_turn + noise(model.alpha1 * last + model.alpha2 * square(way));
  return {drawn_way * std::cos(drawn_first), drawn_way * std::sin(drawn_first), wrapAngle(drawn_first + drawn_last)};
}

PlanarPose drawOmnidirectional(const OdometryMotionModel& model, const PlanarPose& movement, Random& random) {
  const double way = std::hypot(movement.x, movement.y), turn = movement.phi;
  const double direction = std::atan2(movement.y, movement.x);
  const auto noise = [&](double variance) { return std::sqrt(variance) * random.normal(); };
  const double along = way + noise(model.alpha3 * square(way) + model.alpha1 * square(turn));
  const double across = noise(model.alpha5 * square(way) + model.alpha1 * square(turn));
  const double drawn_turn = turn + noise(model.alpha4 * square(turn) + model.alpha2 * square(way));
  const double c = std::cos(direction), s = std::sin(direction);
  return {c * along - s * across, s * along + c * across, wrapAngle(drawn_turn)};
}

}  // namespace

void OdometryMotionModel::check() const {
  for (const auto& [name, alpha] :
       {std::pair{"alpha1", alpha1}, {"alpha2", alpha2}, {"alpha3", alpha3}, {"alpha4", alpha4}, {"alpha5", alpha5}})
    demand(alpha >= 0 && alpha <= 100, name, alpha, "in [0, 100]");
}

PlanarPose OdometryMotionModel::draw(const PlanarPose& movement, Random& random) const {
  return drive == Drive::differential ? drawDifferential(*this, movement, random)
                                      : drawOmnidirectional(*this, movement, random);
}

}  // namespace vmcl
