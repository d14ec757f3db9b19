// SPDX-License-Identifier: BSD-3-Clause
#include "sensor_setup.h"

#include <set>

#include "../sensor_mount.h"

namespace vmcl {
namespace {

RobotModel readRobot(YamlMap& yaml) {
  RobotModel robot;
  robot.radius = yaml.within("radius", robot.radius, 0.01, 2);
  robot.height = yaml.within("height", robot.height, 0.01, 5);
  robot.max_speed = yaml.within("max_speed", robot.max_speed, 0.01, 5);
  robot.max_turn_rate = yaml.within("max_turn_rate_deg", robot.max_turn_rate / degree, 1, 360) * degree;
  robot.max_acceleration = yaml.within("max_acceleration", robot.max_acceleration, 0.01, 10);
  robot.max_turn_acceleration =
      yaml.within("max_turn_acceleration_deg", robot.max_turn_acceleration / degree, 1, 3600) * degree;
  return robot;
}

CameraCalibration readCalibration(YamlMap& yaml) {
  const int width = yaml.get("width", 640), height = yaml.get("height", 480);
  if (width < 16 || width > 4096) yaml.fail("width", "is not between 16 and 4096");
  if (height < 16 || height > 4096) yaml.fail("height", "is not between 16 and 4096");
  const double focal = width / 2.0 / std::tan(yaml.within("fov_deg", 65, 10, 150) * degree / 2);
  CameraCalibration calibration{{width, height, focal, focal, (width - 1) / 2.0, (height - 1) / 2.0}, {}};
  if (!yaml.has("distortion")) return calibration;
  const auto k = yaml.numbers("distortion", 5);
  for (std::size_t i = 0; i < k.size(); ++i) {
    if (std::abs(k[i]) > 1) yaml.fail("distortion", "is not between -1 and 1");
    calibration.distortion[i] = k[i];
  }
  return calibration;
}

SimulatedDepth readDepth(YamlMap yaml) {
  SimulatedDepth depth;
  depth.max_range = yaml.within("max_range", depth.max_range, 0.1, 60);
  depth.sigma = yaml.within("sigma", depth.sigma, 0, 1);
  yaml.finish();
  return depth;
}

/// One camera, or the two of a pair that take images of their own.
std::vector<SimulatedCamera> readCamera(YamlMap yaml) {
  SimulatedCamera camera;
  camera.label = yaml.get("label", camera.label);
  camera.rate = yaml.within("rate", camera.rate, 0.01, 100);
  camera.calibration = readCalibration(yaml);
  const mrpt::poses::CPose3D mount = readMount(yaml.map("robot_from_camera"));
  camera.robot_from_camera = mount + opticalAxes();
  camera.sigma_grey = yaml.within("sigma_grey", camera.sigma_grey, 0, 100);
  camera.exposure_time = yaml.within("exposure_time", 0, 0, 0.2);
  camera.sigma_gain = yaml.within("sigma_gain", 0, 0, 1);
  if (yaml.has("depth")) camera.depth = readDepth(yaml.map("depth"));
  const double baseline = yaml.within("stereo_baseline", 0, 0, 2);
  const bool is_joined = yaml.get("stereo", false);
  if (is_joined && baseline == 0) yaml.fail("stereo", "needs a stereo_baseline");
  if (is_joined && camera.depth) yaml.fail("stereo", "is for cameras without depth");
  yaml.finish();
  if (is_joined) camera.stereo_baseline = baseline;
  if (is_joined || baseline == 0) return {camera};
  SimulatedCamera right = camera;
  right.label += "_right";
  right.robot_from_camera = mount + mrpt::poses::CPose3D(0, -baseline, 0, 0, 0, 0) + opticalAxes();
  right.depth.reset();
  camera.label += "_left";
  return {camera, right};
}

SimulatedLaser readLaser(YamlMap yaml) {
  SimulatedLaser laser;
  laser.rate = yaml.within("rate", laser.rate, 0.01, 100);
  laser.model.rays = yaml.get("rays", laser.model.rays);
  if (laser.model.rays < 1 || laser.model.rays > 10000) yaml.fail("rays", "is not between 1 and 10000");
  laser.model.aperture = yaml.within("aperture_deg", 180, 1, 360) * degree;
  laser.model.max_range = yaml.within("max_range", laser.model.max_range, 0.1, 1000);
  laser.model.sigma = yaml.within("sigma", laser.model.sigma, 0, 1);
  laser.robot_from_laser = readMount(yaml.map("robot_from_laser"));
  if (laser.robot_from_laser.pitch() != 0 || laser.robot_from_laser.roll() != 0)
    yaml.fail("robot_from_laser", "is not level");
  yaml.finish();
  return laser;
}

SimulatedOdometry readOdometry(YamlMap yaml) {
  SimulatedOdometry odometry;
  odometry.rate = yaml.within("rate", odometry.rate, 0.01, 100);
  OdometryNoise& noise = odometry.noise;
  noise.alpha1 = yaml.within("alpha1", noise.alpha1, 0, 1);
  noise.alpha2 = yaml.within("alpha2", noise.alpha2, 0, 1);
  noise.alpha3 = yaml.within("alpha3", noise.alpha3, 0, 1);
  noise.alpha4 = yaml.within("alpha4", noise.alpha4, 0, 1);
  noise.alpha5 = yaml.within("alpha5", noise.alpha5, 0, 1);
  noise.slips_per_m = yaml.within("slips_per_m", noise.slips_per_m, 0, 10);
  noise.slip = yaml.within("slip", noise.slip, 0, 1);
  noise.track_width = yaml.within("track_width", noise.track_width, 0.02, 3);
  yaml.finish();
  return odometry;
}

RobotSetup commonRobot() {
  RobotSetup setup;
  SimulatedCamera camera;
  const double focal = 320 / std::tan(65 * degree / 2);
  camera.calibration.pinhole = {640, 480, focal, focal, 319.5, 239.5};
  camera.robot_from_camera = mrpt::poses::CPose3D(0.1, 0, 0.4, 0, -6 * degree, 0) + opticalAxes();
  setup.cameras = {camera};
  setup.laser.emplace();
  setup.laser->robot_from_laser = mrpt::poses::CPose3D(0.12, 0, 0.25, 0, 0, 0);
  return setup;
}

}  // namespace

RobotSetup readRobotSetup(YamlMap& yaml) {
  const bool names_sensors = yaml.has("camera") || yaml.has("cameras") || yaml.has("laser") || yaml.has("odometry");
  RobotSetup setup;
  if (!names_sensors) setup = commonRobot();
  if (yaml.has("robot")) {
    YamlMap robot = yaml.map("robot");
    setup.robot = readRobot(robot);
    setup.tilt = robot.within("tilt_deg", 0, 0, 5) * degree;
    robot.finish();
  }
  auto cameras = yaml.list("cameras");
  if (yaml.has("camera")) cameras.insert(cameras.begin(), yaml.map("camera"));
  std::set<std::string> labels;
  for (const YamlMap& camera : cameras)
    for (const SimulatedCamera& one : readCamera(camera)) {
      if (!labels.insert(one.label).second) camera.fail("label", "is that of another camera");
      setup.cameras.push_back(one);
    }
  if (yaml.has("laser")) setup.laser = readLaser(yaml.map("laser"));
  if (yaml.has("odometry")) setup.odometry = readOdometry(yaml.map("odometry"));
  return setup;
}

}  // namespace vmcl
