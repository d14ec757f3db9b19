// SPDX-License-Identifier: BSD-3-Clause
#include "ini_setup.h"

namespace vmcl {
namespace {

TEST_F(Ini, ValuesCanBeChanged) {
  const IniChanges changes{{"LocalizationExperiment.particles_count=7", "vmcl.min_share=0.5"}, std::nullopt};
  const LocalizationConfig config = loadLocalizationConfig(write(), {}, {}, changes);
  EXPECT_EQ(config.particles_count, 7);
  EXPECT_EQ(config.localized.min_share, 0.5);
}

TEST_F(Ini, AChangeThatMeansNothingIsRefused) {
  for (const char* change :
       {"particles_count=7", "LocalizationExperiment.particles_count", "", "=",
        ".=", "LocalizationExperiment.particles_cuont=7", "PF_option.BETA=1", "vmcl.min_sahre=1", "amcl.alpha1=0.1"})
    EXPECT_THROW(loadLocalizationConfig(write(), {}, {}, {{change}, std::nullopt}), std::runtime_error) << change;
}

TEST_F(Ini, SensorsChooseTheMaps) {
  sections_["MetricMap"]["visualKeyframes_count"] = "1";
  const auto load_for = [&](Sensors sensors) {
    return loadLocalizationConfig(write(), {"a.vmap", "b.simplemap"}, {}, {{}, sensors});
  };
  EXPECT_EQ(load_for(Sensors::both).maps.size(), 2U);
  EXPECT_EQ(load_for(Sensors::both).map_file, "b.simplemap");
  EXPECT_EQ(load_for(Sensors::camera).maps.size(), 1U);
  EXPECT_EQ(load_for(Sensors::camera).map_file, "");
  EXPECT_EQ(load_for(Sensors::laser).maps.size(), 1U);
  EXPECT_EQ(load_for(Sensors::laser).map_file, "b.simplemap");
  EXPECT_EQ(load_for(Sensors::odometry).maps.size(), 2U);
  EXPECT_TRUE(load_for(Sensors::odometry).odometry_only);
  EXPECT_FALSE(load_for(Sensors::both).odometry_only);
}

TEST_F(Ini, SensorsNeedTheirMaps) {
  for (const Sensors sensors : {Sensors::camera, Sensors::both})
    EXPECT_THROW(loadLocalizationConfig(write(), {}, {}, {{}, sensors}), std::runtime_error);
  EXPECT_NO_THROW(loadLocalizationConfig(write(), {"a.vmap"}, {}, {{}, Sensors::laser}));
  EXPECT_NO_THROW(loadLocalizationConfig(write(), {"a.vmap"}, {}, {{}, Sensors::odometry}));
}

TEST_F(Ini, IsReadAsPfLocalizationReadsIt) {
  const LocalizationConfig config = load();
  EXPECT_EQ(config.particles_count, 500);
  EXPECT_EQ(config.rawlog_file, "drive.rawlog");
  EXPECT_FALSE(config.start_in_free_space);
  EXPECT_EQ(config.start.min_x, -5);
  EXPECT_EQ(config.start.max_y, 0);
  EXPECT_NEAR(config.start.max_phi, std::numbers::pi, 1e-12);
  EXPECT_EQ(config.motion_model.gaussianModel.minStdXY, 0.1);
  EXPECT_NEAR(config.motion_model.gaussianModel.minStdPHI, 2 * std::numbers::pi / 180, 1e-12);
  EXPECT_EQ(config.kld.KLD_maxSampleSize, 4000U);
  EXPECT_EQ(config.maps.size(), 1U);
  EXPECT_EQ(config.monte_carlo.recovery_alpha_slow, 0);
}

TEST_F(Ini, OwnSectionIsRead) {
  sections_["vmcl"] = {{"recovery_alpha_slow", "0.001"},
                       {"injection_share", "0.2"},
                       {"min_frames", "7"},
                       {"max_heading_deviation_deg", "9"}};
  const LocalizationConfig config = load();
  EXPECT_EQ(config.monte_carlo.recovery_alpha_slow, 0.001);
  EXPECT_EQ(config.monte_carlo.injection_share, 0.2);
  EXPECT_EQ(config.localized.min_frames, 7);
  EXPECT_NEAR(config.localized.max_heading_deviation, 9 * std::numbers::pi / 180, 1e-12);
}

TEST_F(Ini, UnknownKeyOfOwnSectionIsRefused) {
  sections_["vmcl"]["recovery_alpha_slwo"] = "0.001";
  EXPECT_EQ(refusal(), "[vmcl] recovery_alpha_slwo: unknown key");
}

TEST_F(Ini, BadValuesOfOwnSectionAreRefused) {
  for (const char* value : {"nan", "inf", "2", "-1", "0.1x", ""}) {
    sections_["vmcl"]["injection_share"] = value;
    EXPECT_NE(refusal().find("[vmcl] injection_share"), std::string::npos) << value << ": " << refusal();
  }
}

TEST_F(Ini, UnknownMapIsRefused) {
  sections_["MetricMap"]["visualKeyframs_count"] = "1";
  EXPECT_EQ(refusal(), "[MetricMap] visualKeyframs_count: there is no map called 'visualKeyframs'");
}

TEST_F(Ini, BadMapCountIsRefused) {
  sections_["MetricMap"]["occupancyGrid_count"] = "-1";
  EXPECT_NE(refusal().find("[MetricMap] occupancyGrid_count"), std::string::npos);
}

TEST_F(Ini, NoMapAtAllIsRefused) {
  sections_["MetricMap"]["occupancyGrid_count"] = "0";
  EXPECT_EQ(refusal(), "[MetricMap] asks for no map");
}

TEST_F(Ini, BadParticleCountsAreRefused) {
  for (const char* value : {"0", "-5", "many", "", "99999999999"}) {
    sections_["LocalizationExperiment"]["particles_count"] = value;
    EXPECT_NE(refusal().find("[LocalizationExperiment] particles_count"), std::string::npos) << value;
  }
}

TEST_F(Ini, BadStartIsRefused) {
  sections_["LocalizationExperiment"]["init_PDF_min_x"] = "nan";
  EXPECT_NE(refusal().find("init_PDF_min_x: 'nan' is not a finite number"), std::string::npos) << refusal();
  sections_["LocalizationExperiment"]["init_PDF_min_x"] = "-1e300";
  EXPECT_NE(refusal().find("range of x goes beyond"), std::string::npos) << refusal();
  sections_["LocalizationExperiment"]["init_PDF_min_x"] = "6";
  EXPECT_NE(refusal().find("range of x is empty"), std::string::npos) << refusal();
}

TEST_F(Ini, BadFilterOptionsAreRefused) {
  sections_["KLD_options"]["KLD_maxSampleSize"] = "100";
  EXPECT_NE(refusal().find("KLD_maxSampleSize"), std::string::npos);
  sections_["KLD_options"]["KLD_maxSampleSize"] = "4000";
  sections_["PF_options"]["BETA"] = "nan";
  EXPECT_NE(refusal().find("BETA"), std::string::npos);
  sections_["PF_options"].erase("BETA");
  EXPECT_NE(refusal().find("BETA"), std::string::npos);
}

TEST_F(Ini, OtherAlgorithmsAreRefused) {
  for (const char* algorithm : {"1", "2", "3"}) {
    sections_["PF_options"]["PF_algorithm"] = algorithm;
    EXPECT_EQ(refusal(), std::string("[PF_options] PF_algorithm = ") + algorithm +
                             " is not supported, only 0 (pfStandardProposal)");
  }
  sections_["PF_options"]["PF_algorithm"] = "0";
  sections_["PF_options"]["resamplingMethod"] = "2";
  EXPECT_EQ(refusal(), "[PF_options] adaptiveSampleSize needs resamplingMethod = 0 (prMultinomial)");
}

TEST_F(Ini, PosesInSpaceAreRefused) {
  sections_["LocalizationExperiment"]["use_3D_poses"] = "true";
  EXPECT_EQ(refusal(), "[LocalizationExperiment] use_3D_poses: only planar poses are supported");
}

TEST_F(Ini, UnknownKeyOfAVisualMapIsRefused) {
  sections_["MetricMap"]["visualKeyframes_count"] = "1";
  sections_["MetricMap_visualKeyframes_00_likelihoodOpts"]["sigma_pixel"] = "2";
  EXPECT_EQ(refusal(), "[MetricMap_visualKeyframes_00_likelihoodOpts] sigma_pixel: unknown key");
}

TEST_F(Ini, BadValueOfAVisualMapIsRefused) {
  sections_["MetricMap"]["visualKeyframes_count"] = "1";
  std::string& setting = sections_["MetricMap_visualKeyframes_00_likelihoodOpts"]["setting"];
  setting = "dense";
  EXPECT_NE(refusal().find("setting is \"dense\", not scsd, dcsd or dcdd"), std::string::npos) << refusal();
  setting = "dcsd";
  sections_["MetricMap_visualKeyframes_00_likelihoodOpts"]["particle_sigma_px"] = "-2";
  EXPECT_NE(refusal().find("particle_sigma_px"), std::string::npos) << refusal();
}

TEST_F(Ini, AVmapNeedsAVisualMap) { EXPECT_THROW(loadLocalizationConfig(write(), {"rooms.vmap"}), std::runtime_error); }

TEST_F(Ini, PathsAreSoughtBesideTheIni) {
  std::ofstream(directory_ / "drive.rawlog") << "x";
  EXPECT_EQ(load().rawlog_file, directory_ / "drive.rawlog");
  EXPECT_EQ(loadLocalizationConfig(write(), {}, "other.rawlog").rawlog_file, "other.rawlog");
}

TEST_F(Ini, MissingAndGarbageFilesAreRefused) {
  EXPECT_THROW(loadLocalizationConfig(directory_ / "absent.ini"), std::runtime_error);
  std::ofstream(directory_ / "noise.ini") << std::string("\x01\x02[\xff\n=\n[[]", 10);
  EXPECT_THROW(loadLocalizationConfig(directory_ / "noise.ini"), std::runtime_error);
}

TEST_F(Ini, MissingMapFileIsNamed) {
  sections_["LocalizationExperiment"]["map_file"] = "absent.simplemap";
  const LocalizationConfig config = load();
  try {
    loadMaps(config);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()), "absent.simplemap: cannot be opened");
  }
}

