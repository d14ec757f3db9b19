// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/datasets/image_folder_import.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <stdexcept>

#include "recording.h"
#include "tum_calibration.h"
#include "vmcl/vision/image.h"

namespace vmcl {
namespace {

struct TimedImage {
  double time;
  std::filesystem::path file;
};

/// The images of a directory by time; those without a time in their names go to the problems.
std::vector<TimedImage> listImages(const std::filesystem::path& directory, DriveRecording& recording) {
  std::vector<TimedImage> images;
  std::vector<std::string> problems;
  for (const auto& item : std::filesystem::directory_iterator(directory)) {
    const std::string extension = item.path().extension().string(), stem = item.path().stem().string();
    if (extension != ".png" && extension != ".jpg") continue;
    double time = 0;
    const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), time, std::chars_format::fixed);
    if (error != std::errc() || end != stem.data() + stem.size())
      problems.push_back(item.path().string() + ": its name is not a time stamp in seconds");
    else
      images.push_back({time, item.path()});
  }
  std::sort(images.begin(), images.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  std::sort(problems.begin(), problems.end());
  for (const std::string& problem : problems) recording.addProblem(problem);
  return images;
}

std::vector<StampedPose> readOptionalPoses(const std::filesystem::path& file) {
  return std::filesystem::exists(file) ? readTumTrajectory(file).poses() : std::vector<StampedPose>{};
}

void addImage(DriveRecording& recording, const TimedImage& timed, const mrpt::img::TCamera& camera) try {
  const Image image = readImage(timed.file);
  if (image.width != static_cast<int>(camera.ncols) || image.height != static_cast<int>(camera.nrows))
    throw std::runtime_error(timed.file.string() + ": its size differs from calibration.yaml");
  std::ifstream in(timed.file, std::ios::binary);
  recording.addImage(timed.time, {std::istreambuf_iterator<char>(in), {}}, timed.file.extension().string(),
                     timed.file.string());
} catch (const std::runtime_error& error) {
  recording.addProblem(error.what());
}

}  // namespace

ImportReport importImages(const std::filesystem::path& directory, const std::filesystem::path& log,
                          const std::function<void(double share)>& progress) {
  const TumCalibration calibration = readTumCalibration(directory / "calibration.yaml");
  const auto poses = readOptionalPoses(directory / "poses.txt"),
             odometry = readOptionalPoses(directory / "odometry.txt");
  mrpt::obs::CObservationImage camera;
  camera.sensorLabel = "camera";
  camera.cameraParams = calibration.camera;
  camera.cameraPose = calibration.robot_from_camera;
  DriveRecording recording(log, camera);
  for (const StampedPose& pose : poses)
    recording.addTruth(pose.time, pose.map_from_robot, (directory / "poses.txt").string());
  const auto images = listImages(directory, recording);
  const std::string odometry_file = (directory / "odometry.txt").string();
  auto reading = odometry.begin();
  for (std::size_t i = 0; i < images.size(); ++i) {
    for (; reading != odometry.end() && reading->time <= images[i].time; ++reading)
      recording.addOdometry(reading->time, reading->map_from_robot, odometry_file);
    addImage(recording, images[i], calibration.camera);
    if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(images.size()));
  }
  for (; reading != odometry.end(); ++reading)
    recording.addOdometry(reading->time, reading->map_from_robot, odometry_file);
  return recording.finish(directory.string());
}

}  // namespace vmcl
