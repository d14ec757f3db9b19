// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>

#include "vmcl/geometry/planar_pose.h"
#include "vmcl/relocalization/relocalizer.h"

namespace vmcl {

struct TemporalRigOptions {
  int frames = 5;                     ///< looked at together, the newest included (the paper's 5)
  double min_distance = 0.25;         ///< between two of them (m),
  double min_rotation = 20 * degree;  ///< or turn (rad)
  double shift_noise = 0.03;          ///< standard deviation of odometry's positions (m) per metre driven,
  double drift_noise = 0.01;          ///< of its headings (rad) per metre driven
  double turn_noise = 0.02;           ///< and per radian turned

  /// Throws std::invalid_argument naming the bad key.
  void check() const;
};

/// Ties the matches of frames that a robot took one after the other together by its odometry, as if cameras of one rig
/// had taken them at once. What odometry may have lost since then widens the points that earlier frames saw, alike in
/// all directions of the plane, for the heading is not known yet, and by so much that a frame's inliers together are no
/// surer than odometry. Their matches without depth, whose epipolar lines
/// nothing widens, are left out: as exact ones they would outweigh the newest frame.
class TemporalRig {
 public:
  explicit TemporalRig(const TemporalRigOptions& options);

  /// The problem of this frame and of earlier ones, for the pose of the robot at this frame. `odometry_from_robot` is
  /// the pose of the robot in the odometry's frame. Throws std::invalid_argument for a pose that is not finite.
  RelocalizationResult add(const RelocalizationResult& frame, const PlanarPose& odometry_from_robot);

 private:
  struct Frame {
    RelocalizationResult result;
    PlanarPose odometry_from_robot;
  };

  bool isApart(const PlanarPose& a, const PlanarPose& b) const;

  TemporalRigOptions options_;
  std::deque<Frame> earlier_;  ///< newest first, each apart from the next
};

}  // namespace vmcl
