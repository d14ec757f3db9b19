// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>

#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "problem_report.h"
#include "vmcl/geometry/trajectory.h"
#include "vmcl/mapping/map_builder.h"

namespace vmcl {

using ReadProgress = std::function<void(double share)>;

/// Feeds the camera images of a log to a map builder. One sensor label is one camera of the map.
class PosedImages {
 public:
  /// `masks` by the label of a camera; that of "" is for all others.
  PosedImages(MapBuilder& builder, std::map<std::string, Image> masks) : builder_(builder), masks_(std::move(masks)) {}

  /// Images of a rawlog with the poses of a trajectory. Images before, after or in a gap of it are counted and skipped.
  void readRawlog(const std::filesystem::path& file, const Trajectory& trajectory, const ReadProgress& progress);

  /// Images of a CSimpleMap with its poses. Throws std::runtime_error naming the file when it is none.
  void readSimpleMap(const std::filesystem::path& file, const ReadProgress& progress);

  /// Label of a mask for a camera of which no image was seen; empty: there is none.
  std::string maskWithoutCamera() const;

  int images() const { return images_; }
  int imagesWithoutPose() const { return images_without_pose_; }

  /// What could not be used.
  void addProblem(const std::string& problem) { problems_.add(problem); }
  const ProblemReport& problems() const { return problems_; }

 private:
  void offer(const std::filesystem::path& file, const mrpt::obs::CObservation& observation,
             const std::function<std::optional<Rigid3>(double)>& pose_at);
  /// `depth`: what is beside it, where the builder cannot tell.
  int cameraOf(const struct CameraObservation& seen, DepthSource depth);

  Image maskOf(const std::string& label) const;

  MapBuilder& builder_;
  std::map<std::string, Image> masks_;
  std::map<std::string, std::pair<int, CameraCalibration>> camera_of_label_;
  int images_ = 0;
  int images_without_pose_ = 0;
  ProblemReport problems_;
};

}  // namespace vmcl
