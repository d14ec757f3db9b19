// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/visual_map_options.h"

#include <array>
#include <charconv>
#include <stdexcept>

#include "option_range.h"
#include "vmcl/mrpt/ini_section.h"

namespace vmcl {
namespace {

template <typename Options, typename Visit>
void visitLikelihoodOptions(Options& options, Visit&& visit) {
  auto& relocalizer = options.relocalizer;
  visit("particle_sigma_px", options.particle_sigma_px);
  visit("match_correlation", options.match_correlation);
  visit("max_matches", options.max_matches);
  visit("retrieved", relocalizer.retrieved);
  visit("ranked", relocalizer.ranked);
  visit("reliable_depth", relocalizer.reliable_depth);
  visit("max_point_sigma", relocalizer.max_point_sigma);
  visit("max_ratio", relocalizer.matching.max_ratio);
  visit("sigma_px", relocalizer.estimator.likelihood.sigma_px);
  visit("inlier_prior", relocalizer.estimator.likelihood.inlier_prior);
  visit("sigma_tilt", relocalizer.estimator.plane.sigma_tilt);
  visit("sigma_height", relocalizer.estimator.plane.sigma_height);
  visit("iterations", relocalizer.estimator.iterations);
  visit("max_modes", relocalizer.estimator.max_modes);
}

template <typename Options, typename Visit>
void visitInsertionOptions(Options& options, Visit&& visit) {
  auto& builder = options.builder;
  visit("features", options.features);
  visit("max_features", builder.features.max_features);
  visit("mask_rows_from_top", builder.features.mask_rows_from_top);
  visit("keyframe_distance", builder.keyframe_distance);
  visit("keyframe_rotation", builder.keyframe_rotation);
  visit("sigma_mount_tilt", builder.sigma_mount_tilt);
  visit("words", builder.words);
}

std::string textOf(const std::string& value) { return value; }

template <typename Number>
std::string textOf(Number value) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

}  // namespace

void VisualMapOptions::check() const {
  demandPositive("particle_sigma_px", particle_sigma_px);
  demand(match_correlation >= 0 && match_correlation <= 1, "match_correlation", match_correlation, "in [0, 1]");
  demand(max_matches >= 0, "max_matches", max_matches, "at least 0");
  FeatureOptions().choose(features);
  relocalizer.check();
  builder.check();
}

void VisualMapOptions::read(const mrpt::config::CConfigFileBase& ini, const std::string& prefix) {
  IniSection creation(ini, prefix + "_creationOpts");
  creation.read("map_file", map_file);
  creation.read("image_directory", image_directory);
  creation.read("match_directory", match_directory);
  creation.allow({"enableSaveAs3DObject", "enableObservationLikelihood", "enableObservationInsertion"});
  creation.refuseUnknownKeys();
  IniSection likelihood(ini, prefix + "_likelihoodOpts");
  visitLikelihoodOptions(*this, [&](const char* key, auto& value) { likelihood.read(key, value); });
  std::string setting(nameOf(relocalizer.setting));
  likelihood.read("setting", setting);
  likelihood.read("dense_network", relocalizer.dense_network);
  likelihood.refuseUnknownKeys();
  try {
    relocalizer.setting = matchSettingFromName(setting);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("[" + prefix + "_likelihoodOpts] " + error.what());
  }
  IniSection insertion(ini, prefix + "_insertOpts");
  visitInsertionOptions(*this, [&](const char* key, auto& value) { insertion.read(key, value); });
  insertion.refuseUnknownKeys();
  builder.features.choose(features);
  try {
    check();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("[" + prefix + "_...] " + error.what());
  }
}

void VisualMapOptions::write(mrpt::config::CConfigFileBase& ini, const std::string& prefix) const {
  ini.write(prefix + "_creationOpts", "map_file", map_file);
  ini.write(prefix + "_creationOpts", "image_directory", image_directory);
  ini.write(prefix + "_creationOpts", "match_directory", match_directory);
  visitLikelihoodOptions(
      *this, [&](const char* key, const auto& value) { ini.write(prefix + "_likelihoodOpts", key, textOf(value)); });
  ini.write(prefix + "_likelihoodOpts", "setting", std::string(nameOf(relocalizer.setting)));
  ini.write(prefix + "_likelihoodOpts", "dense_network", relocalizer.dense_network);
  visitInsertionOptions(
      *this, [&](const char* key, const auto& value) { ini.write(prefix + "_insertOpts", key, textOf(value)); });
}

}  // namespace vmcl
