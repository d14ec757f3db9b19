// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/simulation_setup.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "one_room.h"
#include "scratch_directory.h"
#include "simulation/shapes.h"

namespace vmcl {
namespace {

using Eigen::Vector3d;

class SimulationSetupTest : public testing::Test {
 protected:
  std::filesystem::path file() const { return scratch_.path() / "scene.yaml"; }

  /// The one-room scene with one piece of its text replaced.
  SimulationSetup read(const std::string& from = "", const std::string& to = "") const {
    std::string text = one_room_scene;
    const auto position = text.find(from);
    EXPECT_NE(position, std::string::npos) << from;
    std::ofstream(file()) << text.replace(position, from.size(), to);
    return readSimulationSetup(file(), "map");
  }

  void expectFailure(const std::string& from, const std::string& to, const std::string& reason) const {
    try {
      read(from, to);
      ADD_FAILURE() << "no failure, expected " << reason;
    } catch (const std::runtime_error& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find(file().string() + ":"), 0u) << message;
      EXPECT_NE(message.find(reason), std::string::npos) << message;
    }
  }

  ScratchDirectory scratch_;
};

TEST_F(SimulationSetupTest, readsSensorsAndSession) {
  const SimulationSetup setup = read();
  const PinholeCamera& pinhole = setup.robot.cameras.at(0).calibration.pinhole;
  EXPECT_EQ(pinhole.width, 160);
  EXPECT_NEAR(pinhole.fx, 80, 1e-9);  // 90 degrees over 160 pixels
  EXPECT_NEAR(setup.robot.laser->model.aperture, std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(setup.robot.odometry.noise.alpha1, 0.01);
  EXPECT_NEAR(setup.session.start->phi, std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(setup.session.waypoints.size(), 2u);
  EXPECT_EQ(setup.session.light.brightness, 0.9);
}

TEST_F(SimulationSetupTest, namesWhatIsWrong) {
  expectFailure("wall_height: 2.5", "wall_height: 2.5\nwall_colour: 3", "wall_colour is not a known key");
  expectFailure("rays: 91", "rays: 91, bounces: 2", "laser.bounces is not a known key");
  expectFailure("bricks", "gold", "walls[0].left.material is not one of");
  expectFailure("painting", "mirror", "walls[0].on_left[0].kind is not one of");
  expectFailure("at: 2, ", "at: 4.2, ", "walls[2].doors[0].at puts the door outside");
  expectFailure("start: [1, 1, 90]", "start: [1, 1]", "sessions.map.start is not a list of 3 numbers");
  expectFailure("[1, 2.0]", "[1, .inf]", "sessions.map.waypoints is not finite");
  expectFailure("fov_deg: 90", "fov_deg: 190", "camera.fov_deg is not between");
  expectFailure("sessions:\n  map:", "sessions:\n  lap:", "sessions.map is missing; there are: lap");
  expectFailure("size: [0.4, 0.4, 0.5]", "size: [0.4, -1, 0.5]", "boxes[0].size is not between");
}

double rangeIn(const Scene& scene, const PlanarPose& ray, double height) {
  Rigid3 map_from_ray = toRigid3(ray);
  map_from_ray.translation().z() = height;
  LaserSweep sweep({.rays = 1}, map_from_ray);
  sweep.add(trianglesOf(scene));
  return sweep.distances().front();
}

TEST_F(SimulationSetupTest, wallsLeaveTheirDoorsAndWindowsOpen) {
  const SimulationSetup setup = read();  // the north wall at y = 3, from x = 4 to 0, has a door around x = 2
  constexpr double north = std::numbers::pi / 2;
  EXPECT_TRUE(std::isinf(rangeIn(setup.scene, {2, 1.5, north}, 0.3)));
  EXPECT_NEAR(rangeIn(setup.scene, {2, 1.5, north}, 2.2), 1.45, 1e-9);
  EXPECT_NEAR(rangeIn(setup.scene, {3.5, 1.5, north}, 0.3), 1.45, 1e-9);
  const Scene windowed =
      read("doors: [{at: 2, width: 0.9, height: 2}]", "windows: [{at: 2, width: 1, sill: 0.8}]").scene;
  EXPECT_TRUE(std::isinf(rangeIn(windowed, {2.2, 1.5, north}, 1.5)));
  EXPECT_NEAR(rangeIn(windowed, {2.2, 1.5, north}, 0.3), 1.45, 1e-9);
  ASSERT_EQ(windowed.lamps.size(), 1u);
  EXPECT_NEAR((windowed.lamps[0].center - Eigen::Vector3d(2, 3, 1.4)).norm(), 0, 1e-9);
}

TEST_F(SimulationSetupTest, sessionsMoveAndRemoveThings) {
  const auto crate = [](const Scene& scene) { return rangeIn(scene, {3, 0.5, std::numbers::pi / 2}, 0.3); };
  EXPECT_LT(crate(read().scene), 1.4);
  const std::string light = "brightness: 0.9";
  EXPECT_GT(crate(read(light, "remove: [crate]").scene), 2);
  EXPECT_NEAR(crate(read(light, "move: {crate: [3, 1.2, 0]}").scene), 0.5, 1e-9);
  expectFailure(light, "remove: [ghost]", "sessions.map changes what it cannot: ghost is not in the scene");
}

TEST_F(SimulationSetupTest, includesOtherScenesAndTheirFurniture) {
  std::ofstream(scratch_.path() / "things.yaml")
      << "prototypes:\n  post: [{shape: cylinder, center: [0, 0], radius: 0.1, height: 1, cover: {material: wood}}]\n";
  const std::string head = "wall_height: 2.5";
  const auto with = [&](const std::string& more) { return head + "\n" + more; };
  const Scene scene = read(head, with("include: [things.yaml]\nfurniture: [{kind: post, at: [1, 1, 0]}]")).scene;
  EXPECT_NEAR(rangeIn(scene, {2, 1, std::numbers::pi}, 0.5), 0.9, 0.01);
  expectFailure(head, with("include: [nowhere.yaml]"), "include names nowhere.yaml, which is neither");
  expectFailure(head, with("include: [scene.yaml]"), "include goes around in circles");
  expectFailure(head, with("furniture: [{kind: ghost, at: [1, 1, 0]}]"),
                "furniture[0].kind is not one of the prototypes");
  expectFailure(head, with("models: [{name: m, uri: ghost.dae, pose: [0, 0, 0, 0, 0, 0]}]"),
                "ghost.dae: there is no such mesh");
}

TEST_F(SimulationSetupTest, aStereoCameraIsTwo) {
  const SimulationSetup setup = read("fov_deg: 90", "fov_deg: 90, stereo_baseline: 0.1, depth: {max_range: 4}");
  ASSERT_EQ(setup.robot.cameras.size(), 2u);
  const auto &left = setup.robot.cameras[0], &right = setup.robot.cameras[1];
  EXPECT_EQ(left.label + right.label, "camera_leftcamera_right");
  EXPECT_NEAR(left.robot_from_camera.y() - right.robot_from_camera.y(), 0.1, 1e-12);
  EXPECT_TRUE(left.depth && !right.depth);
}

TEST_F(SimulationSetupTest, theImagesOfAStereoCameraMayBeJoined) {
  const SimulationSetup setup = read("fov_deg: 90", "fov_deg: 90, stereo_baseline: 0.1, stereo: true");
  ASSERT_EQ(setup.robot.cameras.size(), 1u);
  EXPECT_EQ(setup.robot.cameras[0].label, "camera");
  EXPECT_EQ(setup.robot.cameras[0].stereo_baseline, 0.1);
  expectFailure("fov_deg: 90", "fov_deg: 90, stereo: true", "stereo needs a stereo_baseline");
  expectFailure("fov_deg: 90", "fov_deg: 90, stereo_baseline: 0.1, stereo: true, depth: {max_range: 4}",
                "stereo is for cameras without depth");
}

TEST_F(SimulationSetupTest, aFileWithoutRobotAndSessionsIsExplored) {
  std::ofstream(file()) << "floors: [{from: [0, 0], to: [4, 3], cover: {material: planks}}]\n";
  const SimulationSetup setup = readSimulationSetup(file(), "");
  EXPECT_TRUE(setup.session.exploration);
  EXPECT_EQ(setup.robot.cameras.size(), 1u);
  EXPECT_TRUE(setup.robot.laser);
}

TEST_F(SimulationSetupTest, facesAreFlatAndWithinTheirSurfaces) {
  const Scene scene = read().scene;
  for (const Face& face : scene.faces) {
    const Surface& surface = scene.surfaces.at(face.surface);
    EXPECT_NEAR((normalOf(face) - surface.normal).norm(), 0, 1e-9);
    EXPECT_NEAR((face.corners[1] - face.corners[0]).norm(), face.width, 1e-9);
    EXPECT_NEAR((face.corners[3] - face.corners[0]).norm(), face.height, 1e-9);
    EXPECT_GE(face.offset.minCoeff(), -1e-9);
    EXPECT_LE(face.offset.x() + face.width, surface.width + 1e-9);
    EXPECT_LE(face.offset.y() + face.height, surface.height + 1e-9);
  }
}

TEST(ScenesThatComeAlong, canBeDrivenThrough) {
  for (const char* name : {"rooms", "apartment", "office", "cafe"})
    for (const char* session : {"map", "query"}) {
      const auto file = std::filesystem::path(VMCL_SOURCE_DIR) / "share/scenes" / (std::string(name) + ".yaml");
      const SimulationSetup setup = readSimulationSetup(file, session);
      EXPECT_NO_THROW(
          drive(setup.session, setup.robot.robot, setup.scene, 0, std::numeric_limits<double>::infinity(), 1))
          << name << ' ' << session;
    }
}

TEST(ScenesThatComeAlong, theHouseOfMeshesCanBeExplored) {
  const std::filesystem::path data = std::filesystem::path(VMCL_SHARED_DIR) / "data/aws_small_house";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "no " << data;
  const auto file = std::filesystem::path(VMCL_SOURCE_DIR) / "share/scenes/aws_small_house.yaml";
  for (const char* session : {"map", "query"}) {
    const SimulationSetup setup = readSimulationSetup(file, session, {data});
    const Trajectory path = drive(setup.session, setup.robot.robot, setup.scene, 0, 30, 1);
    EXPECT_NEAR(path.poses().back().time, 30, 0.02);
    const FloorPlan plan(trianglesOf(setup.scene), setup.robot.robot.height);
    EXPECT_NO_THROW(checkPathIsFree(path, setup.robot.robot, plan, setup.scene.objects));
  }
}

}  // namespace
}  // namespace vmcl
