// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "vmcl/geometry/pose_problem.h"

namespace vmcl {

/// A pixel in a view at a known pose.
struct Sighting {
  ReferenceCamera view;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

/// The point of least squared reprojection error: started where the rays pass each other most closely, then
/// Levenberg-Marquardt. Its covariance is that of pixels with standard deviation sigma_px in views without error.
/// Nothing when the rays are parallel or the point lies behind a view.
std::optional<MapPoint> triangulate(std::span<const Sighting> sightings, double sigma_px);

/// Whether the point is so well known that a Gaussian describes it: no axis of its covariance is uncertain by more than
/// a third of the distance to the nearest view.
bool isWellPlaced(const MapPoint& point, std::span<const Sighting> sightings);

/// Pixels between the projection of the point and where it was seen; infinite behind the view.
double reprojectionError(const Sighting& sighting, const Eigen::Vector3d& point_in_map);

}  // namespace vmcl
