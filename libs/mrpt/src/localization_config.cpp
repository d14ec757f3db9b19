// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/localization_config.h"

#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/maps/TMetricMapTypesRegistry.h>
#include <mrpt/system/string_utils.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "amcl_ini.h"
#include "ini_changes.h"
#include "vmcl/mrpt/error_message.h"
#include "vmcl/mrpt/ini_section.h"
#include "vmcl/mrpt/kld_sample_size.h"

namespace vmcl {
namespace {

namespace fs = std::filesystem;
using mrpt::config::CConfigFileMemory;
using mrpt::system::lowerCase;

constexpr const char* first_visual_map = "MetricMap_visualKeyframes_00_creationOpts";

CConfigFileMemory readIni(const fs::path& file) {
  constexpr std::uintmax_t max_bytes = 16 << 20;
  std::ifstream in(file, std::ios::binary);
  std::error_code error;
  const bool regular = fs::is_regular_file(file, error);  // reading a device may never end
  const auto bytes = regular ? fs::file_size(file, error) : 0;
  if (!in || !regular || error) throw std::runtime_error("cannot be opened");
  if (bytes > max_bytes) throw std::runtime_error("is no ini: larger than 16 MiB");
  CConfigFileMemory ini;
  ini.setContent(std::string(std::istreambuf_iterator<char>(in), {}));
  if (!ini.sectionExists("LocalizationExperiment")) throw std::runtime_error("has no section [LocalizationExperiment]");
  return ini;
}

/// MRPT's own sections read nan and inf as numbers like any other.
void refuseNonFiniteValues(const CConfigFileMemory& ini) {
  std::vector<std::string> sections, keys;
  ini.getAllSections(sections);
  for (const std::string& section : sections) {
    ini.getAllKeys(section, keys);
    for (const std::string& key : keys) {
      const std::string word = ini.read_string(section, key, "");
      char* end = nullptr;
      const double number = std::strtod(word.c_str(), &end);
      if (end != word.c_str() && *end == '\0' && !std::isfinite(number))
        throw std::invalid_argument("[" + section + "] " + key + ": '" + word + "' is not a finite number");
    }
  }
}

void refuseUnknownMaps(const CConfigFileMemory& ini) {
  std::vector<std::string> keys;
  ini.getAllKeys("MetricMap", keys);
  const auto& known = mrpt::maps::internal::TMetricMapTypesRegistry::Instance().getAllRegistered();
  for (const std::string& key : keys) {
    if (!lowerCase(key).ends_with("_count")) continue;
    const std::string map = key.substr(0, key.size() - std::string_view("_count").size());
    if (std::none_of(known.begin(), known.end(), [&](const auto& k) { return lowerCase(k.first) == lowerCase(map); }))
      throw std::invalid_argument("[MetricMap] " + key + ": there is no map called '" + map + "'");
    int count = 0;
    IniSection section(ini, "MetricMap");
    section.read(key, count);
    if (count < 0 || count > 99) section.fail(key, std::to_string(count) + " is not in [0, 99]");
  }
}

/// The path as given, or as seen from the directory of the ini if only there is such a file.
fs::path locate(const fs::path& path, const fs::path& ini) {
  if (path.empty() || path.is_absolute() || fs::exists(path)) return path;
  const fs::path beside_ini = ini.parent_path() / path;
  return fs::exists(beside_ini) ? beside_ini : path;
}

bool isVisualMap(const fs::path& file) { return file.extension() == ".vmap"; }

/// Leaves out map files for maps that the chosen sensors do without.
void dropIdleMapFiles(const CConfigFileMemory& ini, Sensors sensors, std::vector<fs::path>& map_files) {
  if (ini.read_int("MetricMap", "visualKeyframes_count", 0) < 1) std::erase_if(map_files, isVisualMap);
  if (sensors == Sensors::camera && std::any_of(map_files.begin(), map_files.end(), isVisualMap))
    std::erase_if(map_files, std::not_fn(isVisualMap));
}

/// Brings all map files to where their maps look for them.
void placeMapFiles(CConfigFileMemory& ini, const fs::path& ini_file, std::vector<fs::path> map_files,
                   LocalizationConfig& config) {
  std::string in_ini;
  IniSection(ini, "LocalizationExperiment").read("map_file", in_ini);
  const auto of_kind = [](bool visual) {
    return [visual](const fs::path& file) { return isVisualMap(file) == visual; };
  };
  if (!in_ini.empty() && std::none_of(map_files.begin(), map_files.end(), of_kind(isVisualMap(in_ini))))
    map_files.push_back(locate(in_ini, ini_file));
  std::vector<std::string> sections;
  ini.getAllSections(sections);
  for (const std::string& section : sections)
    if (const std::string file = ini.read_string(section, "map_file", "");
        !file.empty() && section.ends_with("_creationOpts"))
      ini.write(section, "map_file", locate(file, ini_file).string());
  for (const std::string& section : sections)
    if (const std::string file = ini.read_string(section, "dense_network", "");
        !file.empty() && section.ends_with("_likelihoodOpts"))
      ini.write(section, "dense_network", locate(file, ini_file).string());
  for (const bool visual : {false, true})
    if (std::count_if(map_files.begin(), map_files.end(), of_kind(visual)) > 1)
      throw std::invalid_argument(std::string("two map files for the one ") + (visual ? "visual map" : "laser's map"));
  for (const fs::path& file : map_files) {
    if (!isVisualMap(file)) {
      config.map_file = file;
    } else {
      if (ini.read_int("MetricMap", "visualKeyframes_count", 0) < 1)
        throw std::invalid_argument(file.string() + " needs [MetricMap] visualKeyframes_count = 1");
      ini.write(first_visual_map, "map_file", file.string());
    }
  }
}

int firstCount(IniSection& section, const std::string& key) {
  std::string counts;
  section.read(key, counts);
  std::istringstream words(counts);
  int first = 0;
  if (!(words >> first) || !(words.eof() || std::isspace(words.peek())))
    section.fail(key, "'" + counts + "' is not a number of particles");
  if (first < 1 || first > KldSampleSize::most_particles)
    section.fail(key, std::to_string(first) + " is not in [1, " + std::to_string(KldSampleSize::most_particles) + "]");
  return first;
}

void readExperiment(const CConfigFileMemory& ini, const fs::path& ini_file, LocalizationConfig& config) {
  IniSection section(ini, "LocalizationExperiment");
  bool in_space = false;
  section.read("use_3D_poses", in_space);
  if (in_space) section.fail("use_3D_poses", "only planar poses are supported");
  std::string rawlog;
  section.read("rawlog_file", rawlog);
  if (config.rawlog_file.empty()) config.rawlog_file = locate(rawlog, ini_file);
  if (config.rawlog_file.empty()) section.fail("rawlog_file", "no rawlog is given");
  section.read("rawlog_offset", config.rawlog_offset);
  if (config.rawlog_offset < 0) section.fail("rawlog_offset", "is negative");
  if (!hasAmclSection(ini) || section.has("particles_count"))
    config.particles_count = firstCount(section, "particles_count");
}

void readStart(const CConfigFileMemory& ini, LocalizationConfig& config) {
  IniSection section(ini, "LocalizationExperiment");
  if (!section.has("init_PDF_mode")) {
    if (!hasAmclSection(ini))
      section.fail("init_PDF_mode",
                   "is missing: 0 starts anywhere free in the grid map, 1 in the box init_PDF_min_x ...");
    config.start_anywhere = true;
    return;
  }
  bool anywhere_in_box = false;
  section.read("init_PDF_mode", anywhere_in_box);
  config.start_in_free_space = !anywhere_in_box;
  PoseBox& box = config.start;
  double min_yaw_deg = -180, max_yaw_deg = 180;
  section.read("init_PDF_min_x", box.min_x);
  section.read("init_PDF_max_x", box.max_x);
  section.read("init_PDF_min_y", box.min_y);
  section.read("init_PDF_max_y", box.max_y);
  section.read("init_PDF_min_yaw_deg", min_yaw_deg);
  section.read("init_PDF_max_yaw_deg", max_yaw_deg);
  box.min_phi = mrpt::DEG2RAD(min_yaw_deg);
  box.max_phi = mrpt::DEG2RAD(max_yaw_deg);
  try {
    box.check();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string("[LocalizationExperiment] init_PDF: ") + error.what());
  }
}

void readMotionModel(const CConfigFileMemory& ini, LocalizationConfig& config) {
  IniSection section(ini, "DummyOdometryParams");
  double min_std_position = 0.04, min_std_heading_deg = 2;  // stock's own defaults
  section.read("minStdXY", min_std_position);
  section.read("minStdPHI", min_std_heading_deg);
  if (min_std_position < 0) section.fail("minStdXY", "is negative");
  if (min_std_heading_deg < 0) section.fail("minStdPHI", "is negative");
  config.motion_model.modelSelection = mrpt::obs::CActionRobotMovement2D::mmGaussian;
  config.motion_model.gaussianModel.minStdXY = min_std_position;
  config.motion_model.gaussianModel.minStdPHI = mrpt::DEG2RAD(min_std_heading_deg);
}

void checkSupported(const PlanarMonteCarlo::ParticleFilterOptions& options) {
  try {
    PlanarMonteCarlo::check(options);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string("[PF_options] ") + error.what());
  }
}

