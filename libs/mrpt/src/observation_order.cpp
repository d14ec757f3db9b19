// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/observation_order.h"

#include <mrpt/core/Clock.h>
#include <mrpt/poses/CPose3D.h>

namespace vmcl {

bool ObservationOrder::isNew(const mrpt::obs::CObservation& observation) {
  constexpr double clock_set_anew = 10;  // s
  if (observation.timestamp == INVALID_TIMESTAMP) return true;
  const double time = mrpt::Clock::toDouble(observation.timestamp);
  mrpt::poses::CPose3D mount;
  observation.getSensorPose(mount);
  const auto [last, first] =
      last_.try_emplace({observation.GetRuntimeClass()->className, observation.sensorLabel, mount.asString()}, time);
  if (!first && time <= last->second && time > last->second - clock_set_anew) return false;
  last->second = time;
  return true;
}

}  // namespace vmcl
