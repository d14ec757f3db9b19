// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <filesystem>
#include <optional>

#include "problem_report.h"
#include "vmcl/datasets/rawlog_reader.h"
#include "vmcl/mrpt/camera_observation.h"

namespace vmcl {

/// The camera images of a log, one after the other. What cannot be used is passed over and noted; a log that is cut
/// off is good up to there.
class CameraStream {
 public:
  /// Throws std::runtime_error as RawlogReader does.
  explicit CameraStream(const std::filesystem::path& rawlog);

  /// Nothing at the end.
  std::optional<CameraObservation> next();

  /// Notes an image that turned out to be unusable.
  void reject(const std::string& label, double time, const std::string& reason);

  const ProblemReport& problems() const { return problems_; }

  /// Share of the log read, [0, 1].
  double progress() const { return reader_.progress(); }

 private:
  bool readEntry();

  std::filesystem::path rawlog_;
  RawlogReader reader_;
  std::deque<mrpt::obs::CObservation::Ptr> waiting_;
  ProblemReport problems_;
};

}  // namespace vmcl
