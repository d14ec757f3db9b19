// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/datasets/simulator.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <set>
#include <stdexcept>

#include "../depth_observation.h"
#include "../stereo_observation.h"
#include "map_frames.h"
#include "model_mesh.h"
#include "simulated_sensors.h"
#include "vmcl/datasets/rawlog_writer.h"

namespace vmcl {
namespace {

constexpr double start_time = 1000;  // s
constexpr int jpeg_quality = 92;

struct Reading {
  enum class Sensor { odometry, laser, camera };
  double time;
  Sensor sensor;
  std::size_t camera = 0;
};

/// All readings of a drive by time.
std::vector<Reading> schedule(const RobotSetup& robot, double end_time) {
  std::vector<Reading> readings;
  const auto add = [&](Reading::Sensor sensor, double rate, std::size_t camera = 0) {
    for (int i = 0; start_time + i / rate <= end_time; ++i) readings.push_back({start_time + i / rate, sensor, camera});
  };
  add(Reading::Sensor::odometry, robot.odometry.rate);
  if (robot.laser) add(Reading::Sensor::laser, robot.laser->rate);
  for (std::size_t i = 0; i < robot.cameras.size(); ++i) add(Reading::Sensor::camera, robot.cameras[i].rate, i);
  std::stable_sort(readings.begin(), readings.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  return readings;
}

std::string encodedJpeg(const cv::Mat& image) {
  std::vector<uint8_t> bytes;
  cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, jpeg_quality});
  return {bytes.begin(), bytes.end()};
}

double length(const Trajectory& path) {
  double way = 0;
  for (std::size_t i = 1; i < path.poses().size(); ++i)
    way += (path.poses()[i].map_from_robot.translation() - path.poses()[i - 1].map_from_robot.translation()).norm();
  return way;
}

/// What a drive leaves behind.
class Recording {
 public:
  Recording(const SimulationSetup& setup, const Trajectory& path, const std::filesystem::path& log,
            const SimulationOptions& options)
      : sensors_(setup, path, options.seed), has_laser_(setup.robot.laser), log_(log), writer_(log) {
    if (!options.simplemap.empty()) simplemap_.emplace(options.simplemap);
  }

  void take(const Reading& reading) {
    switch (reading.sensor) {
      case Reading::Sensor::odometry:
        writer_.write(sensors_.odometry(reading.time));
        truth_.push_back({reading.time, sensors_.truth(reading.time)});
        ++report_.odometry_readings;
        break;
      case Reading::Sensor::laser:
        writer_.write(sensors_.laser(reading.time));
        ++report_.scans;
        break;
      case Reading::Sensor::camera:
        takeImage(reading);
    }
  }

  SimulationReport finish(const Trajectory& path) {
    if (simplemap_) map_frames_.save(*simplemap_);
    writeTumTrajectory(rawlogCompanion(log_, ".groundtruth.tum"), Trajectory(truth_));
    writer_.commit();
    report_.map_frames = map_frames_.count();
    report_.duration = path.poses().back().time - start_time;
    report_.way = length(path);
    return report_;
  }

 private:
  void takeImage(const Reading& reading) {
    const CameraShot shot = sensors_.camera(reading.camera, reading.time);
    write(shot);
    ++report_.images;
    const PlanarPose map_from_robot = planarPart(sensors_.truth(reading.time));
    if (!simplemap_ || !map_frames_.isDue(shot.observation.sensorLabel, map_from_robot)) return;
    map_frames_.add(map_from_robot, shot, has_laser_ ? std::optional(sensors_.laser(reading.time)) : std::nullopt);
  }

  void write(const CameraShot& shot) {
    const std::string image = encodedJpeg(shot.bgr), extension = ".jpg";
    if (!shot.depth_mm.empty())
      writer_.write(depthObservation(shot.observation, shot.depth_mm), image, extension);
    else if (!shot.right_bgr.empty())
      writer_.write(stereoObservation(shot.observation, shot.stereo_baseline), image, encodedJpeg(shot.right_bgr),
                    extension);
    else
      writer_.write(shot.observation, image, extension);
  }

  SimulatedSensors sensors_;
  bool has_laser_;
  std::filesystem::path log_;
  RawlogWriter writer_;
  std::optional<AtomicFile> simplemap_;
  MapFrames map_frames_;
  std::vector<StampedPose> truth_;
  SimulationReport report_;
};

std::vector<std::string> missingImages(const Scene& scene) {
  std::set<std::string> missing;
  for (const Model& model : scene.models)
    for (const ModelPart& part : model.mesh->parts)
      if (!part.missing_texture.empty()) missing.insert(part.missing_texture.string());
  return {missing.begin(), missing.end()};
}

}  // namespace

void SimulationOptions::check() const {
  if (!(duration >= 0)) throw std::invalid_argument("duration is " + std::to_string(duration));
}

SimulationReport simulate(const std::filesystem::path& scene_file, const std::filesystem::path& log,
                          const SimulationOptions& options, const std::function<void(double share)>& progress) {
  options.check();
  const SimulationSetup setup = readSimulationSetup(scene_file, options.session, options.include_directories);
  Trajectory path;
  try {
    path = drive(setup.session, setup.robot.robot, setup.scene, start_time, options.duration, options.seed);
  } catch (const std::runtime_error& error) {
    const std::string session = options.session.empty() ? "" : "session " + options.session + ": ";
    throw std::runtime_error(scene_file.string() + ": " + session + error.what());
  }
  const double end_time = path.poses().back().time;
  Recording recording(setup, path, log, options);
  for (const Reading& reading : schedule(setup.robot, end_time)) {
    recording.take(reading);
    if (progress) progress((reading.time - start_time) / std::max(end_time - start_time, 1e-9));
  }
  SimulationReport report = recording.finish(path);
  report.missing_images = missingImages(setup.scene);
  return report;
}

}  // namespace vmcl
