// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "vmcl/evaluation/experiment.h"

namespace vmcl {

/// A sensor set with a configuration: what is compared with others.
struct Method {
  Sensors sensors = Sensors::both;
  std::size_t configuration = 0;  ///< of Experiment::configurations

  bool operator==(const Method&) const = default;
};

/// One run. ExperimentSession, start and configuration are indices into the experiment.
struct Job {
  std::string id;  ///< SESSION.SENSORS.CONFIGURATION.START.SEED: the same whatever else the experiment holds
  std::size_t session = 0;
  Method method;
  std::size_t start = 0;
  uint64_t seed = 1;
};

/// A combination that makes no sense, and why.
struct SkippedCombination {
  std::string name;  ///< SESSION.SENSORS.CONFIGURATION.START
  std::string reason;
};

struct ExperimentPlan {
  std::vector<Job> jobs;
  std::vector<SkippedCombination> skipped;
};

/// All runs of the experiment. Throws std::runtime_error naming the ini or ground truth that is bad, or the experiment
/// when none of its combinations makes sense.
ExperimentPlan planExperiment(const Experiment& experiment);

/// The arguments of `vmcl` that make the run, but for --out.
std::vector<std::string> commandOf(const Experiment& experiment, const Job& job);

/// Those of `vmcl localize` that make it; none where nothing is disturbed.
std::vector<std::string> optionsOf(const Disturbance& disturbance);

/// "camera", with the configuration's name if there are several.
std::string nameOf(const Experiment& experiment, const Method& method);

/// Describes jobs in JSON, each with a hash of all that decides on its result: settings and contents of files (but of
/// images outside a log). Reads each file once.
class JobDescriber {
 public:
  explicit JobDescriber(const Experiment& experiment) : experiment_(experiment) {}

  /// One line: {"id", "rawlog", "sensors", "configuration", "start", "seed", "hash", "command": [...]}. Throws
  /// std::runtime_error naming a file that cannot be read.
  std::string describe(const Job& job);

  /// Eight hexadecimal digits.
  std::string hashOf(const Job& job);

  /// The same for all jobs that may share kept matches: of the same log and maps. What they are matched with otherwise
  /// tells the matches in one directory apart.
  std::string matchHashOf(const Job& job);

 private:
  uint32_t checksum(const std::filesystem::path& file);
  std::string textOfSession(const Job& job);

  const Experiment& experiment_;
  std::vector<std::pair<std::filesystem::path, uint32_t>> checksums_;
};

}  // namespace vmcl
