// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/relocalization/temporal_rig.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>

namespace vmcl {
namespace {

/// How far odometry may be off between two frames: standard deviations (m, rad).
struct OdometryError {
  double position = 0, heading = 0;
};

/// As far as the error moves what is seen from the camera, which is about as far away as from the query's.
void widen(MapPoint& point, const OdometryError& error, const ReferenceCamera& camera) {
  const double distance = (point.point_in_map - camera.map_from_camera.translation()).head<2>().norm();
  const double sigma = std::hypot(error.position, error.heading * distance);
  point.covariance.diagonal().head<2>().array() += sigma * sigma;
}

/// The points of a frame share its error, but a covariance stands for what each errs by itself: for so much more that
/// the inliers together do not average the error away.
OdometryError ofEachPoint(const OdometryError& shared, std::span<const Match> matches) {
  const auto points = std::ranges::count_if(matches, [](const Match& match) { return match.point.has_value(); });
  const double inliers = LikelihoodOptions().inlier_prior * static_cast<double>(points);
  const double times = std::sqrt(std::max(1.0, inliers));
  return {times * shared.position, times * shared.heading};
}

/// Appends the cameras and matches with depth of an earlier frame, its cameras mounted where they were as seen from the
/// robot now.
void append(RelocalizationResult& result, const RelocalizationResult& frame, const Rigid3& robot_from_earlier,
            const OdometryError& shared_error) {
  PoseProblem& problem = result.problem;
  const int first_query_camera = static_cast<int>(problem.query_cameras.size());
  for (QueryCamera camera : frame.problem.query_cameras) {
    camera.robot_from_camera = robot_from_earlier * camera.robot_from_camera;
    problem.query_cameras.push_back(camera);
  }
  std::vector<int> reference_cameras;
  for (std::size_t i = 0; i < frame.keyframes.size(); ++i) {
    const auto known = std::ranges::find(result.keyframes, frame.keyframes[i]);
    reference_cameras.push_back(static_cast<int>(known - result.keyframes.begin()));
    if (known != result.keyframes.end()) continue;
    result.keyframes.push_back(frame.keyframes[i]);
    problem.reference_cameras.push_back(frame.problem.reference_cameras[i]);
  }
  const OdometryError error = ofEachPoint(shared_error, frame.problem.matches);
  for (Match match : frame.problem.matches) {
    if (!match.point) continue;
    match.query_camera += first_query_camera;
    match.reference_camera = reference_cameras[static_cast<std::size_t>(match.reference_camera)];
    widen(*match.point, error, problem.reference_cameras[static_cast<std::size_t>(match.reference_camera)]);
    problem.matches.push_back(match);
  }
}

}  // namespace

void TemporalRigOptions::check() const {
  const auto require = [](bool holds, const char* key, double value) {
    if (!holds) throw std::invalid_argument(std::string(key) + " is " + std::to_string(value));
  };
  require(frames >= 1, "frames", frames);
  require(min_distance >= 0 && std::isfinite(min_distance), "min_distance", min_distance);
  require(min_rotation >= 0 && std::isfinite(min_rotation), "min_rotation", min_rotation);
  require(shift_noise >= 0 && std::isfinite(shift_noise), "shift_noise", shift_noise);
  require(drift_noise >= 0 && std::isfinite(drift_noise), "drift_noise", drift_noise);
  require(turn_noise >= 0 && std::isfinite(turn_noise), "turn_noise", turn_noise);
}

TemporalRig::TemporalRig(const TemporalRigOptions& options) : options_(options) { options.check(); }

bool TemporalRig::isApart(const PlanarPose& a, const PlanarPose& b) const {
  const PlanarPose moved = inverse(a) * b;
  return std::hypot(moved.x, moved.y) > options_.min_distance || std::abs(moved.phi) > options_.min_rotation;
}

RelocalizationResult TemporalRig::add(const RelocalizationResult& frame, const PlanarPose& odometry_from_robot) {
  if (!isFinite(odometry_from_robot)) throw std::invalid_argument("odometry is not finite");
  RelocalizationResult joined = frame;
  int frames = 1;
  double way = 0, turn = 0;
  PlanarPose later = odometry_from_robot;
  for (const Frame& earlier : earlier_) {
    if (frames == options_.frames) break;
    const PlanarPose moved = inverse(later) * earlier.odometry_from_robot;
    way += std::hypot(moved.x, moved.y);
    turn += std::abs(moved.phi);
    later = earlier.odometry_from_robot;
    if (&earlier == &earlier_.front() && !isApart(earlier.odometry_from_robot, odometry_from_robot)) continue;
    append(joined, earlier.result, toRigid3(inverse(odometry_from_robot) * earlier.odometry_from_robot),
           {options_.shift_noise * way, std::hypot(options_.drift_noise * way, options_.turn_noise * turn)});
    ++frames;
  }
  if (earlier_.empty() || isApart(earlier_.front().odometry_from_robot, odometry_from_robot)) {
    earlier_.push_front({frame, odometry_from_robot});
    if (std::ssize(earlier_) > options_.frames) earlier_.pop_back();
  }
  return joined;
}

}  // namespace vmcl
