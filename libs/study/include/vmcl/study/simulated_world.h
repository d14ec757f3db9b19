// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "vmcl/geometry/pose_problem.h"
#include "vmcl/geometry/random.h"

namespace vmcl {

/// Random worlds in which the reference camera sees points that the query camera sees again from a random planar pose.
enum class World {
  paper,    ///< Jiao et al. 2020, section V-A: points in a cube of +-8 m, any heading, up to 2 m along either axis
  authors,  ///< as their published scripts have it: points 2 to 8 m ahead, turned by 0 to 90 deg, moved by up to 1 m
  uniform,  ///< as `paper`, but outliers fall anywhere in the query image
};

/// "paper", "authors" or "uniform".
std::string_view nameOf(World world);

/// What is asked of a world. In `paper` and `authors` an outlier is a point seen from a wrong random pose of its own.
struct WorldSettings {
  World world = World::paper;
  int cameras = 1;              ///< of the robot, 60 deg apart on a circle of radius 0.25 m; each has its own reference
  int matches_per_camera = 50;  ///< at least 2
  double outlier_rate = 0;      ///< share of each camera's matches, in [0, 1], rounded to whole matches
  double depth_rate = 1;        ///< share of each camera's matches whose depth is reliable, in [0, 1], one at least
  double noise_px = 2;          ///< standard deviation of a pixel coordinate in either image, at most 100
  double tilt = 0;              ///< of the robot, about a random horizontal axis through its origin; rad, in [0, 0.2]

  /// Throws std::invalid_argument naming the bad key.
  void check() const;
};

/// Standard deviation (m) of a point's depth along the optical axis of its reference camera.
double depthNoise(World world);

struct MatchTruth {
  bool inlier = false;
  Eigen::Vector3d point_in_map = Eigen::Vector3d::Zero();
};

struct SimulatedProblem {
  PoseProblem problem;
  PlanarPose map_from_robot;      ///< the answer
  std::vector<MatchTruth> truth;  ///< of each match
};

/// The same settings and the same state of `random` give the same problem.
SimulatedProblem simulateProblem(const WorldSettings& settings, Random& random);

}  // namespace vmcl
