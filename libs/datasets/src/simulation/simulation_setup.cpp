// SPDX-License-Identifier: BSD-3-Clause
#include "simulation_setup.h"

#include "scene_reader.h"

namespace vmcl {
namespace {

/// All sessions are read, so that each is known to be right.
Session chooseSession(YamlMap yaml, const std::string& wanted, const Scene& scene) {
  const auto names = yaml.keys();
  const std::string chosen = wanted.empty() && names.size() == 1 ? names.front() : wanted;
  std::string all;
  std::optional<Session> session;
  for (const std::string& name : names) {
    Session read = readSession(yaml.map(name));
    try {
      Scene changed = scene;
      applyChanges(changed, read.changes);
    } catch (const std::invalid_argument& error) {
      yaml.fail(name, std::string("changes what it cannot: ") + error.what());
    }
    all += (all.empty() ? "" : ", ") + name;
    if (name == chosen) session = std::move(read);
  }
  if (!session && chosen.empty()) yaml.fail("NAME", "is to be chosen by --session from: " + all);
  if (!session) yaml.fail(chosen, "is missing; there are: " + all);
  return *session;
}

}  // namespace

SimulationSetup readSimulationSetup(const std::filesystem::path& file, const std::string& session,
                                    const std::vector<std::filesystem::path>& include_directories) {
  YamlMap yaml = YamlMap::read(file);
  SimulationSetup setup;
  setup.texture_seed = yaml.get<uint64_t>("texture_seed", 1);
  setup.scene = readScene(yaml, include_directories);
  setup.robot = readRobotSetup(yaml);
  if (yaml.has("sessions")) {
    setup.session = chooseSession(yaml.map("sessions"), session, setup.scene);
  } else if (session.empty()) {
    setup.session.exploration.emplace();
  } else {
    yaml.fail("sessions", "are missing");
  }
  yaml.finish();
  applyChanges(setup.scene, setup.session.changes);
  return setup;
}

}  // namespace vmcl
