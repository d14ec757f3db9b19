// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>

#include <functional>
#include <map>
#include <opencv2/core.hpp>
#include <string>

#include "vmcl/datasets/import_report.h"
#include "vmcl/datasets/rawlog_writer.h"
#include "vmcl/geometry/trajectory.h"

namespace vmcl {

/// Brings the readings of a drive, which come nearly by time, into a rawlog that is sorted by time, and joins colour
/// and depth images taken within 20 ms. Each sensor's own clock must not run backwards.
class DriveRecording {
 public:
  /// Of an image, without it and its time: label, camera, mount.
  DriveRecording(const std::filesystem::path& log, const mrpt::obs::CObservationImage& camera);

  /// A whole JPEG or PNG file; `place` names it in messages.
  void addImage(double time, std::string encoded, const std::string& extension, const std::string& place);
  void addDepth(double time, const cv::Mat& millimetres, const std::string& place);
  void addOdometry(double time, const Rigid3& odom_from_robot, const std::string& place);
  void addScan(double time, const mrpt::obs::CObservation2DRangeScan& scan, const std::string& place);
  void addTruth(double time, const Rigid3& map_from_robot, const std::string& place);

  void addProblem(const std::string& problem) { report_.problems.push_back(problem); }

  /// Throws std::runtime_error naming `source` when there was no image, the file when it cannot be written.
  ImportReport finish(const std::string& source);

 private:
  struct Image {
    std::string encoded;
    std::string extension;
  };

  /// Whether this sensor's clock went on; a problem if not.
  bool isInOrder(const std::string& sensor, double time, const std::string& place);
  void schedule(double time, std::function<void()> write);
  void writeImage(double time, const Image& image);
  void writeUntil(double time);

  std::filesystem::path log_;
  mrpt::obs::CObservationImage camera_;
  RawlogWriter writer_;
  std::map<std::string, double> last_time_;
  std::multimap<double, std::function<void()>> waiting_;
  std::map<double, cv::Mat> depth_images_;
  double written_until_ = 0;
  std::vector<StampedPose> truth_;
  ImportReport report_;
};

}  // namespace vmcl
