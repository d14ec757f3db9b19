// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/datasets/simulator.h"

#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <algorithm>
#include <fstream>

#include "one_room.h"
#include "scratch_directory.h"
#include "simulation/simulation_setup.h"
#include "vmcl/datasets/rawlog_reader.h"
#include "vmcl/datasets/rawlog_writer.h"
#include "vmcl/geometry/trajectory.h"
#include "vmcl/mrpt/camera_observation.h"
#include "vmcl/mrpt/measured_depth.h"

namespace vmcl {
namespace {

class SimulatorTest : public testing::Test {
 protected:
  SimulatorTest() { std::ofstream(scene()) << one_room_scene; }

  /// Gives the camera more.
  void equip(const std::string& with) const {
    std::string text = one_room_scene;
    const std::string camera = "width: 160, height: 120, ";
    text.replace(text.find(camera), camera.size(), "width: 320, height: 240, " + with);
    std::ofstream(scene()) << text;
  }

  /// Of all images of a log.
  std::vector<DepthImage> depthsOf(const std::string& name) const {
    std::vector<DepthImage> depths;
    RawlogReader reader(log(name));
    for (RawlogEntry entry; reader.next(entry);)
      if (cameraObservation(*entry.observation))
        depths.push_back(measuredDepth(*entry.observation, rawlogCompanion(log(name), "_Images")));
    return depths;
  }

  std::filesystem::path scene() const { return scratch_.path() / "scene.yaml"; }
  std::filesystem::path log(const std::string& name) const { return scratch_.path() / (name + ".rawlog"); }

  /// False where off-screen drawing is not possible.
  bool simulated(const std::string& name, uint64_t seed) const {
    try {
      simulate(scene(), log(name), {.session = "map", .seed = seed, .duration = 2, .simplemap = simplemap(name)});
      return true;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find("off-screen"), std::string::npos) << error.what();
      return false;
    }
  }

  std::filesystem::path simplemap(const std::string& name) const { return scratch_.path() / (name + ".simplemap"); }

  std::string failure(const SimulationOptions& options) const {
    try {
      simulate(scene(), log("x"), options);
    } catch (const std::exception& error) {
      EXPECT_FALSE(std::filesystem::exists(log("x")));
      return error.what();
    }
    return "no failure";
  }

  /// Names below the run's stem, and contents, of all that a run wrote.
  std::map<std::string, std::string> outputs(const std::string& name) const {
    std::map<std::string, std::string> contents;
    for (const auto& item : std::filesystem::recursive_directory_iterator(scratch_.path())) {
      const std::string path = std::filesystem::relative(item.path(), scratch_.path());
      if (!item.is_regular_file() || path.find(name) != 0) continue;
      std::ifstream in(item.path(), std::ios::binary);
      contents[path.substr(name.size())] = {std::istreambuf_iterator<char>(in), {}};
    }
    return contents;
  }

