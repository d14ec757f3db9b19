// SPDX-License-Identifier: BSD-3-Clause
#include "ini_changes.h"

#include <mrpt/system/string_utils.h>

#include <stdexcept>
#include <vector>

namespace vmcl {

using mrpt::config::CConfigFileMemory;
using mrpt::system::lowerCase;

namespace {

/// Of our own sections unknown keys are refused anyway.
bool isOwnSection(const std::string& section) {
  return section == "vmcl" || section == "amcl" || section.starts_with("MetricMap_visualKeyframes_");
}

}  // namespace

void changeValue(CConfigFileMemory& ini, const std::string& change) {
  const auto equals = change.find('='), dot = change.find('.');
  if (equals == std::string::npos || dot >= equals)
    throw std::invalid_argument("change '" + change + "' is not section.key=value");
  const std::string section = change.substr(0, dot), key = change.substr(dot + 1, equals - dot - 1);
  if (section == "amcl" && !ini.sectionExists(section))
    throw std::invalid_argument("change '" + change + "': there is no [amcl], which would bring in another filter");
  if (!isOwnSection(section) && !ini.keyExists(section, key))
    throw std::invalid_argument("change '" + change + "': [" + section + "] has no " + key);
  ini.write(section, key, change.substr(equals + 1));
}

void keepMapsOf(CConfigFileMemory& ini, Sensors sensors) {
  std::vector<std::string> keys;
  ini.getAllKeys("MetricMap", keys);
  bool camera = false, laser = false;
  for (const std::string& key : keys) {
    if (!lowerCase(key).ends_with("_count") || ini.read_int("MetricMap", key, 0) < 1) continue;
    const bool visual = lowerCase(key) == "visualkeyframes_count";
    (visual ? camera : laser) = true;
    if (sensors == (visual ? Sensors::laser : Sensors::camera)) ini.write("MetricMap", key, 0);
  }
  if (!camera && (sensors == Sensors::camera || sensors == Sensors::both))
    throw std::invalid_argument("[MetricMap] has no map for a camera");
  if (!laser && (sensors == Sensors::laser || sensors == Sensors::both))
    throw std::invalid_argument("[MetricMap] has no map for a laser");
}

}  // namespace vmcl
