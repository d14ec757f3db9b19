// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace vmcl {

/// How a program ended, and what it cost.
struct ProcessEnd {
  int exit_code = 0;  ///< of no meaning when a signal ended it
  int signal = 0;
  double seconds = 0;            ///< of real time
  double processor_seconds = 0;  ///< of all its threads
  int64_t peak_memory = 0;       ///< most resident memory of one process, bytes; what the caller has counts as well
};

/// Runs a program to its end, its stdout and stderr into files, its stdin empty. It does not outlive the calling
/// thread, not even when that is killed. Throws std::runtime_error when it cannot be started.
ProcessEnd runProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                      const std::filesystem::path& out, const std::filesystem::path& errors);

}  // namespace vmcl
