// SPDX-License-Identifier: BSD-3-Clause
#include "people.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "shapes.h"

namespace vmcl {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double walk_step = 0.02;      // s
constexpr double waits_within = 0.9;    // m of the robot
constexpr double steps_aside = 0.6;     // m
constexpr double turn_rate = 4;         // rad/s
constexpr double stride_length = 1.35;  // m for both legs
constexpr double seat = 0.46;           // m above the ground

enum Part : std::size_t { skin, hair, shirt, trousers, shoes, part_count };

/// Where somebody is after so many metres along a path and back, again and again; and the direction.
std::pair<Vector2d, Vector2d> along(const std::vector<Vector2d>& path, double way) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  double rest = std::fmod(way, 2 * length);
  const bool back = rest > length;
  if (back) rest = 2 * length - rest;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector2d leg = path[i] - path[i - 1];
    if (rest <= leg.norm() || i + 1 == path.size()) {
      const Vector2d direction = leg.normalized();
      return {path[i - 1] + rest * direction, back ? Vector2d(-direction) : direction};
    }
    rest -= leg.norm();
  }
  return {path.front(), Vector2d::UnitX()};
}

/// The joints of one leg or arm in the person's frame: x forward, y left, z up.
struct Bend {
  Vector3d top, middle, end;
};

Bend bend(const Vector3d& top, double upper, double lower, double swing, double flex) {
  const auto direction = [](double angle) { return Vector3d(std::sin(angle), 0, -std::cos(angle)); };
  const Vector3d middle = top + upper * direction(swing);
  return {top, middle, middle + lower * direction(swing + flex)};
}

}  // namespace

Crowd::Crowd(const std::vector<Person>& people, const Trajectory& robot)
    : people_(people), start_time_(robot.empty() ? 0 : robot.poses().front().time) {
  for (const Person& person : people) {
    const auto add = [&](double width, double height, const Material& material) {
      surfaces_.push_back({width, height, material, {}, Vector3d::UnitX(), 150});
    };
    add(0.5, 0.3, {"plain", {222, 178, 150}});
    add(0.5, 0.3, {"plain", {62, 44, 34}});
    add(0.9, 0.6, {"cloth", person.shirt});
    add(0.6, 0.5, {"cloth", person.trousers});
    add(0.3, 0.3, {"plain", {40, 36, 34}});
    stances_.push_back(walk(person, robot));
  }
}

std::vector<Crowd::Stance> Crowd::walk(const Person& person, const Trajectory& robot) const {
  Stance stance{{person.path.front().x(), person.path.front().y(), person.yaw}, 0, 0};
  std::vector<Stance> stances{stance};
  const bool walks = person.path.size() > 1;
  if (walks) {
    const Vector2d ahead = along(person.path, 0).second;
    stance.map_from_person.phi = std::atan2(ahead.y(), ahead.x());
  }
  for (double time = start_time_; time <= robot.poses().back().time; time += walk_step) {
    const Vector2d robot_place = robot.at(time).value_or(Rigid3::Identity()).translation().head<2>();
    const auto [next, direction] = walks ? along(person.path, stance.walked + walk_step * person.speed)
                                         : std::pair(person.path.front(), Vector2d(1, 0));
    const Vector2d here = walks ? along(person.path, stance.walked).first : next;
    const bool approaches = (next - robot_place).norm() < (here - robot_place).norm();
    const bool waits = time < start_time_ + person.start || ((next - robot_place).norm() < waits_within && approaches);
    const bool moves = walks && !waits;
    stance.stride += std::clamp((moves ? 1.0 : 0.0) - stance.stride, -3 * walk_step, 3 * walk_step);
    if (moves) {
      stance.walked += walk_step * person.speed;
      const double turn = wrapAngle(std::atan2(direction.y(), direction.x()) - stance.map_from_person.phi);
      stance.map_from_person.phi += std::clamp(turn, -turn_rate * walk_step, turn_rate * walk_step);
    }
    Vector2d place = moves ? next : here;
    const Vector2d off = place - robot_place;
    if (!person.sits && off.norm() < steps_aside && off.norm() > 1e-6)
      place = robot_place + steps_aside * off.normalized();
    stance.map_from_person.x = place.x();
    stance.map_from_person.y = place.y();
    stances.push_back(stance);
  }
  return stances;
}

