// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>

#include <map>
#include <string>
#include <utility>

namespace vmcl {

/// Finds observations that come twice or out of order: not newer than the last of the same sensor (class and
/// label), by up to 10 s: more is a clock set anew. Observations without a time are always new.
class ObservationOrder {
 public:
  /// Remembers the observation, if it is new.
  bool isNew(const mrpt::obs::CObservation& observation);

 private:
  std::map<std::pair<std::string, std::string>, double> last_;  ///< s
};

}  // namespace vmcl
