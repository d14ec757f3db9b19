// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cstdint>
#include <limits>
#include <optional>

#include "vmcl/geometry/random.h"

namespace vmcl {

/// Less light for the cameras: a dark room, or a hand before the lens.
struct Dimming {
  double at = 0;     ///< s after the first time of the log
  double lasts = 0;  ///< s
  double light = 0;  ///< that is left, [0, 1]; 0: black images
};

/// What goes wrong on a drive.
struct Disturbance {
  double dropped_images = 0;  ///< share that gets lost, [0, 1)
  std::optional<Dimming> dimming;
  double odometry_scale = 1;  ///< of the distances, not the turns, that the odometry tells, (0, 10]

  bool isNone() const { return dropped_images == 0 && !dimming && odometry_scale == 1; }

  /// Throws std::invalid_argument naming the bad key.
  void check() const;
};

/// Puts a disturbance into a drive, step by step. Of depth cameras it is the image that is disturbed.
class DisturbedDrive {
 public:
  DisturbedDrive(const Disturbance& disturbance, uint64_t seed);

  /// Changes what a step of a log holds, of which any may be null; false when its observation is lost. An image that
  /// cannot be read stays as it is.
  bool disturb(mrpt::obs::CActionCollection* action, mrpt::obs::CSensoryFrame* frame,
               mrpt::obs::CObservation* observation);

 private:
  bool disturb(mrpt::obs::CObservation& observation);
  bool isDim(const mrpt::obs::CObservation& observation);

  Disturbance disturbance_;
  Random random_;
  double begin_ = std::numeric_limits<double>::quiet_NaN();  ///< first time of the log
};

}  // namespace vmcl
