// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <filesystem>
#include <optional>

#include "vmcl/datasets/rawlog_reader.h"
#include "vmcl/mrpt/camera_observation.h"

namespace vmcl {

/// The camera images of a log, one after the other. What cannot be used is named on stderr and passed over; a log that
/// is cut off is good up to there.
class CameraStream {
 public:
  /// `verb` starts each line on stderr. Throws std::runtime_error as RawlogReader does.
  CameraStream(std::string verb, const std::filesystem::path& rawlog);

  /// Nothing at the end.
  std::optional<CameraObservation> next();

  /// Names an image on stderr that turned out to be unusable.
  void reject(const std::string& label, double time, const std::string& reason);

  int rejectedCount() const { return rejected_count_; }

  /// Share of the log read, [0, 1].
  double progress() const { return reader_.progress(); }

 private:
  bool readEntry();
  void complain(const std::string& what);

  std::string verb_;
  std::filesystem::path rawlog_;
  RawlogReader reader_;
  std::deque<mrpt::obs::CObservation::Ptr> waiting_;
  int rejected_count_ = 0;
};

}  // namespace vmcl
