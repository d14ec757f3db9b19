// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/simulation_setup.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "one_room.h"
#include "scratch_directory.h"

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
  EXPECT_EQ(setup.camera.pinhole.width, 160);
  EXPECT_NEAR(setup.camera.pinhole.fx, 80, 1e-9);  // 90 degrees over 160 pixels
  EXPECT_NEAR(setup.laser.model.aperture, std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(setup.odometry.noise.alpha1, 0.01);
  EXPECT_NEAR(setup.session.start.phi, std::numbers::pi / 2, 1e-12);
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

TEST_F(SimulationSetupTest, wallsLeaveTheirDoorsOpen) {
  const SimulationSetup setup = read();  // the north wall at y = 3, from x = 4 to 0, has a door around x = 2
  EXPECT_FALSE(castRay(setup.scene.solids, {2, 1.5, std::numbers::pi / 2}, 0.3));
  EXPECT_NEAR(castRay(setup.scene.solids, {2, 1.5, std::numbers::pi / 2}, 2.2).value(), 1.45, 1e-9);
  EXPECT_NEAR(castRay(setup.scene.solids, {3.5, 1.5, std::numbers::pi / 2}, 0.3).value(), 1.45, 1e-9);
}

TEST_F(SimulationSetupTest, facesLieOnTheirSolidsAndWithinTheirSurfaces) {
  const Scene scene = read().scene;
  for (const Face& face : scene.faces) {
    const Surface& surface = scene.surfaces.at(face.surface);
    EXPECT_NEAR((face.map_from_face.linear().col(2) - surface.normal).norm(), 0, 1e-9);
    EXPECT_NEAR(face.map_from_face.linear().determinant(), 1, 1e-9);
    EXPECT_GE(face.offset.minCoeff(), -1e-9);
    EXPECT_LE(face.offset.x() + face.width, surface.width + 1e-9);
    EXPECT_LE(face.offset.y() + face.height, surface.height + 1e-9);
  }
}

TEST_F(SimulationSetupTest, theRoomsThatComeAlongCanBeDrivenThrough) {
  for (const char* session : {"map", "query"}) {
    const auto rooms = std::filesystem::path(VMCL_SOURCE_DIR) / "share/scenes/rooms.yaml";
    const SimulationSetup setup = readSimulationSetup(rooms, session);
    const auto path = driveThrough(setup.robot, setup.session.start, setup.session.waypoints, 0,
                                   std::numeric_limits<double>::infinity());
    EXPECT_NO_THROW(checkPathIsFree(path, setup.robot, setup.scene.solids));
  }
}

}  // namespace
}  // namespace vmcl
