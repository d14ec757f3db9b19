// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/core/persistence.hpp>
#include <sstream>
#include <stdexcept>

#include "frame_tree.h"
#include "openloris.h"
#include "recording.h"
#include "vmcl/geometry/camera.h"
#include "vmcl/vision/image.h"

namespace vmcl {
namespace {

constexpr char camera_frame[] = "d400_color_optical_frame";

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& reason) {
  throw std::runtime_error(file.string() + ": " + reason);
}

cv::FileStorage openYaml(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) refuse(file, "cannot be opened");
  try {
    cv::FileStorage storage(file.string(), cv::FileStorage::READ);
    if (storage.isOpened() && storage.root().isMap()) return storage;
  } catch (const cv::Exception&) {
  }
  refuse(file, "is not a YAML file of OpenCV's kind");
}

cv::Mat matrixOf(const cv::FileNode& node, const std::filesystem::path& file, int count) {
  cv::Mat matrix;
  if (!node.empty() && node.isMap()) node >> matrix;
  if (static_cast<int>(matrix.total()) != count) refuse(file, node.name() + " is missing or of another size");
  matrix.convertTo(matrix, CV_64F);
  if (!cv::checkRange(matrix)) refuse(file, node.name() + " is not finite");
  return matrix.reshape(1, 1);
}

/// The intrinsics stand in the order fx, cx, fy, cy.
mrpt::img::TCamera readIntrinsics(const std::filesystem::path& file) {
  cv::FileStorage storage = openYaml(file);
  const cv::FileNode node = storage[camera_frame];
  if (!node.isMap()) refuse(file, std::string(camera_frame) + " is missing");
  const cv::Mat k = matrixOf(node["intrinsics"], file, 4);
  CameraCalibration calibration;
  calibration.pinhole = {static_cast<int>(node["width"]),
                         static_cast<int>(node["height"]),
                         k.at<double>(0),
                         k.at<double>(2),
                         k.at<double>(1),
                         k.at<double>(3)};
  if (!node["distortion_coefficients"].empty()) {
    const cv::Mat d = matrixOf(node["distortion_coefficients"], file, 5);
    std::copy_n(d.ptr<double>(), 5, calibration.distortion.begin());
  }
  try {
    calibration.check();
  } catch (const std::invalid_argument& error) {
    refuse(file, error.what());
  }
  mrpt::img::TCamera camera;
  camera.ncols = static_cast<uint32_t>(calibration.pinhole.width);
  camera.nrows = static_cast<uint32_t>(calibration.pinhole.height);
  camera.setIntrinsicParamsFromValues(k.at<double>(0), k.at<double>(2), k.at<double>(1), k.at<double>(3));
  const auto& d = calibration.distortion;
  if (calibration.isDistorted()) camera.setDistortionPlumbBob(d[0], d[1], d[2], d[3], d[4]);
  return camera;
}

mrpt::poses::CPose3D readMountOfCamera(const std::filesystem::path& file) {
  cv::FileStorage storage = openYaml(file);
  FrameTree frames;
  for (const cv::FileNode& node : storage["trans_matrix"]) {
    if (!node.isMap()) continue;
    const cv::Mat m = matrixOf(node["matrix"], file, 16);
    Rigid3 parent_from_child = Rigid3::Identity();
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column)
        parent_from_child.matrix()(row, column) = m.at<double>(4 * row + column);
    if (!(parent_from_child.linear() * parent_from_child.linear().transpose()).isIdentity(1e-3))
      refuse(file, "a matrix is not a rotation and a translation");
    frames.add(static_cast<std::string>(node["parent_frame"]), static_cast<std::string>(node["child_frame"]),
               parent_from_child);
  }
  mrpt::math::CMatrixDouble44 pose;
  try {
    pose.asEigen() = frames.between(openloris_robot_frame, camera_frame).matrix();
  } catch (const std::runtime_error& error) {
    refuse(file, error.what());
  }
  return mrpt::poses::CPose3D(pose);
}

/// A line of one of the lists: its time, what follows, and where it stands.
struct Line {
  double time;
  std::string rest;
  std::string place;
};

std::vector<Line> readLines(const std::filesystem::path& file, DriveRecording& recording) {
  std::vector<Line> lines;
  std::ifstream in(file);
  std::string text;
  for (int number = 1; std::getline(in, text); ++number) {
    const auto start = text.find_first_not_of(" \t\r");
    if (start == std::string::npos || text[start] == '#') continue;
    std::istringstream words(text);
    Line line{0, {}, file.string() + ":" + std::to_string(number)};
    if (words >> line.time && std::getline(words >> std::ws, line.rest)) {
      lines.push_back(line);
    } else {
      recording.addProblem(line.place + ": no time stamp");
    }
  }
  return lines;
}

