// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "drive.h"
#include "light.h"
#include "people.h"
#include "scene_changes.h"
#include "vmcl/geometry/yaml_map.h"

namespace vmcl {

/// Random driving.
struct Exploration {
  double duration = 60;          ///< s
  std::optional<uint64_t> seed;  ///< of the way; none: that of the noise
};

/// One drive through the scene: the way, one of waypoints, exploration and recorded trajectory; and what is different
/// from other drives.
struct Session {
  std::optional<PlanarPose> start;
  std::vector<Waypoint> waypoints;
  std::optional<Exploration> exploration;
  std::filesystem::path trajectory;  ///< a TUM file
  Light light;
  double exposure = 1;  ///< of the cameras: how much brighter than the light makes it
  SceneChanges changes;
  std::vector<Person> people;
};

/// Reads one of `sessions`. Throws std::runtime_error naming file, line and key.
Session readSession(YamlMap yaml);

/// The way of a session, from `start_time` (s) on, at most `duration` seconds, 100 poses a second or those of the
/// file. Throws std::runtime_error: a way into an obstacle, a file that cannot be read, no room to explore.
Trajectory drive(const Session& session, const RobotModel& robot, const Scene& scene, double start_time,
                 double duration, uint64_t seed);

}  // namespace vmcl
