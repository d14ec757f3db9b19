// SPDX-License-Identifier: BSD-3-Clause
#include "progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>

namespace vmcl {

ProgressBar::ProgressBar() : on_terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressBar::~ProgressBar() {
  if (!shown_.empty()) std::cerr << '\n';
}

void ProgressBar::update(std::string_view stage, double share) {
  if (!on_terminal_) return;
  constexpr int width = 40;
  const int filled = static_cast<int>(std::clamp(share, 0.0, 1.0) * width);
  std::string line(stage);
  line.resize(24, ' ');
  line += '[' + std::string(filled, '#') + std::string(width - filled, ' ') + "] " +
          std::to_string(static_cast<int>(std::clamp(share, 0.0, 1.0) * 100)) + '%';
  if (line == shown_) return;
  std::cerr << '\r' << line << ' ' << std::flush;
  shown_ = std::move(line);
}

}  // namespace vmcl
