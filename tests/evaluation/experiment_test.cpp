// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/evaluation/experiment.h"

#include <gtest/gtest.h>

#include "experiment_files.h"

namespace vmcl {
namespace {

class ExperimentTest : public ExperimentFiles {
 protected:
  /// The message with which the file is refused, after its name.
  std::string refusal(const std::string& text) const {
    try {
      readExperiment(write("bad.yaml", text));
    } catch (const std::runtime_error& error) {
      const std::string message = error.what(), name = path("bad.yaml").string() + ":";
      EXPECT_EQ(message.find(name), 0U) << message;
      return message.substr(std::min(message.size(), name.size()));
    }
    return "accepted";
  }
};

TEST_F(ExperimentTest, IsReadWhole) {
  const Experiment experiment = readExperiment(write("good.yaml", good_));
  ASSERT_EQ(experiment.sessions.size(), 1U);
  const ExperimentSession& session = experiment.sessions[0];
  EXPECT_EQ(session.name, "query");
  EXPECT_EQ(session.rawlog, path("query.rawlog"));
  EXPECT_EQ(session.maps, std::vector{path("rooms.simplemap")});
  EXPECT_EQ(session.ground_truth, path("query.tum"));
  EXPECT_EQ(experiment.sensors, (std::vector{Sensors::laser, Sensors::odometry}));
  ASSERT_EQ(experiment.configurations.size(), 2U);
  EXPECT_EQ(experiment.configurations[0].name, "laser");
  EXPECT_TRUE(experiment.configurations[0].changes.empty());
  EXPECT_EQ(experiment.configurations[1].name, "few");
  EXPECT_EQ(experiment.configurations[1].changes,
            std::vector<std::string>{"LocalizationExperiment.particles_count=100"});
  ASSERT_EQ(experiment.starts.size(), 3U);
  EXPECT_TRUE(experiment.starts[0].given);
  EXPECT_FALSE(experiment.starts[1].given);
  EXPECT_EQ(experiment.starts[2].name, "kidnapped-at-2s-for-1.5s");
  EXPECT_EQ(experiment.starts[2].kidnapping->skip, 1.5);
  EXPECT_EQ(experiment.starts[2].after, 0);
  EXPECT_EQ(experiment.seeds, 3);
}

TEST_F(ExperimentTest, AKidnappedRobotMayStartLater) {
  const Start start = readExperiment(write("good.yaml", with("skip: 1.5", "skip: 1.5, start: 0.5"))).starts[2];
  EXPECT_TRUE(start.given);
  EXPECT_EQ(start.after, 0.5);
  EXPECT_EQ(start.name, "kidnapped-at-2s-for-1.5s-after-0.5s");
}

TEST_F(ExperimentTest, KidnappingsMayDifferInTheStartAlone) {
  const std::string once = "{at: 2, skip: 1.5}";
  EXPECT_EQ(readExperiment(write("good.yaml", with(once, once + ", {at: 2, skip: 1.5, start: 1}"))).starts.size(), 4U);
  EXPECT_EQ(refusal(with(once, once + ", " + once)), "5: starts has two of the name 'kidnapped-at-2s-for-1.5s'");
}

TEST_F(ExperimentTest, OpenLorisSequence) {
  const Experiment experiment = readExperiment(write(
      "good.yaml", with("ground_truth: query.tum", "ground_truth: query.tum, openloris: {scene: cafe, sequence: 2}")));
  EXPECT_EQ(experiment.sessions[0].openloris->scene, "cafe");
  EXPECT_EQ(experiment.sessions[0].openloris->number, 2);
}

TEST_F(ExperimentTest, NamesWhatIsWrong) {
  const std::vector<std::array<std::string, 3>> mistakes{
      {"query.rawlog", "absent.rawlog", "1: rawlogs[0].rawlog names no file: absent.rawlog"},
      {"rooms.simplemap", "absent.vmap", "1: rawlogs[0].maps names no file: absent.vmap"},
      {"query.tum", "absent.tum", "1: rawlogs[0].ground_truth names no file: absent.tum"},
      {"ini: laser.ini}", "ini: absent.ini}", "3: configurations[0].ini names no file: absent.ini"},
      {"maps:", "mapps: [], maps:", "1: rawlogs[0].mapps is not a known key"},
      {"maps:", "disturbance: {drop_images: 2}, maps:",
       "1: rawlogs[0].disturbance has drop_images = 2.000000 out of its range"},
      {"maps:", "disturbance: {dim: {at: 1}}, maps:", "1: rawlogs[0].disturbance.dim.for is missing"},
      {"maps:", "disturbance: {drop: 1}, maps:", "1: rawlogs[0].disturbance.drop is not a known key"},
      {"seeds: 3", "seeds: 3\nsede: 1", "8: sede is not a known key"},
      {"seeds: 3", "seeds: 0", "7: seeds is not in [1, 100000]"},
      {"seeds: 3", "seeds: many", "7: seeds has an unfit value"},
      {"[laser, odometry]", "[laser, sonar]", "2: sensors knows camera, laser, both and odometry, not 'sonar'"},
      {"[laser, odometry]", "[laser, laser]", "2: sensors has laser twice"},
      {"[laser, odometry]", "[]", "2: sensors is missing or empty"},
      {"[laser, odometry]", "laser", "2: sensors is not a list"},
      {"starts: [given, global]", "starts: [gvien]", "5: starts knows given and global, not 'gvien'"},
      {"at: 2", "at: -2", "6: kidnappings[0].at is not positive"},
      {"at: 2", "start: 2, at: 2", "6: kidnappings[0].start is not before the kidnapping"},
      {"at: 2, ", "", "6: kidnappings[0].at is missing"},
      {"name: few", "name: laser", "3: configurations has two of the name 'laser'"},
      {"name: few", "name: a/b", "4: configurations[1].name is to be made of letters, digits, _ and -, unlike 'a/b'"},
      {"sensors: [laser, odometry]\n", "", "1: sensors is missing"}};
  for (const auto& [from, to, message] : mistakes) EXPECT_EQ(refusal(with(from, to)), message) << to;
}

TEST_F(ExperimentTest, RefusesWhatIsNoExperiment) {
  for (const char* text : {"", "garbage", "[1, 2]", "{", "rawlogs: []", "rawlogs: 5", "rawlogs: [5]"})
    EXPECT_NE(refusal(text), "accepted") << text;
  EXPECT_THROW(readExperiment(path("absent.yaml")), std::runtime_error);
}

}  // namespace
}  // namespace vmcl