void readFilter(const CConfigFileMemory& ini, LocalizationConfig& config) {
  config.kld.loadFromConfigFile(ini, "KLD_options");
  try {
    KldSampleSize{config.kld};
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string("[KLD_options] ") + error.what());
  }
  config.filter.PF_algorithm = ini.read_enum("PF_options", "PF_algorithm", config.filter.PF_algorithm);
  checkSupported(config.filter);  // at once, because MRPT asks for more keys with another algorithm
  config.filter.loadFromConfigFile(ini, "PF_options");
  checkSupported(config.filter);
}

void readOwnSection(const CConfigFileMemory& ini, LocalizationConfig& config) {
  IniSection section(ini, "vmcl");
  section.read("recovery_alpha_slow", config.monte_carlo.recovery_alpha_slow);
  section.read("recovery_alpha_fast", config.monte_carlo.recovery_alpha_fast);
  section.read("injection_share", config.monte_carlo.injection_share);
  section.read("slip_probability", config.monte_carlo.slip_probability);
  section.read("kidnapping_probability", config.monte_carlo.kidnapping_probability);
  section.read("aliasing_probability", config.monte_carlo.aliasing_probability);
  section.read("guided_updates", config.guided_updates);
  section.read("update_min_d", config.update_min_d);
  section.read("update_min_a", config.update_min_a);
  section.read("degraded_after", config.health.degraded_after);
  section.read("lost_after", config.health.lost_after);
  section.read("lost_reset_after", config.health.lost_reset_after);
  section.read("max_position_deviation", config.localized.max_position_deviation);
  double max_heading_deviation_deg = mrpt::RAD2DEG(config.localized.max_heading_deviation);
  section.read("max_heading_deviation_deg", max_heading_deviation_deg);
  config.localized.max_heading_deviation = mrpt::DEG2RAD(max_heading_deviation_deg);
  section.read("min_share", config.localized.min_share);
  section.read("min_frames", config.localized.min_frames);
  section.refuseUnknownKeys();
  try {
    config.check();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string("[vmcl] ") + error.what());
  }
}

}  // namespace

