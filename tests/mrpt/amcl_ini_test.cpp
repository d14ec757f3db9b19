// SPDX-License-Identifier: BSD-3-Clause
#include "ini_setup.h"

namespace vmcl {
namespace {

/// With [amcl], and none of the sections that it takes the place of.
class AmclIni : public Ini {
 protected:
  AmclIni() {
    sections_["amcl"] = {{"robot_model_type", "omnidirectional"}, {"alpha4", "0.05"}};
    for (const char* section : {"KLD_options", "PF_options", "DummyOdometryParams"}) sections_.erase(section);
    for (const char* key : {"particles_count", "init_PDF_mode"}) sections_["LocalizationExperiment"].erase(key);
  }
};

TEST_F(AmclIni, HasTheDefaultsOfNavigation2) {
  const LocalizationConfig config = load();
  ASSERT_TRUE(config.monte_carlo.motion_model && config.monte_carlo.amcl_resampling);
  EXPECT_EQ(config.monte_carlo.motion_model->drive, OdometryMotionModel::Drive::omnidirectional);
  EXPECT_EQ(config.monte_carlo.motion_model->alpha1, 0.2);
  EXPECT_EQ(config.monte_carlo.motion_model->alpha4, 0.05);
  EXPECT_EQ(config.update_min_d, 0.25);
  EXPECT_EQ(config.update_min_a, 0.2);
  EXPECT_EQ(config.particles_count, 2000);
  EXPECT_EQ(config.kld.KLD_minSampleSize, 500U);
  EXPECT_EQ(config.kld.KLD_maxSampleSize, 2000U);
  EXPECT_EQ(config.kld.KLD_epsilon, 0.05);
  EXPECT_NEAR(config.kld.KLD_delta, 0.01, 1e-12);
  EXPECT_EQ(config.monte_carlo.amcl_resampling->resample_interval, 1);
  EXPECT_FALSE(config.monte_carlo.amcl_resampling->selective_resampling);
  EXPECT_EQ(config.monte_carlo.recovery_alpha_slow, 0);
  EXPECT_TRUE(config.start_anywhere);
  EXPECT_FALSE(config.initial_pose);
}

TEST_F(AmclIni, ReadsEveryKey) {
  sections_["amcl"] = {{"robot_model_type", "nav2_amcl::DifferentialMotionModel"},
                       {"min_particles", "100"},
                       {"max_particles", "5000"},
                       {"pf_err", "0.01"},
                       {"pf_z", "0.9"},
                       {"update_min_d", "0.1"},
                       {"update_min_a", "0.5"},
                       {"resample_interval", "2"},
                       {"selective_resampling", "true"},
                       {"recovery_alpha_slow", "0.001"},
                       {"recovery_alpha_fast", "0.1"},
                       {"set_initial_pose", "true"},
                       {"initial_pose_x", "1"},
                       {"initial_pose_y", "-2"},
                       {"initial_pose_a", "0.5"},
                       {"initial_cov_xx", "0.01"},
                       {"initial_cov_aa", "0.04"}};
  const LocalizationConfig config = load();
  EXPECT_EQ(config.kld.KLD_minSampleSize, 100U);
  EXPECT_EQ(config.particles_count, 5000);
  EXPECT_EQ(config.kld.KLD_epsilon, 0.01);
  EXPECT_NEAR(config.kld.KLD_delta, 0.1, 1e-12);
  EXPECT_EQ(config.update_min_a, 0.5);
  EXPECT_EQ(config.monte_carlo.amcl_resampling->resample_interval, 2);
  EXPECT_TRUE(config.monte_carlo.amcl_resampling->selective_resampling);
  EXPECT_EQ(config.monte_carlo.recovery_alpha_fast, 0.1);
  ASSERT_TRUE(config.initial_pose);
  EXPECT_EQ(config.initial_pose->robot_in_map.y, -2);
  EXPECT_EQ(config.initial_pose->covariance(0, 0), 0.01);
  EXPECT_EQ(config.initial_pose->covariance(1, 1), 0.25);
  EXPECT_EQ(config.initial_pose->covariance(2, 2), 0.04);
}

TEST_F(AmclIni, OurOwnKeysGoOnTop) {
  sections_["vmcl"] = {{"update_min_d", "0.5"}, {"lost_after", "7"}};
  EXPECT_EQ(load().update_min_d, 0.5);
  EXPECT_EQ(load().update_min_a, 0.2);
  EXPECT_EQ(load().health.lost_after, 7);
}

TEST_F(AmclIni, BadValuesAreNamed) {
  const std::pair<const char*, const char*> bad[] = {{"alpha1", "-1"},
                                                     {"alpha5", "nan"},
                                                     {"robot_model_type", "legs"},
                                                     {"min_particles", "0"},
                                                     {"max_particles", "1"},
                                                     {"max_particles", "2000000000"},
                                                     {"pf_err", "0"},
                                                     {"pf_z", "1"},
                                                     {"pf_z", "2.3"},
                                                     {"resample_interval", "0"},
                                                     {"update_min_d", "-1"},
                                                     {"selective_resampling", "perhaps"},
                                                     {"kld_err", "0.1"}};
  for (const auto& [key, value] : bad) {
    const auto before = sections_["amcl"];
    sections_["amcl"][key] = value;
    EXPECT_NE(refusal().find("[amcl]"), std::string::npos) << key << ' ' << value << ": " << refusal();
    sections_["amcl"] = before;
  }
  sections_["amcl"]["set_initial_pose"] = "true";
  for (const char* covariance : {"-1", "1e15"}) {
    sections_["amcl"]["initial_cov_xx"] = covariance;
    EXPECT_NE(refusal().find("[amcl] the covariance"), std::string::npos) << refusal();
  }
}

TEST_F(AmclIni, TooManyParticlesAreNamedByTheKeyOfTheIni) {
  sections_["amcl"]["max_particles"] = "2000000000";
  EXPECT_EQ(refusal(), "[amcl] max_particles: exceeds 10000000");
}

}  // namespace
}  // namespace vmcl
