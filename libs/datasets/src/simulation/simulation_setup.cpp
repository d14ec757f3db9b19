// SPDX-License-Identifier: BSD-3-Clause
#include "simulation_setup.h"

#include <algorithm>
#include <stdexcept>

#include "../sensor_mount.h"

namespace vmcl {
namespace {

double within(YamlMap& yaml, const std::string& key, double fallback, double low, double high) {
  const double value = yaml.get(key, fallback);
  if (!(value >= low && value <= high))
    yaml.fail(key, "is not between " + std::to_string(low) + " and " + std::to_string(high));
  return value;
}

RobotModel readRobot(YamlMap yaml) {
  RobotModel robot;
  robot.radius = within(yaml, "radius", robot.radius, 0.01, 2);
  robot.height = within(yaml, "height", robot.height, 0.01, 5);
  robot.max_speed = within(yaml, "max_speed", robot.max_speed, 0.01, 5);
  robot.max_turn_rate = within(yaml, "max_turn_rate_deg", robot.max_turn_rate / degree, 1, 360) * degree;
  robot.max_acceleration = within(yaml, "max_acceleration", robot.max_acceleration, 0.01, 10);
  robot.max_turn_acceleration =
      within(yaml, "max_turn_acceleration_deg", robot.max_turn_acceleration / degree, 1, 3600) * degree;
  yaml.finish();
  return robot;
}

SimulatedCamera readCamera(YamlMap yaml) {
  SimulatedCamera camera;
  camera.rate = within(yaml, "rate", camera.rate, 0.01, 100);
  const int width = yaml.get("width", 640), height = yaml.get("height", 480);
  if (width < 16 || width > 4096) yaml.fail("width", "is not between 16 and 4096");
  if (height < 16 || height > 4096) yaml.fail("height", "is not between 16 and 4096");
  const double focal = width / 2.0 / std::tan(within(yaml, "fov_deg", 65, 10, 150) * degree / 2);
  camera.pinhole = {width, height, focal, focal, (width - 1) / 2.0, (height - 1) / 2.0};
  camera.robot_from_camera = readMount(yaml.map("robot_from_camera")) + opticalAxes();
  camera.sigma_grey = within(yaml, "sigma_grey", camera.sigma_grey, 0, 100);
  yaml.finish();
  return camera;
}

SimulatedLaser readLaser(YamlMap yaml) {
  SimulatedLaser laser;
  laser.rate = within(yaml, "rate", laser.rate, 0.01, 100);
  laser.model.rays = yaml.get("rays", laser.model.rays);
  if (laser.model.rays < 1 || laser.model.rays > 10000) yaml.fail("rays", "is not between 1 and 10000");
  laser.model.aperture = within(yaml, "aperture_deg", 180, 1, 360) * degree;
  laser.model.max_range = within(yaml, "max_range", laser.model.max_range, 0.1, 1000);
  laser.model.sigma = within(yaml, "sigma", laser.model.sigma, 0, 1);
  laser.robot_from_laser = readMount(yaml.map("robot_from_laser"));
  if (laser.robot_from_laser.pitch() != 0 || laser.robot_from_laser.roll() != 0)
    yaml.fail("robot_from_laser", "is not level");
  yaml.finish();
  return laser;
}

SimulatedOdometry readOdometry(YamlMap yaml) {
  SimulatedOdometry odometry;
  odometry.rate = within(yaml, "rate", odometry.rate, 0.01, 100);
  OdometryNoise& noise = odometry.noise;
  noise.alpha1 = within(yaml, "alpha1", noise.alpha1, 0, 1);
  noise.alpha2 = within(yaml, "alpha2", noise.alpha2, 0, 1);
  noise.alpha3 = within(yaml, "alpha3", noise.alpha3, 0, 1);
  noise.alpha4 = within(yaml, "alpha4", noise.alpha4, 0, 1);
  yaml.finish();
  return odometry;
}

Session readSession(YamlMap yaml) {
  Session session;
  const auto start = yaml.numbers("start", 3);
  session.start = {start[0], start[1], start[2] * degree};
  for (const auto& point : yaml.points("waypoints")) session.waypoints.emplace_back(point[0], point[1]);
  session.light.brightness = within(yaml, "brightness", 1, 0.05, 3);
  session.light.daylight_azimuth = within(yaml, "daylight_azimuth_deg", 0, -360, 360) * degree;
  yaml.finish();
  return session;
}

/// All sessions are read, so that each is known to be right.
Session chooseSession(YamlMap yaml, const std::string& wanted) {
  std::string names;
  Session chosen;
  bool found = false;
  for (const std::string& name : yaml.keys()) {
    Session session = readSession(yaml.map(name));
    names += (names.empty() ? "" : ", ") + name;
    if (name != wanted) continue;
    chosen = std::move(session);
    found = true;
  }
  if (!found) yaml.fail(wanted, "is missing; there are: " + names);
  return chosen;
}

}  // namespace

SimulationSetup readSimulationSetup(const std::filesystem::path& file, const std::string& session) {
  YamlMap yaml = YamlMap::read(file);
  SimulationSetup setup;
  setup.texture_seed = yaml.get<uint64_t>("texture_seed", 1);
  setup.scene = readScene(yaml);
  setup.robot = readRobot(yaml.map("robot"));
  setup.camera = readCamera(yaml.map("camera"));
  setup.laser = readLaser(yaml.map("laser"));
  setup.odometry = readOdometry(yaml.map("odometry"));
  setup.session = chooseSession(yaml.map("sessions"), session);
  yaml.finish();
  return setup;
}

}  // namespace vmcl
