// SPDX-License-Identifier: BSD-3-Clause
// How far the landmarks of a map lie from what a perfect depth camera saw at their features:
//   landmark_errors MAP.vmap DEPTH.rawlog TRUTH.tum
// The rawlog has an exact depth image for each keyframe's time and camera, the trajectory the true poses.
#include <mrpt/core/Clock.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>

#include <Eigen/Dense>

#include "vmcl/datasets/rawlog_reader.h"
#include "vmcl/datasets/rawlog_writer.h"
#include "vmcl/geometry/trajectory.h"
#include "vmcl/mapping/map_file.h"
#include "vmcl/mrpt/camera_observation.h"
#include "vmcl/mrpt/measured_depth.h"

namespace vmcl {
namespace {

using ImageKey = std::pair<std::string, long long>;  // label, microseconds

ImageKey keyOf(const std::string& label, double time) { return {label, std::llround(time * 1e6)}; }

/// Sums of the true places of each landmark's features.
struct Places {
  std::vector<Eigen::Vector3d> sums;
  std::vector<int> counts;
};

/// The features of a keyframe that see landmarks, placed by the true camera.
void place(const KeyframeMap& map, const Keyframe& keyframe, const CameraObservation& camera, const DepthImage& depth,
           const Rigid3& map_from_robot, Places& places) {
  const CameraCalibration& found = map.cameras[static_cast<std::size_t>(keyframe.camera)].calibration;
  for (std::size_t i = 0; i < keyframe.landmark_of_feature.size(); ++i) {
    if (keyframe.landmark_of_feature[i] < 0) continue;
    const Eigen::Vector2d pixel = found.distort(keyframe.features.pixels[i].cast<double>());
    const double z = double{depthAt(depth, pixel)};
    if (!(z > 0)) continue;  // an edge
    const auto landmark = static_cast<std::size_t>(keyframe.landmark_of_feature[i]);
    const CameraCalibration& truth = camera.calibration;
    places.sums[landmark] +=
        map_from_robot * camera.robot_from_camera * (z * truth.pinhole.ray(truth.undistort(pixel)));
    ++places.counts[landmark];
  }
}

double quantile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values.at(static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
}

void print(const KeyframeMap& map, const Places& places) {
  std::vector<double> errors, nees;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < map.landmarks.size(); ++i) {
    if (places.counts[i] == 0) continue;
    const Eigen::Vector3d error = map.landmarks[i].point_in_map - places.sums[i] / places.counts[i];
    errors.push_back(error.norm());
    sum += error;
    nees.push_back(error.dot(map.landmarks[i].covariance.ldlt().solve(error)));
  }
  double kept = 0, mean = 0;
  const double most = quantile(nees, 0.99);
  for (double value : nees)
    if (value <= most) mean += value, ++kept;
  std::cout << errors.size() << " of " << map.landmarks.size() << " landmarks away from edges\nerror: median "
            << quantile(errors, 0.5) << " m, 90 % " << quantile(errors, 0.9) << " m, mean "
            << (sum / static_cast<double>(errors.size())).transpose() << " m\nNEES (3 if honest): median "
            << quantile(nees, 0.5) << " (2.37), mean of the least 99 % " << mean / kept << " (2.89)\n";
}

int run(const std::string& map_file, const std::string& rawlog, const std::string& trajectory) {
  const KeyframeMap map = loadMap(map_file);
  const Trajectory truth = readTumTrajectory(trajectory);
  std::map<ImageKey, const Keyframe*> keyframes;
  for (const Keyframe& keyframe : map.keyframes)
    keyframes[keyOf(map.cameras[static_cast<std::size_t>(keyframe.camera)].label, keyframe.time)] = &keyframe;
  Places places{std::vector<Eigen::Vector3d>(map.landmarks.size(), Eigen::Vector3d::Zero()),
                std::vector<int>(map.landmarks.size(), 0)};
  RawlogReader reader(rawlog);
  for (RawlogEntry entry; reader.next(entry);) {
    const auto& observation = *entry.observation;
    const auto keyframe = keyframes.find(keyOf(observation.sensorLabel, mrpt::Clock::toDouble(observation.timestamp)));
    const auto map_from_robot = truth.at(mrpt::Clock::toDouble(observation.timestamp));
    if (keyframe == keyframes.end() || !map_from_robot) continue;
    const auto camera = cameraObservation(observation);
    const DepthImage depth = measuredDepth(observation, rawlogCompanion(rawlog, "_Images"));
    if (camera && !depth.empty()) place(map, *keyframe->second, *camera, depth, *map_from_robot, places);
  }
  print(map, places);
  return 0;
}

}  // namespace
}  // namespace vmcl

int main(int argc, char** argv) try {
  if (argc != 4) throw std::runtime_error("usage: landmark_errors MAP.vmap DEPTH.rawlog TRUTH.tum");
  return vmcl::run(argv[1], argv[2], argv[3]);
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