std::vector<Face> Crowd::at(double time) const {
  std::vector<Face> faces;
  for (std::size_t i = 0; i < people_.size(); ++i) {
    const auto index = static_cast<std::size_t>(std::max(0.0, std::round((time - start_time_) / walk_step)));
    addFigure(faces, people_[i], stances_[i][std::min(index, stances_[i].size() - 1)], i * part_count);
  }
  return faces;
}

void Crowd::addFigure(std::vector<Face>& faces, const Person& person, const Stance& stance,
                      std::size_t first_surface) const {
  const double h = person.height, phase = 2 * std::numbers::pi * stance.walked / stride_length;
  const double hip = person.sits ? seat + 0.09 : 0.52 * h, lift = hip - 0.52 * h;
  const std::size_t first = faces.size();
  const auto surfaceOf = [&](Part part) { return first_surface + part; };
  const auto limb = [&](const Vector3d& from, const Vector3d& to, double from_radius, double to_radius, Part part,
                        double flatness = 1) {
    const Surface& look = surfaces_[surfaceOf(part)];
    addLimb(faces, {from, to, from_radius, to_radius, Vector3d::UnitY(), flatness}, surfaceOf(part), look.width,
            look.height);
  };
  const auto ball = [&](const Vector3d& center, const Vector3d& radii, Part part) {
    addBall(faces, center, radii, surfaceOf(part), surfaces_[surfaceOf(part)].width, surfaces_[surfaceOf(part)].height);
  };
  for (const double side : {-1.0, 1.0}) {
    const double swing = person.sits ? 1.45 : side * 0.42 * stance.stride * std::sin(phase);
    const double knee = person.sits ? -1.45 : -0.55 * stance.stride * std::max(0.0, side * std::cos(phase)) - 0.04;
    const Bend leg = bend({0, side * 0.055 * h, hip}, 0.245 * h, 0.24 * h, swing, knee);
    limb(leg.top, leg.middle, 0.055 * h, 0.038 * h, trousers);
    limb(leg.middle, leg.end, 0.038 * h, 0.028 * h, trousers);
    ball(leg.middle, Vector3d::Constant(0.04 * h), trousers);
    ball(leg.end + Vector3d(0.035 * h, 0, -0.005 * h), {0.075 * h, 0.03 * h, 0.028 * h}, shoes);
    const double arm_swing = person.sits ? 0.5 : -side * 0.4 * stance.stride * std::sin(phase);
    const Bend arm = bend({0, side * 0.125 * h, 0.805 * h + lift}, 0.17 * h, 0.15 * h, arm_swing,
                          person.sits ? 1.0 : 0.15 + 0.2 * stance.stride);
    limb(arm.top, arm.middle, 0.032 * h, 0.027 * h, shirt);
    limb(arm.middle, arm.end, 0.025 * h, 0.019 * h, shirt);
    ball(arm.top, Vector3d::Constant(0.037 * h), shirt);
    ball(arm.end, Vector3d::Constant(0.026 * h), skin);
  }
  limb({0, 0, hip - 0.03 * h}, {0, 0, 0.62 * h + lift}, 0.098 * h, 0.088 * h, trousers, 0.68);
  limb({0, 0, 0.58 * h + lift}, {0, 0, 0.77 * h + lift}, 0.094 * h, 0.122 * h, shirt, 0.62);
  limb({0, 0, 0.77 * h + lift}, {0, 0, 0.84 * h + lift}, 0.122 * h, 0.05 * h, shirt, 0.6);
  limb({0, 0, 0.82 * h + lift}, {0, 0, 0.88 * h + lift}, 0.033 * h, 0.031 * h, skin);
  ball({0.008 * h, 0, 0.925 * h + lift}, {0.058 * h, 0.047 * h, 0.068 * h}, skin);
  ball({-0.008 * h, 0, 0.943 * h + lift}, {0.058 * h, 0.052 * h, 0.06 * h}, hair);
  const Rigid3 map_from_person = toRigid3(stance.map_from_person);
  for (std::size_t i = first; i < faces.size(); ++i) {
    for (Vector3d& corner : faces[i].corners) corner = map_from_person * corner;
    for (Vector3d& normal : faces[i].normals) normal = map_from_person.linear() * normal;
  }
}

}  // namespace vmcl
