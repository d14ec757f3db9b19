// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/observation_order.h"

#include <mrpt/core/Clock.h>

namespace vmcl {

bool ObservationOrder::isNew(const mrpt::obs::CObservation& observation) {
  constexpr double clock_set_anew = 10;  // s
  if (observation.timestamp == INVALID_TIMESTAMP) return true;
  const double time = mrpt::Clock::toDouble(observation.timestamp);
  const auto [last, first] =
      last_.try_emplace({observation.GetRuntimeClass()->className, observation.sensorLabel}, time);
  if (!first && time <= last->second && time > last->second - clock_set_anew) return false;
  last->second = time;
  return true;
}

}  // namespace vmcl
