// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>

#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>

#include "vmcl/estimation/likelihood.h"
#include "vmcl/mrpt/pose_with_covariance.h"
#include "vmcl/mrpt/visual_map_options.h"
#include "vmcl/relocalization/relocalizer.h"

namespace vmcl {

/// What an image says about the robot's pose: its matches with the map, ready to weigh particles.
struct ImageMeasurement {
  std::string error;  ///< why the image cannot be used; empty: it can
  PoseProblem problem;
  std::optional<PoseLikelihood> likelihood;  ///< none without matches
  double weight = 1;                         ///< factor of the log likelihood
  double independent_matches = 0;            ///< that all matches together count as

  /// Weighted log likelihood; 0 when the image says nothing.
  double logLikelihood(const PlanarPose& robot_in_map) const;

  /// Adds it at many poses; sizes must agree.
  void addLogLikelihoods(std::span<const PlanarPose> robot_in_map, std::span<double> log_likelihoods) const;
};

/// Matches every image with the map once, however many particles ask. MRPT gives no sign of a new observation, so it is
/// known by its address, time and label. Thread safe.
class ImageMeasurements {
 public:
  ImageMeasurements(std::shared_ptr<const KeyframeMap> map, const VisualMapOptions& options);

  /// Broken images give a measurement with an error. A new image is matched near where the robot is expected, if it is
  /// (Relocalizer::match), unless matches are kept in a directory: those that other runs find there must not depend on
  /// what this one expected.
  std::shared_ptr<const ImageMeasurement> of(const mrpt::obs::CObservation& observation,
                                             const PoseWithCovariance* expected = nullptr);

  /// Of the image that came last; null before the first.
  std::shared_ptr<const ImageMeasurement> latest();

  const Relocalizer& relocalizer() const { return relocalizer_; }

 private:
  struct Entry {
    const mrpt::obs::CObservation* address;
    mrpt::Clock::time_point time;
    std::string label;
    std::shared_ptr<const ImageMeasurement> measurement;
  };

  PoseProblem match(const mrpt::obs::CObservation& observation, const PoseWithCovariance* expected) const;
  void measure(const mrpt::obs::CObservation& observation, const PoseWithCovariance* expected,
               ImageMeasurement& measurement) const;

  VisualMapOptions options_;
  Relocalizer relocalizer_;
  std::mutex mutex_;
  std::deque<Entry> recent_;  ///< newest first
};

}  // namespace vmcl
