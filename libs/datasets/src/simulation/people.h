// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "scene.h"
#include "vmcl/geometry/trajectory.h"

namespace vmcl {

/// Somebody who walks along a path and back again, stands where the path has one place only, or sits there.
struct Person {
  std::vector<Eigen::Vector2d> path;
  double yaw = 0;        ///< of one who does not walk (rad)
  double speed = 1.0;    ///< m/s
  double start = 0;      ///< s after the robot
  double height = 1.72;  ///< m
  bool sits = false;     ///< on a chair of 0.45 m
  std::array<int, 3> shirt{120, 60, 60};
  std::array<int, 3> trousers{50, 60, 90};
};

/// The people of a session, moving. They wait for the robot, and step aside where it comes closer.
class Crowd {
 public:
  Crowd(const std::vector<Person>& people, const Trajectory& robot);

  /// What the figures show.
  const std::vector<Surface>& surfaces() const { return surfaces_; }

  /// All figures at a time of the robot's path.
  std::vector<Face> at(double time) const;

 private:
  struct Stance {
    PlanarPose map_from_person;
    double walked = 0;  ///< m
    double stride = 0;  ///< how widely the limbs swing, [0, 1]
  };

  std::vector<Stance> walk(const Person& person, const Trajectory& robot) const;
  void addFigure(std::vector<Face>& faces, const Person& person, const Stance& stance, std::size_t first_surface) const;

  std::vector<Person> people_;
  std::vector<Surface> surfaces_;
  double start_time_ = 0;
  std::vector<std::vector<Stance>> stances_;  ///< of each person, by time
};

}  // namespace vmcl
