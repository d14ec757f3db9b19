// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/poses/CPosePDFParticles.h>

#include <Eigen/Core>
#include <vector>

#include "vmcl/geometry/planar_pose.h"

namespace vmcl {

/// Particles that agree on one pose.
struct PoseCluster {
  PlanarPose robot_in_map;                               ///< weighted mean
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x, y, phi): m, m, rad
  double share = 0;                                      ///< of the weight of all particles, (0, 1]

  double positionDeviation() const { return std::sqrt(covariance(0, 0) + covariance(1, 1)); }  ///< m
  double headingDeviation() const { return std::sqrt(covariance(2, 2)); }                      ///< rad
};

/// The particles within 1 m and 45 deg of the densest place, which is sought by mean shift (flat kernel) from the
/// heaviest cell of 0.5 m x 0.5 m x 30 deg. Throws std::invalid_argument when there are no particles.
PoseCluster dominantCluster(const mrpt::poses::CPosePDFParticles& particles);

/// The clusters that hold at least `min_share` of the weight, the heaviest first: each is the dominant one of the
/// particles that those before it leave. The first is dominantCluster(), whatever its share. Throws
/// std::invalid_argument when there are no particles.
std::vector<PoseCluster> poseClusters(const mrpt::poses::CPosePDFParticles& particles, double min_share = 0.02);

}  // namespace vmcl
