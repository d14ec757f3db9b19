// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "measurement_noise.h"
#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

/// A pixel in a view at a known pose.
struct Sighting {
  ReferenceCamera view;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double depth = 0;  ///< as measured along the axis (m); 0 where it was not
};

/// Why there is no point.
enum class TriangulationFailure { none, parallel_rays, behind_a_view };

struct Triangulation {
  MapPoint point;
  TriangulationFailure failure = TriangulationFailure::none;
};

/// The point of least squared reprojection and depth errors: started at the first measured depth, or else where the
/// rays pass each other most closely, then Levenberg-Marquardt. Its covariance is that of the noise in views without
/// error.
Triangulation triangulate(std::span<const Sighting> sightings, const MeasurementNoise& noise);

/// Whether the point is so well known that a Gaussian describes it: no axis of its covariance is uncertain by more than
/// a third of the distance to the nearest view.
bool isWellPlaced(const MapPoint& point, std::span<const Sighting> sightings);

/// Pixels between the projection of the point and where it was seen; infinite behind the view.
double reprojectionError(const Sighting& sighting, const Eigen::Vector3d& point_in_map);

}  // namespace vmcl
