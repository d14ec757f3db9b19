// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <optional>
#include <string>
#include <vector>

#include "vmcl/mrpt/localization_config.h"
#include "vmcl/mrpt/planar_monte_carlo.h"
#include "vmcl/mrpt/pose_cluster.h"

namespace vmcl {

/// What is known after one update.
struct LocalizationFrame {
  double time = 0;             ///< of the observation, s
  bool localized = false;      ///< by LocalizedRule
  PoseCluster cluster;         ///< the dominant one: the reported pose
  double effective_share = 0;  ///< effective sample size over number of particles
  int particles = 0;
  int inliers = 0;     ///< of the best mode of each image of the frame, in total
  double latency = 0;  ///< that the update took, s of real time
};

/// Localizes a robot from the steps of a log, either of pairs of actions and frames, or of single observations with
/// odometry among them. The particles start where the configuration says, at the first observation that a map can use.
class Localizer {
 public:
  /// Throws std::invalid_argument for options that do not go together.
  Localizer(const LocalizationConfig& config, mrpt::maps::CMultiMetricMap::Ptr maps);

  /// Takes in one step: either a frame with the action that led to it, or a single observation. Nothing comes back when
  /// there was nothing in it that a map can use. Observations that cannot be used because they are broken, and
  /// movements that are not finite or of more than 1 km, are left out and named by takeProblems().
  std::optional<LocalizationFrame> step(const mrpt::obs::CActionCollection::Ptr& action,
                                        const mrpt::obs::CSensoryFrame::Ptr& frame,
                                        const mrpt::obs::CObservation::Ptr& observation);

  /// The robot has been carried off: the odometry does not tell how it came from the last reading to the next.
  void kidnap() { odometry_.reset(); }

  /// One line per broken observation or movement since the last call.
  std::vector<std::string> takeProblems();

  const PlanarMonteCarlo& particles() const { return filter_; }
  const mrpt::maps::CMultiMetricMap& maps() const { return *maps_; }

 private:
  std::optional<LocalizationFrame> update(const mrpt::obs::CActionCollection* action,
                                          const mrpt::obs::CSensoryFrame& frame);
  mrpt::obs::CSensoryFrame usable(const mrpt::obs::CSensoryFrame& frame, std::vector<PoseMode>& modes, int& inliers);
  bool isUsable(const mrpt::obs::CActionCollection* action);
  void addOdometry(const mrpt::obs::CObservationOdometry& reading);
  mrpt::obs::CActionCollection motionSinceLastUpdate();
  void countSteadyFrames(const PoseCluster& cluster);

  LocalizationConfig config_;
  mrpt::maps::CMultiMetricMap::Ptr maps_;
  PlanarMonteCarlo filter_;
  std::optional<PlanarPose> odometry_;  ///< latest reading
  PlanarPose moved_;                    ///< by the odometry, since the particles were moved
  std::vector<std::string> problems_;
  int steps_ = 0;
  std::optional<PlanarPose> expected_;  ///< the cluster of the last update, moved by the odometry since
  int steady_frames_ = 0;               ///< updates in a row with a narrow cluster where it was expected
  bool started_ = false;                ///< an observation has been used
};

}  // namespace vmcl