TEST_F(Ini, TwoMapFilesForOneMapAreRefused) {
  sections_["MetricMap"]["visualKeyframes_count"] = "1";
  EXPECT_THROW(loadLocalizationConfig(write(), {"a.vmap", "a.vmap"}), std::runtime_error);
  EXPECT_THROW(loadLocalizationConfig(write(), {"a.simplemap", "b.gridmap"}), std::runtime_error);
  EXPECT_NO_THROW(loadLocalizationConfig(write(), {"a.simplemap", "a.vmap"}));
}

TEST_F(Ini, GarbageMapFileIsNamed) {
  const fs::path file = directory_ / "noise.simplemap";
  std::ofstream(file) << "this is no simplemap at all, only text";
  try {
    loadMaps(loadLocalizationConfig(write(), {file}));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()).find(file.string() + ": "), 0U) << error.what();
  }
}

TEST_F(Ini, AGridWithoutAFileIsRefused) {
  try {
    loadMaps(load());
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("no .simplemap or .gridmap is given"), std::string::npos) << error.what();
  }
  EXPECT_NO_THROW(loadMaps(loadLocalizationConfig(write(), {}, {}, {{}, Sensors::odometry})));
}

TEST_F(Ini, AVisualMapWithoutContentIsRefused) {
  sections_["MetricMap"] = {{"visualKeyframes_count", "1"}};
  EXPECT_THROW(loadMaps(load()), std::runtime_error);
}

}  // namespace
}  // namespace vmcl
