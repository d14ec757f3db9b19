// SPDX-License-Identifier: BSD-3-Clause
#include "simulated_sensors.h"

#include <algorithm>
#include <cmath>

#include "vmcl/mrpt/pose_conversion.h"

namespace vmcl {
namespace {

constexpr double gain_time = 3;  // s over which the gain of a camera wanders

enum Stream : uint64_t { odometry_stream, laser_stream, camera_stream, stream_count };

/// The generator for one reading of a sensor.
Random readingRandom(uint64_t seed, Stream stream, double time, uint64_t number = 0) {
  const auto microseconds = static_cast<uint64_t>(std::llround(time * 1e6));
  return Random(seed + (number << 32), microseconds * stream_count + stream);
}

mrpt::img::TCamera parametersOf(const CameraCalibration& calibration) {
  const PinholeCamera& pinhole = calibration.pinhole;
  mrpt::img::TCamera camera;
  camera.ncols = static_cast<uint32_t>(pinhole.width);
  camera.nrows = static_cast<uint32_t>(pinhole.height);
  camera.setIntrinsicParamsFromValues(pinhole.fx, pinhole.fy, pinhole.cx, pinhole.cy);
  const auto& k = calibration.distortion;
  if (calibration.isDistorted()) camera.setDistortionPlumbBob(k[0], k[1], k[2], k[3], k[4]);
  return camera;
}

}  // namespace

SimulatedSensors::SimulatedSensors(const SimulationSetup& setup, const Trajectory& path, uint64_t seed)
    : setup_(setup),
      path_(path),
      seed_(seed),
      slope_(setup.robot.tilt, setup.texture_seed),
      odometry_(setup.robot.odometry.noise, Random(seed, odometry_stream)),
      crowd_(setup.session.people, path),
      triangles_(trianglesOf(setup.scene)),
      renderer_(setup.scene, setup.session.light, setup.texture_seed, crowd_.surfaces()) {
  for (std::size_t i = 0; i < setup.robot.cameras.size(); ++i) {
    formations_.emplace_back(setup.robot.cameras[i]);
    gains_.push_back({Random(seed, 1000 + i)});
  }
}

Rigid3 SimulatedSensors::truth(double time) const {
  const Rigid3 map_from_robot = path_.at(time).value();
  return setup_.robot.tilt > 0 ? slope_.tilted(planarPart(map_from_robot)) : map_from_robot;
}

mrpt::obs::CObservationOdometry SimulatedSensors::odometry(double time) {
  const PlanarPose reading = odometry_.read(planarPart(path_.at(time).value()));
  mrpt::obs::CObservationOdometry observation;
  observation.sensorLabel = "odometry";
  observation.timestamp = mrpt::Clock::fromDouble(time);
  observation.odometry = mrpt::poses::CPose2D(reading.x, reading.y, reading.phi);
  return observation;
}

mrpt::obs::CObservation2DRangeScan SimulatedSensors::laser(double time) const {
  const LaserModel& model = setup_.robot.laser->model;
  const mrpt::poses::CPose3D& mount = setup_.robot.laser->robot_from_laser;
  LaserSweep sweep(model, truth(time) * toRigid3(mount));
  sweep.add(triangles_);
  std::vector<Triangle> people;
  appendTriangles(people, crowd_.at(time));
  sweep.add(people);
  Random random = readingRandom(seed_, laser_stream, time);
  const auto ranges = sweep.measure(random);
  mrpt::obs::CObservation2DRangeScan observation;
  observation.sensorLabel = "laser";
  observation.timestamp = mrpt::Clock::fromDouble(time);
  observation.sensorPose = mount;
  observation.aperture = static_cast<float>(model.aperture);
  observation.rightToLeft = true;
  observation.maxRange = static_cast<float>(model.max_range);
  observation.stdError = static_cast<float>(model.sigma);
  observation.resizeScan(ranges.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    observation.setScanRange(i, static_cast<float>(ranges[i].value_or(model.max_range)));
    observation.setScanRangeValidity(i, ranges[i].has_value());
  }
  return observation;
}

double SimulatedSensors::nextGain(std::size_t number, double time) {
  const double sigma = setup_.robot.cameras[number].sigma_gain;
  Gain& gain = gains_[number];
  const double kept = std::exp(-(time - gain.time) / gain_time);
  gain.logarithm = kept * gain.logarithm + sigma * std::sqrt(1 - kept * kept) * gain.random.normal();
  gain.time = time;
  return setup_.session.exposure * std::exp(gain.logarithm);
}

Eigen::Vector3d SimulatedSensors::turnRate(const SimulatedCamera& camera, double time) const {
  constexpr double before = 0.02;  // s
  const auto earlier = path_.at(time - before);
  if (!earlier) return Eigen::Vector3d::Zero();
  const Eigen::AngleAxisd turn((earlier->inverse() * path_.at(time).value()).linear());
  return toRigid3(camera.robot_from_camera).linear().transpose() * (turn.angle() / before * turn.axis());
}

CameraShot SimulatedSensors::camera(std::size_t number, double time) {
  const SimulatedCamera& camera = setup_.robot.cameras[number];
  const ImageFormation& formation = formations_[number];
  if (!setup_.session.people.empty()) renderer_.setFigures(crowd_.at(time));
  const Rigid3 map_from_camera = truth(time) * toRigid3(camera.robot_from_camera);
  const View view = renderer_.render(formation.ideal(), map_from_camera, camera.depth.has_value());
  Random random = readingRandom(seed_, camera_stream, time, number);
  CameraShot shot;
  const double gain = nextGain(number, time);
  shot.bgr = formation.image(view.bgr, turnRate(camera, time), gain, random);
  if (shot.stereo_baseline = camera.stereo_baseline; shot.stereo_baseline > 0) {
    const Rigid3 map_from_right = map_from_camera * Eigen::Translation3d(shot.stereo_baseline, 0, 0);
    shot.right_bgr = formation.image(renderer_.render(formation.ideal(), map_from_right, false).bgr,
                                     turnRate(camera, time), gain, random);
  }
  if (camera.depth) shot.depth_mm = formation.depth(view.depth, random);
  shot.observation.sensorLabel = camera.label;
  shot.observation.timestamp = mrpt::Clock::fromDouble(time);
  shot.observation.cameraPose = camera.robot_from_camera;
  shot.observation.cameraParams = parametersOf(camera.calibration);
  return shot;
}

}  // namespace vmcl
