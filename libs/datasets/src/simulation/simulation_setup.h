// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "scene.h"
#include "sensor_setup.h"
#include "session.h"

namespace vmcl {

/// All of a scene file, with one of its sessions and as it is in that session.
struct SimulationSetup {
  uint64_t texture_seed = 1;
  Scene scene;
  RobotSetup robot;
  Session session;
};

/// A file with one session needs no name of it; one without any is explored for a minute. Throws std::runtime_error
/// naming file, line and key, or the sessions there are if this one is not among them.
SimulationSetup readSimulationSetup(const std::filesystem::path& file, const std::string& session,
                                    const std::vector<std::filesystem::path>& include_directories = {});

}  // namespace vmcl