Rigid3 parsePose(const Line& line) {
  std::istringstream words(line.rest);
  double v[7];
  for (double& value : v)
    if (!(words >> value) || !std::isfinite(value)) throw std::runtime_error(line.place + ": is not a pose");
  const Eigen::Quaterniond rotation(v[6], v[3], v[4], v[5]);
  if (!(rotation.norm() > 1e-6)) throw std::runtime_error(line.place + ": is not a pose");
  Rigid3 pose(rotation.normalized());
  pose.translation() = Eigen::Vector3d(v[0], v[1], v[2]);
  return pose;
}

/// Reads the files of one sequence into a recording.
class Folder {
 public:
  Folder(const std::filesystem::path& directory, const std::filesystem::path& log) : directory_(directory) {
    observation_.sensorLabel = "camera";
    observation_.cameraParams = readIntrinsics(directory / "sensors.yaml");
    observation_.cameraPose = readMountOfCamera(directory / "trans_matrix.yaml");
    if (!std::filesystem::is_regular_file(directory / "color.txt")) refuse(directory / "color.txt", "cannot be opened");
    recording_.emplace(log, observation_);
  }

  ImportReport read(const std::function<void(double share)>& progress) {
    for (const Line& line : readLines(directory_ / "groundtruth.txt", *recording_))
      guarded([&] { recording_->addTruth(line.time, parsePose(line), line.place); });
    const auto colour = readLines(directory_ / "color.txt", *recording_),
               depth = readLines(directory_ / "aligned_depth.txt", *recording_),
               odometry = readLines(directory_ / "odom.txt", *recording_);
    auto next_depth = depth.begin(), next_odometry = odometry.begin();
    for (std::size_t i = 0; i < colour.size(); ++i) {
      for (; next_odometry != odometry.end() && next_odometry->time <= colour[i].time; ++next_odometry)
        addOdometry(*next_odometry);
      for (; next_depth != depth.end() && next_depth->time <= colour[i].time + 0.1; ++next_depth) addDepth(*next_depth);
      addColour(colour[i]);
      if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(colour.size()));
    }
    for (; next_odometry != odometry.end(); ++next_odometry) addOdometry(*next_odometry);
    return recording_->finish((directory_ / "color.txt").string());
  }

 private:
  template <class Action>
  void guarded(const Action& action) try {
    action();
  } catch (const std::runtime_error& error) {
    recording_->addProblem(error.what());
  }

  std::filesystem::path fileOf(const Line& line) const {
    std::string name = line.rest;
    name.erase(name.find_last_not_of(" \t\r") + 1);
    const auto relative = std::filesystem::path(name).lexically_normal();
    if (relative.empty() || relative.is_absolute() || *relative.begin() == "..")
      throw std::runtime_error(line.place + ": " + name + " lies outside of the data set");
    return directory_ / relative;
  }

  void addOdometry(const Line& line) {
    guarded([&] { recording_->addOdometry(line.time, parsePose(line), line.place); });
  }

  void addColour(const Line& line) {
    guarded([&] {
      const auto file = fileOf(line);
      const Image image = readImage(file);
      checkSize(line, image.width, image.height);
      std::ifstream in(file, std::ios::binary);
      recording_->addImage(line.time, {std::istreambuf_iterator<char>(in), {}}, file.extension().string(), line.place);
    });
  }

  void addDepth(const Line& line) {
    guarded([&] {
      Image16 depth = readDepth(line);
      checkSize(line, depth.width, depth.height);
      recording_->addDepth(line.time, cv::Mat(depth.height, depth.width, CV_16UC1, depth.pixels.data()).clone(),
                           line.place);
    });
  }

  Image16 readDepth(const Line& line) const try {
    return readImage16(fileOf(line));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(line.place + ": " + error.what());
  }

  void checkSize(const Line& line, int width, int height) const {
    if (width != static_cast<int>(observation_.cameraParams.ncols) ||
        height != static_cast<int>(observation_.cameraParams.nrows))
      throw std::runtime_error(line.place + ": its size differs from sensors.yaml");
  }

  std::filesystem::path directory_;
  mrpt::obs::CObservationImage observation_;
  std::optional<DriveRecording> recording_;
};

}  // namespace

ImportReport importOpenLorisFolder(const std::filesystem::path& directory, const std::filesystem::path& log,
                                   const std::function<void(double share)>& progress) {
  return Folder(directory, log).read(progress);
}

}  // namespace vmcl
