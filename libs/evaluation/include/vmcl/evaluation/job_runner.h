// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <mutex>

#include "vmcl/evaluation/experiment_plan.h"

namespace vmcl {

/// Keeps two programs from filling one directory as if each were alone, by a file in it; ends with the object, or the
/// process. Several that only add single runs may share it; they leave the file, which one alone removes.
class DirectoryLock {
 public:
  enum class Kind { alone, shared };

  /// Creates the directory. Throws std::runtime_error naming it when it cannot be made or is taken.
  DirectoryLock(const std::filesystem::path& directory, Kind kind);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

 private:
  std::filesystem::path file_;
  Kind kind_;
  int descriptor_ = -1;
};

/// Makes the runs of an experiment, each in a process of its own, and keeps each one's results in DIRECTORY/runs/ID:
/// what `vmcl localize` writes and says, job.json (as described), run.json (how it ended) and cost.json (what it cost).
/// A run is made in DIRECTORY/unfinished and moved to its place when it is whole.
class JobRunner {
 public:
  /// `vmcl`: the program.
  JobRunner(const Experiment& experiment, std::filesystem::path directory, std::filesystem::path vmcl)
      : directory_(std::move(directory)), vmcl_(std::move(vmcl)), experiment_(experiment), describer_(experiment) {}

  /// Writes the job list jobs.jsonl, a line a job.
  void writeJobList(const std::vector<Job>& jobs);

  /// Whether its results are there: then it need not be run. One that failed is not done, and may do better. Throws
  /// std::runtime_error when they are of another job of that name, as one with another map.
  bool isDone(const Job& job);

  /// Whether there are any results, or some were begun.
  bool hasResults() const;

  /// Removes what runs have left behind that were killed. Only for one that is alone.
  void removeUnfinished() const;

  /// Makes a run; returns why it failed, which is a result as well, and "" when it did not. Throws std::runtime_error
  /// when nothing can be kept: a full disk, say.
  std::string run(const Job& job);

  /// Makes runs side by side, alone; tells of each that has ended, by number of those. When one throws, no more are
  /// begun.
  void run(const std::vector<Job>& jobs, int workers, const std::function<void(std::size_t)>& on_end);

 private:
  std::string describe(const Job& job);
  std::string matchHashOf(const Job& job);

  std::filesystem::path directory_;
  std::filesystem::path vmcl_;
  const Experiment& experiment_;
  std::mutex describer_mutex_;
  JobDescriber describer_;
};

}  // namespace vmcl
