// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/geometry/trajectory.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "vmcl/geometry/atomic_file.h"

namespace vmcl {

Trajectory::Trajectory(std::vector<StampedPose> poses) : poses_(std::move(poses)) {
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    if (!std::isfinite(poses_[i].time) || !poses_[i].map_from_robot.matrix().allFinite())
      throw std::invalid_argument("trajectory pose " + std::to_string(i) + " is not finite");
    if (i > 0 && poses_[i].time <= poses_[i - 1].time)
      throw std::invalid_argument("trajectory pose " + std::to_string(i) + " is not later than the one before");
  }
}

std::optional<Rigid3> Trajectory::at(double time, double max_gap) const {
  const auto after = std::lower_bound(poses_.begin(), poses_.end(), time,
                                      [](const StampedPose& pose, double t) { return pose.time < t; });
  if (after == poses_.end()) return std::nullopt;
  if (after->time == time) return after->map_from_robot;
  if (after == poses_.begin()) return std::nullopt;
  const auto before = std::prev(after);
  if (after->time - before->time > max_gap) return std::nullopt;
  const double share = (time - before->time) / (after->time - before->time);
  const Eigen::Quaterniond from(before->map_from_robot.linear()), to(after->map_from_robot.linear());
  Rigid3 pose = Rigid3::Identity();
  pose.translation() = (1 - share) * before->map_from_robot.translation() + share * after->map_from_robot.translation();
  pose.linear() = from.slerp(share, to).toRotationMatrix();
  return pose;
}

namespace {

StampedPose parseTumLine(const std::string& line) {
  std::istringstream words(line);
  StampedPose pose;
  Eigen::Vector3d t;
  Eigen::Quaterniond q;
  if (!(words >> pose.time >> t.x() >> t.y() >> t.z() >> q.x() >> q.y() >> q.z() >> q.w()))
    throw std::invalid_argument("expected `time tx ty tz qx qy qz qw`");
  if (!(std::abs(q.norm() - 1) < 1e-2)) throw std::invalid_argument("quaternion is not of length 1");
  pose.map_from_robot.translation() = t;
  pose.map_from_robot.linear() = q.normalized().toRotationMatrix();
  return pose;
}

}  // namespace

Trajectory readTumTrajectory(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + ": cannot be opened");
  std::vector<StampedPose> poses;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const auto start = line.find_first_not_of(" \t\r");
    if (start == std::string::npos || line[start] == '#') continue;
    try {
      poses.push_back(parseTumLine(line));
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(file.string() + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  try {
    return Trajectory(std::move(poses));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

void writeTumTrajectory(const std::filesystem::path& file, const Trajectory& trajectory) {
  AtomicFile out(file);
  out.stream() << "# time[s] tx ty tz qx qy qz qw\n" << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (const StampedPose& pose : trajectory.poses()) {
    const Eigen::Vector3d t = pose.map_from_robot.translation();
    const Eigen::Quaterniond q(pose.map_from_robot.linear());
    out.stream() << pose.time << ' ' << t.x() << ' ' << t.y() << ' ' << t.z() << ' ' << q.x() << ' ' << q.y() << ' '
                 << q.z() << ' ' << q.w() << '\n';
  }
  out.commit();
}

}  // namespace vmcl
