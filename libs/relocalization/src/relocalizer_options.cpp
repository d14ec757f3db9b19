// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>
#include <string>

#include "vmcl/relocalization/relocalizer.h"

namespace vmcl {

std::string_view nameOf(MatchSetting setting) {
  return setting == MatchSetting::scsd ? "scsd" : setting == MatchSetting::dcsd ? "dcsd" : "dcdd";
}

MatchSetting matchSettingFromName(std::string_view name) {
  for (const MatchSetting setting : {MatchSetting::scsd, MatchSetting::dcsd, MatchSetting::dcdd})
    if (name == nameOf(setting)) return setting;
  throw std::invalid_argument("setting is \"" + std::string(name) + "\", not scsd, dcsd or dcdd");
}

void RelocalizerOptions::check() const {
  matching.check();
  estimator.check();
  const auto require = [](bool holds, const char* key, double value) {
    if (!holds) throw std::invalid_argument(std::string(key) + " is " + std::to_string(value) + ", not positive");
  };
  if (!dense_network.empty() && setting == MatchSetting::scsd)
    throw std::invalid_argument("dense_network is given, but setting scsd has no dense matches");
  require(retrieved >= 1, "retrieved", retrieved);
  if (ranked < 0) throw std::invalid_argument("ranked is " + std::to_string(ranked) + ", negative");
  require(reliable_depth > 0, "reliable_depth", reliable_depth);
  require(max_point_sigma > 0, "max_point_sigma", max_point_sigma);
}

}  // namespace vmcl
