// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <map>

#include "vmcl/mrpt/localization_config.h"

namespace vmcl {
namespace fs = std::filesystem;

/// An ini that is fine, as section and key to value; tests change one value.
class Ini : public ::testing::Test {
 protected:
  std::map<std::string, std::map<std::string, std::string>> sections_{
      {"KLD_options", {{"KLD_minSampleSize", "150"}, {"KLD_maxSampleSize", "4000"}, {"KLD_binSize_PHI_deg", "10"}}},
      {"PF_options",
       {{"PF_algorithm", "0"},
        {"resamplingMethod", "0"},
        {"adaptiveSampleSize", "1"},
        {"BETA", "0.5"},
        {"sampleSize", "1"}}},
      {"DummyOdometryParams", {{"minStdXY", "0.10    // (meters)"}, {"minStdPHI", "2.0"}}},
      {"LocalizationExperiment",
       {{"rawlog_file", "drive.rawlog"},
        {"particles_count", "500 1000"},
        {"init_PDF_mode", "1"},
        {"init_PDF_min_x", "-5"},
        {"init_PDF_max_x", "5"},
        {"logOutput_dir", "LOG"}}},
      {"MetricMap", {{"occupancyGrid_count", "1"}, {"pointsMap_count", "0"}}}};
  fs::path directory_ = fs::temp_directory_path() / ("vmcl_config_test" + std::to_string(::getpid()));

  void SetUp() override { fs::create_directories(directory_); }
  void TearDown() override { fs::remove_all(directory_); }

  fs::path write() const {
    const fs::path file = directory_ / "test.ini";
    std::ofstream out(file);
    for (const auto& [section, keys] : sections_) {
      out << '[' << section << "]\n";
      for (const auto& [key, value] : keys) out << key << '=' << value << '\n';
    }
    return file;
  }

  LocalizationConfig load() const { return loadLocalizationConfig(write()); }

  /// The message with which the ini is refused, after its name.
  std::string refusal() const {
    try {
      load();
    } catch (const std::runtime_error& error) {
      const std::string message = error.what(), name = (directory_ / "test.ini").string() + ": ";
      EXPECT_EQ(message.find(name), 0U) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      return message.substr(std::min(message.size(), name.size()));
    }
    return "accepted";
  }
};

}  // namespace vmcl
