// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <filesystem>
#include <memory>

namespace vmcl {

/// One step of a log: an action with a sensory frame, or a single observation.
struct RawlogEntry {
  mrpt::obs::CActionCollection::Ptr action;
  mrpt::obs::CSensoryFrame::Ptr frame;
  mrpt::obs::CObservation::Ptr observation;
};

/// Streams a rawlog (plain or gzip) from disk. Images kept outside are looked for in `<rawlog>_Images`, as
/// rawlog-edit and RawLogViewer do; their names are turned into whole paths, so that no setting of the process is
/// needed. Classes that are neither action, frame nor observation are skipped.
///
/// Of a log from a stranger, absurd numbers of observations in an entry and endless nesting are refused. But MRPT sizes
/// the arrays inside an observation as the log claims before it reads them: limit the process (ulimit -v) against that.
class RawlogReader {
 public:
  /// Throws std::runtime_error naming the file: missing, or not a rawlog.
  explicit RawlogReader(const std::filesystem::path& file);
  ~RawlogReader();

  /// The next entry; false at the end. Throws std::runtime_error naming file and entry for a log that is cut off or
  /// holds a class that is not known.
  bool next(RawlogEntry& entry);

  /// Share of the file read, [0, 1].
  double progress() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vmcl
