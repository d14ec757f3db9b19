// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace vmcl {

/// Exit codes of the command.
enum ExitCode : int {
  exit_done = 0,
  exit_some_input_bad = 1,  ///< ran, but some input was bad; each is named on stderr
  exit_failed = 2,          ///< wrong usage, or nothing could be done
};

/// Each adds its verb: options, help with an example, and a callback that does the work and sets the exit code. What
/// the callback throws is printed as one line and ends in exit_failed.
void addBenchVerb(CLI::App& app, int& exit_code);
void addEstimateVerb(CLI::App& app, int& exit_code);
void addEvaluateVerb(CLI::App& app, int& exit_code);
void addImportVerb(CLI::App& app, int& exit_code);
void addLocalizeVerb(CLI::App& app, int& exit_code);
void addMapVerb(CLI::App& app, int& exit_code);
void addRelocalizeVerb(CLI::App& app, int& exit_code);
void addSelectorVerb(CLI::App& app, int& exit_code);
void addSimulateVerb(CLI::App& app, int& exit_code);

}  // namespace vmcl