LocalizationConfig loadLocalizationConfig(const fs::path& ini_file, const std::vector<fs::path>& map_files,
                                          const fs::path& rawlog_file, const IniChanges& changes) try {
  CConfigFileMemory ini = readIni(ini_file);
  for (const std::string& change : changes.values) changeValue(ini, change);
  LocalizationConfig config;
  config.ini_file = ini_file;
  config.rawlog_file = rawlog_file;
  refuseNonFiniteValues(ini);
  if (hasAmclSection(ini)) {
    readAmclSection(ini, config);
  } else {
    readMotionModel(ini, config);
    readFilter(ini, config);
  }
  readExperiment(ini, ini_file, config);
  readStart(ini, config);
  readOwnSection(ini, config);
  refuseUnknownMaps(ini);
  std::vector<fs::path> used_map_files = map_files;
  if (changes.sensors) {
    keepMapsOf(ini, *changes.sensors);
    dropIdleMapFiles(ini, *changes.sensors, used_map_files);
    config.odometry_only = changes.sensors == Sensors::odometry;
  }
  placeMapFiles(ini, ini_file, used_map_files, config);
  config.maps.loadFromConfigFile(ini, "MetricMap");
  if (config.maps.size() == 0) throw std::invalid_argument("[MetricMap] asks for no map");
  return config;
} catch (const std::exception& error) {
  throw std::runtime_error(ini_file.string() + ": " + errorMessage(error));
}

}  // namespace vmcl
