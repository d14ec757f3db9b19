// SPDX-License-Identifier: BSD-3-Clause
#include "coverage.h"

#include <iomanip>
#include <sstream>

namespace vmcl {

std::string coversNothing(const Trajectory& ground_truth, double first, double last) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << "the ground truth ";
  if (ground_truth.empty())
    text << "is empty";
  else
    text << "goes from " << ground_truth.poses().front().time << " to " << ground_truth.poses().back().time << " s";
  text << " and covers nothing of the log from " << first << " to " << last << " s";
  return text.str();
}

}  // namespace vmcl
