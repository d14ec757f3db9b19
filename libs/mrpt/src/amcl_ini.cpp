// SPDX-License-Identifier: BSD-3-Clause
#include "amcl_ini.h"

#include <stdexcept>
#include <string>

#include "vmcl/mrpt/ini_section.h"
#include "vmcl/mrpt/kld_sample_size.h"

namespace vmcl {
namespace {

constexpr const char* amcl_section = "amcl";

void readMotionModel(IniSection& section, OdometryMotionModel& model) {
  using Drive = OdometryMotionModel::Drive;
  std::string type = "differential";
  section.read("robot_model_type", type);
  if (type == "differential" || type == "nav2_amcl::DifferentialMotionModel")
    model.drive = Drive::differential;
  else if (type == "omnidirectional" || type == "nav2_amcl::OmniMotionModel")
    model.drive = Drive::omnidirectional;
  else
    section.fail("robot_model_type", "'" + type + "' is neither differential nor omnidirectional");
  section.read("alpha1", model.alpha1);
  section.read("alpha2", model.alpha2);
  section.read("alpha3", model.alpha3);
  section.read("alpha4", model.alpha4);
  section.read("alpha5", model.alpha5);
}

void readSampleSize(IniSection& section, LocalizationConfig& config) {
  int least = static_cast<int>(config.kld.KLD_minSampleSize), most = static_cast<int>(config.kld.KLD_maxSampleSize);
  double certainty = 1 - config.kld.KLD_delta;
  section.read("min_particles", least);
  section.read("max_particles", most);
  section.read("pf_err", config.kld.KLD_epsilon);
  section.read("pf_z", certainty);
  if (least < 1) section.fail("min_particles", "is not positive");
  if (most < least) section.fail("max_particles", "is less than min_particles");
  if (most > KldSampleSize::most_particles)
    section.fail("max_particles", "exceeds " + std::to_string(KldSampleSize::most_particles));
  if (!(config.kld.KLD_epsilon > 0 && config.kld.KLD_epsilon < 1)) section.fail("pf_err", "is not in (0, 1)");
  if (!(certainty > 0 && certainty < 1)) section.fail("pf_z", "is not in (0, 1)");
  config.kld.KLD_minSampleSize = static_cast<unsigned>(least);
  config.kld.KLD_maxSampleSize = static_cast<unsigned>(most);
  config.kld.KLD_delta = 1 - certainty;
  config.particles_count = most;
}

void readInitialPose(IniSection& section, LocalizationConfig& config) {
  bool given = false;
  PoseWithCovariance pose;
  pose.covariance.diagonal() << 0.25, 0.25, 15 * degree * 15 * degree;
  section.read("set_initial_pose", given);
  section.read("initial_pose_x", pose.robot_in_map.x);
  section.read("initial_pose_y", pose.robot_in_map.y);
  section.read("initial_pose_a", pose.robot_in_map.phi);
  section.read("initial_cov_xx", pose.covariance(0, 0));
  section.read("initial_cov_yy", pose.covariance(1, 1));
  section.read("initial_cov_aa", pose.covariance(2, 2));
  if (!given) return;
  pose.check();
  config.initial_pose = pose;
}

}  // namespace

bool hasAmclSection(const mrpt::config::CConfigFileBase& ini) { return ini.sectionExists(amcl_section); }

void readAmclSection(const mrpt::config::CConfigFileBase& ini, LocalizationConfig& config) try {
  static_cast<LocalizerOptions&>(config) = LocalizerOptions::amcl();
  IniSection section(ini, amcl_section);
  readMotionModel(section, *config.monte_carlo.motion_model);
  readSampleSize(section, config);
  readInitialPose(section, config);
  section.read("update_min_d", config.update_min_d);
  section.read("update_min_a", config.update_min_a);
  section.read("resample_interval", config.monte_carlo.amcl_resampling->resample_interval);
  section.read("selective_resampling", config.monte_carlo.amcl_resampling->selective_resampling);
  section.read("recovery_alpha_slow", config.monte_carlo.recovery_alpha_slow);
  section.read("recovery_alpha_fast", config.monte_carlo.recovery_alpha_fast);
  section.refuseUnknownKeys();
  config.check();
} catch (const std::invalid_argument& error) {
  const std::string message = error.what(), place = std::string("[") + amcl_section + "] ";
  throw std::invalid_argument(message.starts_with(place) ? message : place + message);
}

}  // namespace vmcl
