// SPDX-License-Identifier: BSD-3-Clause
#include "simulated_sensors.h"

#include <algorithm>
#include <cmath>

#include "vmcl/mrpt/pose_conversion.h"

namespace vmcl {
namespace {

enum Stream : uint64_t { odometry_stream, laser_stream, camera_stream, stream_count };

/// The generator for one reading of a sensor.
Random readingRandom(uint64_t seed, Stream stream, double time) {
  return Random(seed, static_cast<uint64_t>(std::llround(time * 1e6)) * stream_count + stream);
}

void addNoise(cv::Mat& image, double sigma, Random& random) {
  for (auto pixel = image.begin<cv::Vec3b>(); pixel != image.end<cv::Vec3b>(); ++pixel) {
    const int noise = static_cast<int>(std::lround(sigma * random.normal()));
    for (uchar& channel : (*pixel).val) channel = static_cast<uchar>(std::clamp(channel + noise, 0, 255));
  }
}

}  // namespace

SimulatedSensors::SimulatedSensors(const SimulationSetup& setup, uint64_t seed)
    : setup_(setup),
      seed_(seed),
      odometry_(setup.odometry.noise, Random(seed, odometry_stream)),
      renderer_(setup.scene, setup.session.light, setup.texture_seed, setup.camera.pinhole) {}

mrpt::obs::CObservationOdometry SimulatedSensors::odometry(double time, const PlanarPose& map_from_robot) {
  const PlanarPose reading = odometry_.read(map_from_robot);
  mrpt::obs::CObservationOdometry observation;
  observation.sensorLabel = "odometry";
  observation.timestamp = mrpt::Clock::fromDouble(time);
  observation.odometry = mrpt::poses::CPose2D(reading.x, reading.y, reading.phi);
  return observation;
}

mrpt::obs::CObservation2DRangeScan SimulatedSensors::laser(double time, const PlanarPose& map_from_robot) const {
  const LaserModel& model = setup_.laser.model;
  const mrpt::poses::CPose3D& mount = setup_.laser.robot_from_laser;
  const PlanarPose map_from_laser = map_from_robot * PlanarPose{mount.x(), mount.y(), mount.yaw()};
  Random random = readingRandom(seed_, laser_stream, time);
  const auto ranges = scan(setup_.scene.solids, model, map_from_laser, mount.z(), random);
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

mrpt::obs::CObservationImage SimulatedSensors::camera(double time) const {
  const PinholeCamera& pinhole = setup_.camera.pinhole;
  mrpt::obs::CObservationImage observation;
  observation.sensorLabel = "camera";
  observation.timestamp = mrpt::Clock::fromDouble(time);
  observation.cameraPose = setup_.camera.robot_from_camera;
  observation.cameraParams.ncols = static_cast<uint32_t>(pinhole.width);
  observation.cameraParams.nrows = static_cast<uint32_t>(pinhole.height);
  observation.cameraParams.setIntrinsicParamsFromValues(pinhole.fx, pinhole.fy, pinhole.cx, pinhole.cy);
  return observation;
}

cv::Mat SimulatedSensors::image(double time, const PlanarPose& map_from_robot) {
  cv::Mat image = renderer_.render(toRigid3(map_from_robot) * toRigid3(setup_.camera.robot_from_camera));
  Random random = readingRandom(seed_, camera_stream, time);
  addNoise(image, setup_.camera.sigma_grey, random);
  return image;
}

}  // namespace vmcl
