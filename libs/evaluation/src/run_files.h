// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "child_process.h"
#include "vmcl/evaluation/experiment_plan.h"
#include "vmcl/evaluation/run_measures.h"

namespace vmcl {

/// How a run ended.
struct RunEnd {
  bool there = false;                 ///< it has ended
  bool done = false;                  ///< with a result
  std::string reason;                 ///< unless done
  std::vector<std::string> problems;  ///< with its input, though done
};

/// What a run cost.
struct RunCost {
  double seconds = 0;
  double processor_seconds = 0;
  double peak_memory = 0;         ///< bytes
  std::vector<double> latencies;  ///< of each update, s
};

std::filesystem::path runDirectory(const std::filesystem::path& directory, const Job& job);

/// Writes run.json and cost.json, and last job.json.
void writeRunEnd(const std::filesystem::path& run, const ProcessEnd& end, const std::string& job_description);

/// All of these throw std::runtime_error naming the file that is broken; what is not there is nothing.
RunEnd readRunEnd(const std::filesystem::path& run);
std::optional<std::string> readJobHash(const std::filesystem::path& run);
RunCost readRunCost(const std::filesystem::path& run);
std::vector<RunUpdate> readUpdates(const std::filesystem::path& run);
std::optional<Kidnapped> readKidnapped(const std::filesystem::path& run);

}  // namespace vmcl
