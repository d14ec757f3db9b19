// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CSimpleMap.h>

#include <map>
#include <optional>
#include <string>

#include "simulated_sensors.h"
#include "vmcl/geometry/atomic_file.h"

namespace vmcl {

/// The places of a simplemap: the images of all cameras and a scan each, every 0.15 m or 8 deg.
class MapFrames {
 public:
  bool isDue(const std::string& camera, const PlanarPose& map_from_robot) const;
  void add(const PlanarPose& map_from_robot, const CameraShot& shot,
           const std::optional<mrpt::obs::CObservation2DRangeScan>& laser);

  int count() const { return static_cast<int>(map_.size()); }

  /// Throws std::runtime_error when there is no room.
  void save(AtomicFile& file) const;

 private:
  mrpt::maps::CSimpleMap map_;
  std::map<std::string, PlanarPose> last_;  ///< of each camera
};

}  // namespace vmcl
