// SPDX-License-Identifier: BSD-3-Clause
#include "exploration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <queue>
#include <stdexcept>

namespace vmcl {
namespace {

using Eigen::Vector2d;

constexpr double road_cell = 0.1;    // m
constexpr double road_berth = 0.12;  // m that the way keeps from obstacles beyond the robot's radius: room for corners
constexpr double least_way = 1.0;    // m to a goal, as the crow flies
constexpr int max_attempts = 200;    // goals that turn out not to be reachable, one after the other
constexpr double time_step = 0.015;  // s; a path that ends within it is as long as asked for
constexpr double longest_walk = 1e300;  // not reached

/// A coarse grid of the places where the robot has room.
class Roadmap {
 public:
  Roadmap(const FloorPlan& plan, double berth_radius) : plan_(plan), radius_(berth_radius) {
    const Vector2d extent = plan.high() - plan.low();
    room_ = cv::Mat_<uchar>(std::max(1, static_cast<int>(extent.y() / road_cell)),
                            std::max(1, static_cast<int>(extent.x() / road_cell)), uchar{0});
    for (int y = 0; y < room_.rows; ++y)
      for (int x = 0; x < room_.cols; ++x) room_(y, x) = plan.clearance(placeOf({x, y})) > radius_;
  }

  Vector2d placeOf(const cv::Point& at) const { return plan_.low() + road_cell * Vector2d(at.x + 0.5, at.y + 0.5); }
  cv::Point cellOf(const Vector2d& place) const {
    const Vector2d at = (place - plan_.low()) / road_cell;
    return {static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y()))};
  }

  /// The cells of the largest region that does not reach the border, as that is outside of the house; of the largest
  /// region at all if there is no such.
  std::vector<cv::Point> largestRegion() const {
    cv::Mat_<int> region;
    const int count = cv::connectedComponents(room_, region, 4, CV_32S);
    std::vector<std::vector<cv::Point>> cells(static_cast<std::size_t>(count));
    std::vector<bool> outside(static_cast<std::size_t>(count));
    for (int y = 0; y < room_.rows; ++y)
      for (int x = 0; x < room_.cols; ++x) {
        const auto number = static_cast<std::size_t>(region(y, x));
        if (number == 0) continue;
        cells[number].push_back({x, y});
        if (x == 0 || y == 0 || x == room_.cols - 1 || y == room_.rows - 1) outside[number] = true;
      }
    std::size_t best = 0;
    for (std::size_t i = 1; i < cells.size(); ++i)
      if (std::pair(!outside[i], cells[i].size()) > std::pair(best > 0 && !outside[best], cells[best].size())) best = i;
    return cells[best];
  }

  /// The cell with room that is nearest to a place, at most half a metre off.
  std::optional<cv::Point> cellNear(const Vector2d& place) const {
    std::optional<cv::Point> nearest;
    double distance = 0.5;
    const cv::Point center = cellOf(place);
    for (int dy = -5; dy <= 5; ++dy)
      for (int dx = -5; dx <= 5; ++dx) {
        const cv::Point at = center + cv::Point(dx, dy);
        if (!hasRoom(at) || (placeOf(at) - place).norm() >= distance) continue;
        distance = (placeOf(at) - place).norm();
        nearest = at;
      }
    return nearest;
  }

  /// The shortest way over cells with room (A*), none if there is none.
  std::vector<cv::Point> shortestWay(const cv::Point& start, const cv::Point& goal) const {
    cv::Mat_<double> walked(room_.size(), longest_walk);
    cv::Mat_<cv::Point> before(room_.size(), cv::Point(-1, -1));
    using Step = std::tuple<double, int, int>;
    std::priority_queue<Step, std::vector<Step>, std::greater<>> open;
    walked(start) = 0;
    open.push({0, start.x, start.y});
    while (!open.empty()) {
      const auto [estimate, x, y] = open.top();
      open.pop();
      const cv::Point here(x, y);
      if (here == goal) break;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const cv::Point next = here + cv::Point(dx, dy);
          if (!hasRoom(next)) continue;
          const double way = walked(here) + std::hypot(dx, dy);
          if (way >= walked(next)) continue;
          walked(next) = way;
          before(next) = here;
          open.push({way + cv::norm(goal - next), next.x, next.y});
        }
    }
    std::vector<cv::Point> way;
    if (walked(goal) == longest_walk) return way;
    for (cv::Point at = goal; at != cv::Point(-1, -1); at = before(at)) way.push_back(at);
    std::reverse(way.begin(), way.end());
    return way;
  }

  /// Few places, each in straight sight of the next.
  std::vector<Vector2d> straightened(const std::vector<cv::Point>& way) const {
    std::vector<Vector2d> places;
    for (std::size_t at = 0; at + 1 < way.size();) {
      std::size_t next = way.size() - 1;
      while (next > at + 1 && !isStraight(placeOf(way[at]), placeOf(way[next]))) --next;
      places.push_back(placeOf(way[next]));
      at = next;
    }
    return places;
  }

 private:
  bool hasRoom(const cv::Point& at) const { return cv::Rect({}, room_.size()).contains(at) && room_(at); }

  bool isStraight(const Vector2d& from, const Vector2d& to) const {
    const int steps = 1 + static_cast<int>((to - from).norm() / (road_cell / 2));
    for (int i = 0; i <= steps; ++i)
      if (plan_.clearance(from + static_cast<double>(i) / steps * (to - from)) <= radius_) return false;
    return true;
  }

  const FloorPlan& plan_;
  double radius_;
  cv::Mat_<uchar> room_;
};

}  // namespace

Trajectory explore(const RobotModel& robot, const FloorPlan& plan, const std::optional<PlanarPose>& start,
                   double start_time, double duration, Random& random) {
  const Roadmap map(plan, robot.radius + road_berth);
  const auto cells = map.largestRegion();
  if (cells.empty()) throw std::runtime_error("there is no room to drive");
  const auto anyCell = [&] { return cells[random.below(static_cast<uint32_t>(cells.size()))]; };
  const Vector2d place = map.placeOf(anyCell());
  PlanarPose pose{place.x(), place.y(), random.uniform(-std::numbers::pi, std::numbers::pi)};
  if (start) pose = *start;
  std::vector<StampedPose> poses{{start_time, toRigid3(pose)}};
  int attempts = 0;
  while (poses.back().time < start_time + duration - time_step) {
    if (++attempts > max_attempts) throw std::runtime_error("there is no room to drive on");
    const Vector2d here(pose.x, pose.y);
    const cv::Point goal = anyCell();
    const auto from = map.cellNear(here);
    if (!from || (map.placeOf(goal) - here).norm() < least_way) continue;
    const auto way = map.straightened(map.shortestWay(*from, goal));
    if (way.empty()) continue;
    const double now = poses.back().time;
    std::vector<Waypoint> waypoints;
    for (const Vector2d& next : way) waypoints.push_back({next});
    const Trajectory leg = driveThrough(robot, pose, waypoints, now, start_time + duration - now);
    if (obstacleOf(leg, robot, plan)) continue;
    poses.insert(poses.end(), leg.poses().begin() + 1, leg.poses().end());
    pose = planarPart(poses.back().map_from_robot);
    attempts = 0;
  }
  return Trajectory(poses);
}

}  // namespace vmcl