  ScratchDirectory scratch_;
};

TEST_F(SimulatorTest, theSameSeedGivesTheSameBytes) {
  if (!simulated("a", 3)) GTEST_SKIP() << "no off-screen rendering on this host";
  ASSERT_TRUE(simulated("b", 3));
  ASSERT_TRUE(simulated("c", 4));
  EXPECT_EQ(outputs("a").size(), 3u + 9u);  // log, truth, simplemap; an image each quarter of a second
  EXPECT_TRUE(outputs("a") == outputs("b"));
  EXPECT_FALSE(outputs("a") == outputs("c"));
  EXPECT_TRUE(outputs("a").at(".groundtruth.tum") == outputs("c").at(".groundtruth.tum"));
}

TEST_F(SimulatorTest, theSimplemapChangesNothingInTheLog) {
  if (!simulated("a", 3)) GTEST_SKIP() << "no off-screen rendering on this host";
  simulate(scene(), log("b"), {.session = "map", .seed = 3, .duration = 2});
  auto with_map = outputs("a");
  EXPECT_EQ(with_map.erase(".simplemap"), 1u);
  EXPECT_TRUE(with_map == outputs("b"));
}

TEST_F(SimulatorTest, leavesNothingBehindWhenAnOutputCannotBeWritten) {
  const auto missing = scratch_.path() / "missing" / "a.simplemap";
  EXPECT_NE(failure({.session = "map", .duration = 0.1, .simplemap = missing}), "no failure");
  EXPECT_EQ(outputs("x").size(), 0u);
}

TEST_F(SimulatorTest, writesAllSensorsByTime) {
  if (!simulated("a", 3)) GTEST_SKIP() << "no off-screen rendering on this host";
  const SimulationSetup setup = readSimulationSetup(scene(), "map");
  const Trajectory truth = readTumTrajectory(scratch_.path() / "a.groundtruth.tum");
  const auto triangles = trianglesOf(setup.scene);
  RawlogReader reader(log("a"));
  RawlogEntry entry;
  int images = 0, scans = 0, readings = 0;
  double last_time = 0;
  while (reader.next(entry)) {
    const double time = mrpt::Clock::toDouble(entry.observation->timestamp);
    EXPECT_GE(time, last_time);
    last_time = time;
    images += cameraObservation(*entry.observation).has_value();
    readings += static_cast<bool>(std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(entry.observation));
    const auto laser = std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(entry.observation);
    if (!laser) continue;
    ++scans;
    ASSERT_EQ(laser->getScanSize(), 91u);
    const LaserModel& model = setup.robot.laser->model;
    LaserSweep sweep(model, truth.at(time).value() * Eigen::Translation3d(0.1, 0, 0.25));
    sweep.add(triangles);
    for (const int ray : {0, 30, 90}) {
      const double range = sweep.distances()[ray];
      ASSERT_EQ(laser->getScanRangeValidity(ray), range <= model.max_range);
      EXPECT_NEAR(laser->getScanRange(ray), std::min(range, model.max_range), 5e-3);
    }
  }
  EXPECT_EQ(images, 9);
  EXPECT_EQ(scans, 11);
  EXPECT_EQ(readings, 41);
}

TEST_F(SimulatorTest, theSimplemapHoldsTruePosesImagesAndScans) {
  if (!simulated("a", 3)) GTEST_SKIP() << "no off-screen rendering on this host";
  mrpt::maps::CSimpleMap map;
  ASSERT_TRUE(map.loadFromFile(simplemap("a")));
  ASSERT_GE(map.size(), 2u);
  for (const auto& [pose, frame] : map) {
    const auto laser = frame->getObservationByClass<mrpt::obs::CObservation2DRangeScan>();
    ASSERT_TRUE(laser);
    bool has_camera = false;
    for (const auto& observation : *frame) has_camera |= cameraObservation(*observation).has_value();
    EXPECT_TRUE(has_camera);
    const Trajectory truth = readTumTrajectory(scratch_.path() / "a.groundtruth.tum");
    const auto expected = planarPart(truth.at(mrpt::Clock::toDouble(laser->timestamp)).value());
    EXPECT_NEAR(pose->getMeanVal().x(), expected.x, 1e-3);
    EXPECT_NEAR(pose->getMeanVal().y(), expected.y, 1e-3);
    EXPECT_NEAR(pose->getMeanVal().yaw(), expected.phi, 1e-3);
  }
}

// Half of the disparities are within half a pixel on these walls of little texture: 0.5 px over 160 px of focal length
// and 0.15 m of baseline are the inverse depth.
TEST_F(SimulatorTest, aStereoCameraMeasuresWhatADepthCameraDoes) {
  equip("depth: {max_range: 8, sigma: 0}, ");
  if (!simulated("a", 3)) GTEST_SKIP() << "no off-screen rendering on this host";
  equip("stereo_baseline: 0.15, stereo: true, ");
  ASSERT_TRUE(simulated("b", 3));
  const std::vector<DepthImage> truth = depthsOf("a"), measured = depthsOf("b");
  ASSERT_EQ(truth.size(), measured.size());
  std::vector<double> errors;
  for (std::size_t i = 0; i < truth.size(); ++i)
    for (std::size_t pixel = 0; pixel < truth[i].depths.size(); ++pixel)
      if (truth[i].depths[pixel] > 0 && measured[i].depths[pixel] > 0)
        errors.push_back(std::abs(1.0 / double{truth[i].depths[pixel]} - 1.0 / double{measured[i].depths[pixel]}));
  ASSERT_GT(errors.size(), truth.size() * 320 * 240 / 4);
  std::ranges::nth_element(errors, errors.begin() + std::ssize(errors) / 2);
  EXPECT_LT(errors[errors.size() / 2], 0.5 / (160 * 0.15));
  mrpt::maps::CSimpleMap map;
  ASSERT_TRUE(map.loadFromFile(simplemap("b")));
  const auto pair = map.begin()->sf->getObservationByClass<mrpt::obs::CObservationStereoImages>();
  ASSERT_TRUE(pair);
  EXPECT_FALSE(measuredDepth(*pair, {}).empty());
}

TEST_F(SimulatorTest, namesWhatIsWrong) {
  EXPECT_NE(failure({.session = "dance"}).find("sessions.dance is missing; there are: map, through_the_wall"),
            std::string::npos);
  EXPECT_NE(failure({.session = "through_the_wall"}).find("session through_the_wall: the path runs into wall"),
            std::string::npos);
  EXPECT_EQ(failure({.session = "map", .duration = -1}), "duration is -1.000000");
  std::filesystem::remove(scene());
  EXPECT_NE(failure({.session = "map"}).find("scene.yaml: cannot be opened"), std::string::npos);
}

}  // namespace
}  // namespace vmcl
