// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace vmcl {

/// A bar on stderr for long work: drawn on a terminal only, silent in a pipe.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();  ///< ends the line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Shows the stage and the share done, [0, 1]. Redraws only when the picture changes.
  void update(std::string_view stage, double share);

 private:
  bool on_terminal_;
  std::string shown_;
};

}  // namespace vmcl
