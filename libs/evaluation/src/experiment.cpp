// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/evaluation/experiment.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>

#include "vmcl/geometry/yaml_map.h"

namespace vmcl {
namespace {

namespace fs = std::filesystem;

constexpr int max_seeds = 100'000;

Disturbance readDisturbance(YamlMap& session, const std::string& key) {
  YamlMap yaml = session.map(key);
  Disturbance disturbance;
  disturbance.dropped_images = yaml.get<double>("drop_images", disturbance.dropped_images);
  disturbance.odometry_scale = yaml.get<double>("odometry_scale", disturbance.odometry_scale);
  if (yaml.has("dim")) {
    YamlMap dim = yaml.map("dim");
    disturbance.dimming = {dim.get<double>("at"), dim.get<double>("for"), dim.get<double>("light")};
    dim.finish();
  }
  yaml.finish();
  try {
    disturbance.check();
  } catch (const std::invalid_argument& error) {
    session.fail(key, std::string("has ") + error.what());
  }
  return disturbance;
}

/// Reads parts of the file; knows where relative paths start.
class Reader {
 public:
  explicit Reader(fs::path directory) : directory_(std::move(directory)) {}

  ExperimentSession session(YamlMap yaml) const {
    ExperimentSession session;
    session.rawlog = existing(yaml, "rawlog", yaml.get<std::string>("rawlog"));
    session.name = name(yaml, session.rawlog);
    for (const std::string& map : yaml.texts("maps")) session.maps.push_back(existing(yaml, "maps", map));
    session.ground_truth = existing(yaml, "ground_truth", yaml.get<std::string>("ground_truth"));
    if (yaml.has("openloris")) {
      YamlMap openloris = yaml.map("openloris");
      session.openloris = {openloris.get<std::string>("scene"), openloris.get<int>("sequence")};
      openloris.finish();
    }
    if (yaml.has("disturbance")) session.disturbance = readDisturbance(yaml, "disturbance");
    yaml.finish();
    return session;
  }

  Configuration configuration(YamlMap yaml) const {
    Configuration configuration;
    configuration.ini = existing(yaml, "ini", yaml.get<std::string>("ini"));
    configuration.name = name(yaml, configuration.ini);
    if (yaml.has("changes")) {
      YamlMap sections = yaml.map("changes");
      for (const std::string& section : sections.keys()) {
        YamlMap values = sections.map(section);
        for (const std::string& key : values.keys())
          configuration.changes.push_back(section + '.' + key + '=' + values.get<std::string>(key));
      }
    }
    yaml.finish();
    return configuration;
  }

 private:
  fs::path existing(const YamlMap& yaml, const std::string& key, const fs::path& path) const {
    std::error_code error;
    for (const fs::path& candidate : {path, directory_ / path})
      if (fs::is_regular_file(candidate, error)) return fs::absolute(candidate).lexically_normal();
    yaml.fail(key, "names no file: " + path.string());
  }

  /// As given, or that of the file. It becomes a part of file names.
  static std::string name(YamlMap& yaml, const fs::path& file) {
    const std::string name = yaml.get<std::string>("name", file.stem().string());
    const auto allowed = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
    if (name.empty() || !std::all_of(name.begin(), name.end(), allowed))
      yaml.fail("name", "is to be made of letters, digits, _ and -, unlike '" + name + "'");
    return name;
  }

  fs::path directory_;
};

template <class Named>
void refuseEqualNames(const YamlMap& yaml, const std::string& key, const std::vector<Named>& all) {
  if (all.empty()) yaml.fail(key, "is missing or empty");
  std::set<std::string> names;
  for (const Named& named : all)
    if (!names.insert(named.name).second) yaml.fail(key, "has two of the name '" + named.name + "'");
}

std::vector<Sensors> readSensors(YamlMap& yaml) {
  std::vector<Sensors> all;
  for (const std::string& name : yaml.texts("sensors")) {
    const auto known = std::find_if(sensors_by_name.begin(), sensors_by_name.end(),
                                    [&](const auto& sensors) { return sensors.first == name; });
    if (known == sensors_by_name.end())
      yaml.fail("sensors", "knows camera, laser, both and odometry, not '" + name + "'");
    if (std::find(all.begin(), all.end(), known->second) != all.end()) yaml.fail("sensors", "has " + name + " twice");
    all.push_back(known->second);
  }
  if (all.empty()) yaml.fail("sensors", "is missing or empty");
  return all;
}

std::string nameOfStart(const std::string& kind, double after) {
  std::ostringstream name;
  name << kind;
  if (after > 0) name << "-after-" << after << 's';
  return name.str();
}

Start kidnappedStart(YamlMap yaml) {
  const Kidnapping kidnapping{yaml.get<double>("at"), yaml.get<double>("skip")};
  const double after = yaml.get<double>("start", 0);
  if (!(kidnapping.at > 0)) yaml.fail("at", "is not positive");
  if (!(kidnapping.skip > 0)) yaml.fail("skip", "is not positive");
  if (!(after >= 0 && after < kidnapping.at)) yaml.fail("start", "is not before the kidnapping");
  yaml.finish();
  std::ostringstream kind;
  kind << "kidnapped-at-" << kidnapping.at << "s-for-" << kidnapping.skip << 's';
  return {nameOfStart(kind.str(), after), true, kidnapping, after};
}

std::vector<Start> readStarts(YamlMap& yaml) {
  std::vector<Start> starts;
  const auto times = yaml.get<std::vector<double>>("start_times", {0});
  for (const double time : times)
    if (!(time >= 0 && std::isfinite(time))) yaml.fail("start_times", "are not all finite and at least 0");
  if (yaml.has("starts"))
    for (const std::string& kind : yaml.texts("starts")) {
      if (kind != "given" && kind != "global") yaml.fail("starts", "knows given and global, not '" + kind + "'");
      for (const double time : times) starts.push_back({nameOfStart(kind, time), kind == "given", std::nullopt, time});
    }
  for (const YamlMap& kidnapping : yaml.list("kidnappings")) starts.push_back(kidnappedStart(kidnapping));
  refuseEqualNames(yaml, "starts", starts);
  return starts;
}

}  // namespace

Experiment readExperiment(const fs::path& file) {
  YamlMap yaml = YamlMap::read(file);
  const Reader reader(fs::absolute(file).parent_path());
  Experiment experiment;
  experiment.file = file;
  for (const YamlMap& session : yaml.list("rawlogs")) experiment.sessions.push_back(reader.session(session));
  refuseEqualNames(yaml, "rawlogs", experiment.sessions);
  experiment.sensors = readSensors(yaml);
  for (const YamlMap& ini : yaml.list("configurations")) experiment.configurations.push_back(reader.configuration(ini));
  refuseEqualNames(yaml, "configurations", experiment.configurations);
  experiment.starts = readStarts(yaml);
  experiment.seeds = yaml.get<int>("seeds");
  if (experiment.seeds < 1 || experiment.seeds > max_seeds)
    yaml.fail("seeds", "is not in [1, " + std::to_string(max_seeds) + "]");
  experiment.keep_matches = yaml.get<bool>("keep_matches", false);
  yaml.finish();
  return experiment;
}

}  // namespace vmcl
