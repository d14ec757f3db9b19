// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "vmcl/estimation/estimator.h"
#include "vmcl/geometry/random.h"

namespace vmcl {

/// The modes of an estimate as a density to draw particles from: Gaussians widened by the kernel of PoseDensity, so
/// that both densities are known at the same resolution, with headings wrapped around the circle.
class ModeMixture {
 public:
  /// Throws std::invalid_argument for no modes or a covariance that is not positive semidefinite.
  explicit ModeMixture(std::span<const PoseMode> modes);

  PlanarPose draw(Random& random) const;

  /// 1/(m^2 rad).
  double density(const PlanarPose& pose) const;

 private:
  struct Component {
    PlanarPose mean;
    Eigen::Matrix3d root;     ///< lower Cholesky factor of the covariance
    double weight = 0;        ///< share of the mixture
    double peak_density = 0;  ///< weight times the Gaussian at its mean
    int wraps = 0;            ///< turns, either way, that a drawn heading may have gone too far
  };
  std::vector<Component> components_;
};

}  // namespace vmcl
