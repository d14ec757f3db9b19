// SPDX-License-Identifier: BSD-3-Clause
#include "replay.h"

#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "coverage.h"
#include "progress_bar.h"
#include "vmcl/datasets/rawlog_reader.h"
#include "vmcl/mrpt/error_message.h"

namespace vmcl {
namespace {

std::optional<double> timeOf(const RawlogEntry& entry) {
  const auto observation = entry.frame && entry.frame->size() > 0 ? *entry.frame->begin() : entry.observation;
  if (!observation || observation->timestamp == INVALID_TIMESTAMP) return std::nullopt;
  return mrpt::Clock::toDouble(observation->timestamp);
}

/// Says which steps of a log are left out, and tells the localizer of the kidnapping.
class Gaps {
 public:
  explicit Gaps(const Replay& replay) : replay_(replay) {}

  bool contain(const RawlogEntry& entry, Localizer& localizer) {
    const auto time = timeOf(entry);
    if (!time) return false;
    if (std::isnan(first_)) first_ = *time;
    if (replay_.kidnapping && !kidnapped_) {
      const double from = first_ + replay_.kidnapping->at;
      kidnapped_ = Kidnapped{from, from + replay_.kidnapping->skip};
    }
    if (*time < first_ + replay_.skipped || *time < replay_.begin) return true;
    if (!kidnapped_ || *time < kidnapped_->from || *time >= kidnapped_->until) return false;
    localizer.kidnap();
    return true;
  }

  const std::optional<Kidnapped>& kidnapped() const { return kidnapped_; }

 private:
  const Replay& replay_;
  double first_ = std::numeric_limits<double>::quiet_NaN();  ///< time of the log's first step
  std::optional<Kidnapped> kidnapped_;
};

}  // namespace

ProblemReport replay(const Replay& replay, Localizer& localizer, LocalizationRun& run) {
  ProblemReport problems;
  RawlogReader reader(replay.rawlog);
  ProgressBar bar;
  RawlogEntry entry;
  Gaps gaps(replay);
  DisturbedDrive disturbed(replay.disturbance, replay.seed);
  try {
    while (reader.next(entry)) {
      bar.update("localizing", reader.progress());
      const bool left_out = gaps.contain(entry, localizer);  // first, as a disturbed frame may have lost its time
      if (!disturbed.disturb(entry.action.get(), entry.frame.get(), entry.observation.get()) || left_out) continue;
      if (const auto frame = localizer.step(entry.action, entry.frame, entry.observation)) run.frames.push_back(*frame);
      for (const std::string& problem : localizer.takeProblems()) problems.add(replay.rawlog.string() + ": " + problem);
    }
  } catch (const std::runtime_error& error) {
    if (run.frames.empty()) throw;
    problems.add(errorMessage(error));
  }
  run.kidnapped = gaps.kidnapped();
  if (run.kidnapped && !run.frames.empty() && run.frames.back().time < run.kidnapped->until)
    throw std::runtime_error(replay.rawlog.string() + ": ends before the kidnapped robot is seen again");
  return problems;
}

double firstCoveredTime(const std::filesystem::path& rawlog, const Trajectory& ground_truth, double skipped) {
  RawlogReader reader(rawlog);
  RawlogEntry entry;
  std::optional<double> begin, first, last;
  while (reader.next(entry)) {
    const auto time = timeOf(entry);
    if (!time) continue;
    if (!begin) begin = *time + skipped;
    if (*time < *begin || std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(entry.observation)) continue;
    if (ground_truth.at(*time)) return *time;
    if (!first) first = time;
    last = time;
  }
  if (!first && begin && skipped > 0)
    throw std::runtime_error(rawlog.string() + ": ends before the " + std::to_string(skipped) + " s to leave out");
  throw std::runtime_error(rawlog.string() + ": " +
                           (first ? coversNothing(ground_truth, *first, *last) : "holds no observation with a time"));
}

}  // namespace vmcl
