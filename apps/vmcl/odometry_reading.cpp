// SPDX-License-Identifier: BSD-3-Clause
#include "odometry_reading.h"

#include <mrpt/obs/CObservationOdometry.h>

#include <stdexcept>

#include "vmcl/datasets/rawlog_reader.h"
#include "vmcl/mrpt/pose_conversion.h"

namespace vmcl {
namespace {

void addReading(const mrpt::obs::CObservation& observation, std::vector<StampedPose>& poses) {
  const auto* reading = dynamic_cast<const mrpt::obs::CObservationOdometry*>(&observation);
  if (reading == nullptr || reading->timestamp == INVALID_TIMESTAMP) return;
  const double time = mrpt::Clock::toDouble(reading->timestamp);
  const PlanarPose pose{reading->odometry.x(), reading->odometry.y(), reading->odometry.phi()};
  if (isFinite(pose) && (poses.empty() || time > poses.back().time)) poses.push_back({time, toRigid3(pose)});
}

}  // namespace

Trajectory readOdometry(const std::filesystem::path& rawlog) {
  std::vector<StampedPose> poses;
  RawlogReader reader(rawlog);
  try {
    for (RawlogEntry entry; reader.next(entry); entry = {}) {
      if (entry.observation) addReading(*entry.observation, poses);
      if (!entry.frame) continue;
      for (const auto& observation : *entry.frame) addReading(*observation, poses);
    }
  } catch (const std::runtime_error&) {  // cut off: whoever reads the images says so
  }
  if (poses.empty()) throw std::runtime_error(rawlog.string() + ": no odometry readings (CObservationOdometry)");
  return Trajectory(std::move(poses));
}

}  // namespace vmcl
