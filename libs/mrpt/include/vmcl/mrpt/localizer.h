// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "vmcl/mrpt/health.h"
#include "vmcl/mrpt/localization_config.h"
#include "vmcl/mrpt/observation_order.h"
#include "vmcl/mrpt/odometry_track.h"
#include "vmcl/mrpt/planar_monte_carlo.h"
#include "vmcl/mrpt/pose_cluster.h"
#include "vmcl/mrpt/way_since_use.h"

namespace vmcl {

/// What is known after one update.
struct LocalizationFrame {
  double time = 0;             ///< of the observation, s
  bool localized = false;      ///< the status is tracking
  Health health;               ///< the status and its evidence
  PoseCluster cluster;         ///< the dominant one: the reported pose
  double effective_share = 0;  ///< effective sample size over number of particles
  int particles = 0;
  int inliers = 0;     ///< of the best mode of each image of the frame, in total
  double latency = 0;  ///< that the update took, s of real time
};

/// Localizes a robot in a map, as AMCL does, with cameras, lasers or whatever the maps take:
///
///     vmcl::Localizer localizer(vmcl::LocalizerOptions::amcl());
///     localizer.setMap(maps);
///     localizer.setInitialPose({{1, 2, 0}, covariance});          // or localizer.globalLocalization();
///     localizer.process(movement, observations);                  // whenever there are new ones
///     vmcl::PoseWithCovariance pose = localizer.estimate();       // good while health().status is tracking
///
/// Nothing that comes in makes it throw once it is made, but a bad map or start: broken or repeated observations
/// and movements are left out and named by takeProblems(). Not thread safe; those of one process may take turns, but
/// not run at the same time, as MRPT's random generator is lent to one of them.
class Localizer {
 public:
  /// Without map and start. Throws std::invalid_argument naming the bad option.
  explicit Localizer(const LocalizerOptions& options);

  /// With the map, starting where the configuration says. Throws std::invalid_argument for options that do not go
  /// together, std::logic_error for a start anywhere in a map that does not tell where the robot may be.
  Localizer(const LocalizationConfig& config, mrpt::maps::CMultiMetricMap::Ptr maps);

  /// Localizes in this map from now on; the particles stay where they are. `extent`: where the robot may be if the map
  /// itself, with a grid or a visual map, does not tell. Throws std::invalid_argument when nothing of it is free.
  void setMap(mrpt::maps::CMultiMetricMap::Ptr maps, const std::optional<PoseBox>& extent = std::nullopt);

  /// The robot is about here when the next observation is taken. Off the map it is named by takeProblems(). Throws
  /// std::invalid_argument for a pose or covariance that is none.
  void setInitialPose(const PoseWithCovariance& pose);

  /// The robot may be anywhere in the map. Throws std::logic_error when the map does not tell where that is.
  void globalLocalization();

  /// The next observation is used even if the robot has not moved.
  void requestNoMotionUpdate() { update_requested_ = true; }

  /// Takes in observations made at one time and the action that led to it from those before: one of MRPT, or the
  /// movement that the odometry tells of, in the robot's frame. Nothing comes back when nothing was used: no start
  /// given, not moved by update_min_d or update_min_a (while the odometry tells so), or nothing that a map can use.
  std::optional<LocalizationFrame> process(const mrpt::obs::CActionCollection* action,
                                           const mrpt::obs::CSensoryFrame& observations);
  std::optional<LocalizationFrame> process(const PlanarPose& movement, const mrpt::obs::CSensoryFrame& observations);

  /// Takes in one step of a log: either a frame with the action that led to it, or a single observation, odometry among
  /// them. In a log whose sensors have fallen silent, odometry gives a frame each time another degraded_after is over.
  std::optional<LocalizationFrame> step(const mrpt::obs::CActionCollection::Ptr& action,
                                        const mrpt::obs::CSensoryFrame::Ptr& frame,
                                        const mrpt::obs::CObservation::Ptr& observation);

  /// The robot has been carried off: the odometry does not tell how it came from the last reading to the next.
  void kidnap() { odometry_.interrupt(); }

  /// The dominant cluster, moved by the odometry since the last update. Throws std::logic_error before the start.
  PoseWithCovariance estimate() const;

  /// All places where the robot may be, the likeliest first; none before the start.
  std::vector<PoseCluster> clusters() const;

  const Health& health() const { return monitor_.health(); }

  /// One line per broken observation or movement since the last call.
  std::vector<std::string> takeProblems();

  const PlanarMonteCarlo& particles() const { return filter_; }
  const mrpt::maps::CMultiMetricMap& maps() const { return *maps_; }

 private:
  struct Used;

  void restart();
  mrpt::obs::CSensoryFrame newOnes(const mrpt::obs::CSensoryFrame& frame);
  std::optional<LocalizationFrame> processNew(const mrpt::obs::CSensoryFrame& observations);
  void advance(const PlanarPose& movement);
  void advance(const mrpt::obs::CActionCollection& action);
  void noteMovement(const PlanarPose& movement);
  mrpt::obs::CSensoryFrame dueOnes(const mrpt::obs::CSensoryFrame& frame, double time) const;
  std::optional<LocalizationFrame> update(const mrpt::obs::CSensoryFrame& observations);
  Used usable(const mrpt::obs::CSensoryFrame& frame);
  std::optional<PoseWithCovariance> expectation(const std::string& camera);
  bool isUsable(const mrpt::obs::CActionCollection& action);
  std::optional<LocalizationFrame> addOdometry(const mrpt::obs::CObservationOdometry& reading);
  mrpt::obs::CActionCollection actionOf(const PlanarPose& movement) const;
  void allowForStoppedOdometry(double time);
  LocalizationFrame report(double time, const PoseCluster& cluster);
  std::nullopt_t leaveOut(const std::exception& error);
  bool noteSilence(double time);
  double timeOf(const mrpt::obs::CSensoryFrame& frame) const;
  UpdateEvidence evidence(const Used& used, const PoseCluster& cluster);
  void countSteadyFrames(const PoseCluster& cluster, UpdateEvidence& evidence);
  void recover(double time);

  LocalizerOptions options_;
  mrpt::maps::CMultiMetricMap::Ptr maps_;
  PoseRegion anywhere_;
  PlanarMonteCarlo filter_;
  HealthMonitor monitor_;
  OdometryTrack odometry_;
  ObservationOrder order_;
  Random random_;                  ///< of the poses that observations are judged by
  PlanarPose pending_;             ///< movement that the particles have not made yet
  bool noise_is_pending_ = false;  ///< nor been spread by its noise
  bool has_stood_ = false;         ///< since the last observation
  WaySinceUse since_use_;
  bool update_requested_ = false;
  std::vector<std::string> problems_;
  int steps_to_skip_ = 0;
  std::map<std::string, int> guided_updates_;  ///< in a row, of each camera
  std::optional<PlanarPose> expected_;         ///< the cluster of the last update, moved by the odometry since
  int steady_frames_ = 0;                      ///< updates in a row with a narrow cluster where it was expected
  std::optional<double> updated_at_;           ///< s: when the last update was; nothing: the start is there
  std::optional<double> seen_at_;  ///< s: when one that could be used last came, or its absence was last noted
  bool odometry_stopped_ = false;
  std::optional<double> lost_at_;  ///< s
  bool scattered_nearby_ = false;  ///< since then
};

}  // namespace vmcl
