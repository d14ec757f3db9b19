// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <fstream>

#include "scratch_directory.h"

namespace vmcl {

/// A directory with the files that an experiment names. The log and the map are not read before a run.
class ExperimentFiles : public testing::Test {
 protected:
  const std::string good_ =
      "rawlogs: [{rawlog: query.rawlog, maps: [rooms.simplemap], ground_truth: query.tum}]\n"
      "sensors: [laser, odometry]\n"
      "configurations: [{ini: laser.ini},\n"
      "  {name: few, ini: laser.ini, changes: {LocalizationExperiment: {particles_count: 100}}}]\n"
      "starts: [given, global]\n"
      "kidnappings: [{at: 2, skip: 1.5}]\n"
      "seeds: 3\n";

  void SetUp() override {
    write("query.rawlog", "a log");
    write("rooms.simplemap", "a map");
    write("query.tum", "0 0 0 0 0 0 0 1\n10 1 0 0 0 0 0 1\n");
    std::ifstream laser(std::string(VMCL_SOURCE_DIR) + "/share/config/laser.ini");
    write("laser.ini", std::string(std::istreambuf_iterator<char>(laser), {}));
  }

  std::filesystem::path path(const std::string& name) const { return scratch_.path() / name; }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
    return path(name);
  }

  std::string with(const std::string& from, const std::string& to) const {
    std::string text = good_;
    const auto at = text.find(from);
    if (at == std::string::npos) throw std::logic_error("the good experiment has no " + from);
    return text.replace(at, from.size(), to);
  }

 private:
  ScratchDirectory scratch_;
};

}  // namespace vmcl
