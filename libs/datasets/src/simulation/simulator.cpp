// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/datasets/simulator.h"

#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <stdexcept>

#include "simulated_sensors.h"
#include "vmcl/datasets/rawlog_writer.h"

namespace vmcl {
namespace {

constexpr double start_time = 1000;  // s
constexpr double map_frame_way = 0.15, map_frame_turn = 8 * degree;
constexpr int jpeg_quality = 92;

enum class Sensor { odometry, laser, camera };

struct Reading {
  double time;
  Sensor sensor;
};

/// All readings of a drive by time.
std::vector<Reading> schedule(const SimulationSetup& setup, double end_time) {
  std::vector<Reading> readings;
  const auto add = [&](Sensor sensor, double rate) {
    for (int i = 0; start_time + i / rate <= end_time; ++i) readings.push_back({start_time + i / rate, sensor});
  };
  add(Sensor::odometry, setup.odometry.rate);
  add(Sensor::laser, setup.laser.rate);
  add(Sensor::camera, setup.camera.rate);
  std::stable_sort(readings.begin(), readings.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  return readings;
}

std::string encodedJpeg(const cv::Mat& image) {
  std::vector<uint8_t> bytes;
  cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, jpeg_quality});
  return {bytes.begin(), bytes.end()};
}

/// The places of a simplemap: a camera image and a scan each.
class MapFrames {
 public:
  bool isDue(const PlanarPose& map_from_robot) const {
    if (map_.empty()) return true;
    const PlanarPose motion = inverse(last_) * map_from_robot;
    return std::hypot(motion.x, motion.y) >= map_frame_way || std::abs(motion.phi) >= map_frame_turn;
  }

  void add(const PlanarPose& map_from_robot, mrpt::obs::CObservationImage camera, const cv::Mat& image,
           const mrpt::obs::CObservation2DRangeScan& laser) {
    last_ = map_from_robot;
    camera.image = mrpt::img::CImage(image, mrpt::img::DEEP_COPY);
    const auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(mrpt::obs::CObservation2DRangeScan::Create(laser));
    frame->insert(mrpt::obs::CObservationImage::Create(camera));
    const auto pose = mrpt::poses::CPose3DPDFGaussian::Create();
    pose->mean = mrpt::poses::CPose3D(map_from_robot.x, map_from_robot.y, 0, map_from_robot.phi, 0, 0);
    map_.insert(pose, frame);
  }

  int count() const { return static_cast<int>(map_.size()); }

  /// Throws std::runtime_error when there is no room.
  void save(AtomicFile& file) const {
    const bool raw_images = mrpt::img::CImage::DISABLE_JPEG_COMPRESSION();
    mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(false);  // a quarter of the size
    const bool saved = map_.saveToFile(file.temporaryPath());
    mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(raw_images);
    if (!saved) throw std::runtime_error(file.temporaryPath().string() + ": cannot be written");
    file.commit();
  }

 private:
  mrpt::maps::CSimpleMap map_;
  PlanarPose last_;
};

Trajectory drive(const SimulationSetup& setup, double duration) {
  const Session& session = setup.session;
  Trajectory path = driveThrough(setup.robot, session.start, session.waypoints, start_time, duration);
  checkPathIsFree(path, setup.robot, setup.scene.solids);
  return path;
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
  Recording(const SimulationSetup& setup, const std::filesystem::path& log, const SimulationOptions& options)
      : sensors_(setup, options.seed), log_(log), writer_(log) {
    if (!options.simplemap.empty()) simplemap_.emplace(options.simplemap);
  }

  void take(const Reading& reading, const Rigid3& map_from_robot) {
    switch (reading.sensor) {
      case Sensor::odometry:
        writer_.write(sensors_.odometry(reading.time, planarPart(map_from_robot)));
        truth_.push_back({reading.time, map_from_robot});
        ++report_.odometry_readings;
        break;
      case Sensor::laser:
        writer_.write(sensors_.laser(reading.time, planarPart(map_from_robot)));
        ++report_.scans;
        break;
      case Sensor::camera:
        takeImage(reading.time, planarPart(map_from_robot));
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
  void takeImage(double time, const PlanarPose& map_from_robot) {
    const auto camera = sensors_.camera(time);
    const cv::Mat image = sensors_.image(time, map_from_robot);
    writer_.write(camera, encodedJpeg(image), ".jpg");
    ++report_.images;
    if (simplemap_ && map_frames_.isDue(map_from_robot))
      map_frames_.add(map_from_robot, camera, image, sensors_.laser(time, map_from_robot));
  }

  SimulatedSensors sensors_;
  std::filesystem::path log_;
  RawlogWriter writer_;
  std::optional<AtomicFile> simplemap_;
  MapFrames map_frames_;
  std::vector<StampedPose> truth_;
  SimulationReport report_;
};

}  // namespace

void SimulationOptions::check() const {
  if (!(duration >= 0)) throw std::invalid_argument("duration is " + std::to_string(duration));
}

SimulationReport simulate(const std::filesystem::path& scene_file, const std::filesystem::path& log,
                          const SimulationOptions& options, const std::function<void(double share)>& progress) {
  options.check();
  const SimulationSetup setup = readSimulationSetup(scene_file, options.session);
  Trajectory path;
  try {
    path = drive(setup, options.duration);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(scene_file.string() + ": session " + options.session + ": " + error.what());
  }
  const double end_time = path.poses().back().time;
  Recording recording(setup, log, options);
  for (const Reading& reading : schedule(setup, end_time)) {
    recording.take(reading, path.at(reading.time).value());
    if (progress) progress((reading.time - start_time) / std::max(end_time - start_time, 1e-9));
  }
  return recording.finish(path);
}

}  // namespace vmcl
