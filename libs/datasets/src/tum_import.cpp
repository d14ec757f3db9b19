// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/datasets/tum_import.h"

#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <opencv2/core.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "depth_observation.h"
#include "tum_calibration.h"
#include "vmcl/datasets/rawlog_writer.h"
#include "vmcl/geometry/trajectory.h"
#include "vmcl/vision/image.h"

namespace vmcl {
namespace {

constexpr double margin = 1.0;      // s of poses kept before the first and after the last image
constexpr double same_time = 0.02;  // s between a colour image and its depth, as the benchmark's associate.py has it
constexpr double depth_units_per_mm = 5;
constexpr double max_time = 1e10;  // s, the year 2286; a rawlog's clock overflows later

struct ListedImage {
  double time;
  std::filesystem::path file;
  std::string place;  ///< "rgb.txt:12", for messages
};

ListedImage parseImageLine(const std::string& line, const std::filesystem::path& directory, std::string place) {
  std::istringstream words(line);
  ListedImage image{0, {}, std::move(place)};
  std::string name;
  if (!(words >> image.time >> name)) throw std::runtime_error(image.place + ": expected `time file`");
  if (!(image.time >= 0 && image.time <= max_time)) throw std::runtime_error(image.place + ": time is out of range");
  const std::filesystem::path relative = std::filesystem::path(name).lexically_normal();
  if (relative.is_absolute() || *relative.begin() == "..")
    throw std::runtime_error(image.place + ": " + name + " lies outside of the data set");
  image.file = directory / relative;
  return image;
}

/// The images of a list between first and last frame, sorted by time; bad lines go to the report.
std::vector<ListedImage> readImageList(const std::filesystem::path& list, const TumImportOptions& options,
                                       TumImportReport& report) {
  std::ifstream in(list);
  if (!in) throw std::runtime_error(list.string() + ": cannot be opened");
  std::vector<ListedImage> images;
  std::string line;
  for (int number = 1, frame = 0; std::getline(in, line); ++number) {
    const auto start = line.find_first_not_of(" \t\r");
    if (start == std::string::npos || line[start] == '#') continue;
    const bool wanted = frame >= options.first_frame && frame <= options.last_frame;
    ++frame;
    if (!wanted) continue;
    try {
      images.push_back(parseImageLine(line, list.parent_path(), list.string() + ":" + std::to_string(number)));
    } catch (const std::runtime_error& error) {
      report.problems.push_back(error.what());
    }
  }
  std::stable_sort(images.begin(), images.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  return images;
}

/// The depth images of an optional list.
std::vector<ListedImage> readDepthList(const std::filesystem::path& list, TumImportReport& report) {
  if (!std::filesystem::exists(list)) return {};
  return readImageList(list, {}, report);
}

/// That of the time nearest to the colour image's, if it was taken together with it.
const ListedImage* depthOf(const ListedImage& colour, const std::vector<ListedImage>& depths) {
  const auto distance = [&](const ListedImage& depth) { return std::abs(depth.time - colour.time); };
  const auto nearest = std::ranges::min_element(depths, {}, distance);
  return nearest != depths.end() && distance(*nearest) <= same_time ? &*nearest : nullptr;
}

/// Millimetres; what is wrong with the image goes to the report.
std::optional<cv::Mat> readDepth(const ListedImage* listed, const mrpt::img::TCamera& camera, TumImportReport& report) {
  if (listed == nullptr) return std::nullopt;
  try {
    Image16 depth = readImage16(listed->file);
    if (depth.width != static_cast<int>(camera.ncols) || depth.height != static_cast<int>(camera.nrows))
      throw std::runtime_error(listed->file.string() + ": its size differs from calibration.yaml");
    cv::Mat millimetres;
    cv::Mat(depth.height, depth.width, CV_16UC1, depth.pixels.data())
        .convertTo(millimetres, CV_16U, 1 / depth_units_per_mm);
    return millimetres;
  } catch (const std::runtime_error& error) {
    report.problems.push_back(listed->place + ": " + error.what());
    return std::nullopt;
  }
}

/// The poses of an optional file that fall into the time of the images.
std::vector<StampedPose> readPoses(const std::filesystem::path& file, const std::vector<ListedImage>& images) {
  if (!std::filesystem::exists(file)) return {};
  std::vector<StampedPose> poses = readTumTrajectory(file).poses();
  std::erase_if(poses, [&](const StampedPose& pose) {
    return pose.time < images.front().time - margin || pose.time > images.back().time + margin;
  });
  return poses;
}

void writeOdometry(RawlogWriter& writer, const StampedPose& pose) {
  const PlanarPose planar = planarPart(pose.map_from_robot);
  mrpt::obs::CObservationOdometry observation;
  observation.sensorLabel = "odometry";
  observation.timestamp = mrpt::Clock::fromDouble(pose.time);
  observation.odometry = mrpt::poses::CPose2D(planar.x, planar.y, planar.phi);
  writer.write(observation);
}

/// The image file as it is, once it is known to hold an image of the right size.
std::string readEncodedImage(const ListedImage& listed, const mrpt::img::TCamera& camera) {
  try {
    const Image image = readImage(listed.file);
    if (image.width != static_cast<int>(camera.ncols) || image.height != static_cast<int>(camera.nrows))
      throw std::runtime_error(listed.file.string() + ": its size differs from calibration.yaml");
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(listed.place + ": " + error.what());
  }
  std::ifstream in(listed.file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void writeImage(RawlogWriter& writer, const ListedImage& listed, const std::string& encoded,
                const TumCalibration& calibration, const std::optional<cv::Mat>& depth_mm) {
  mrpt::obs::CObservationImage observation;
  observation.sensorLabel = "camera";
  observation.timestamp = mrpt::Clock::fromDouble(listed.time);
  observation.cameraParams = calibration.camera;
  observation.cameraPose = calibration.robot_from_camera;
  const std::string extension = listed.file.extension().string();
  if (depth_mm)
    writer.write(depthObservation(observation, *depth_mm), encoded, extension);
  else
    writer.write(observation, encoded, extension);
}

}  // namespace

void TumImportOptions::check() const {
  if (first_frame < 0) throw std::invalid_argument("first_frame is " + std::to_string(first_frame));
  if (last_frame < first_frame)
    throw std::invalid_argument("last_frame " + std::to_string(last_frame) + " is before first_frame " +
                                std::to_string(first_frame));
}

TumImportReport importTum(const std::filesystem::path& directory, const std::filesystem::path& log,
                          const TumImportOptions& options, const std::function<void(double share)>& progress) {
  options.check();
  TumImportReport report;
  const TumCalibration calibration = readTumCalibration(directory / "calibration.yaml");
  report.mask_rows_from_top = calibration.mask_rows_from_top;
  const auto images = readImageList(directory / "rgb.txt", options, report);
  const auto no_image = (directory / "rgb.txt").string() + ": no image to import";
  if (images.empty()) throw std::runtime_error(report.problems.empty() ? no_image : report.problems.front());
  const auto depths = readDepthList(directory / "depth.txt", report);
  const auto odometry = readPoses(directory / "odometry.txt", images);
  const auto ground_truth = readPoses(directory / "groundtruth.txt", images);

  RawlogWriter writer(log);
  auto reading = odometry.begin();
  for (std::size_t i = 0; i < images.size(); ++i) {
    for (; reading != odometry.end() && reading->time <= images[i].time; ++reading) writeOdometry(writer, *reading);
    std::string encoded;
    try {
      encoded = readEncodedImage(images[i], calibration.camera);
    } catch (const std::runtime_error& error) {
      report.problems.push_back(error.what());
      continue;
    }
    const auto depth_mm = readDepth(depthOf(images[i], depths), calibration.camera, report);
    report.depth_images += depth_mm.has_value();
    writeImage(writer, images[i], encoded, calibration, depth_mm);
    ++report.images;
    if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(images.size()));
  }
  for (; reading != odometry.end(); ++reading) writeOdometry(writer, *reading);
  if (report.images == 0) throw std::runtime_error(report.problems.front());
  if (!ground_truth.empty()) writeTumTrajectory(rawlogCompanion(log, ".groundtruth.tum"), Trajectory(ground_truth));
  writer.commit();
  report.odometry_readings = static_cast<int>(odometry.size());
  report.ground_truth_poses = static_cast<int>(ground_truth.size());
  return report;
}

}  // namespace vmcl
