// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>
#include <vector>

#include "vmcl/geometry/random.h"
#include "vmcl/mapping/map_builder.h"

namespace vmcl::testing {

/// Points on the walls and floor of a room of 8 m x 6 m x 2.5 m around the origin, each with a descriptor of its own.
struct Room {
  std::vector<Eigen::Vector3d> points_in_map;
  Descriptors descriptors;

  explicit Room(int count, uint64_t seed) : descriptors(count, 32) {
    Random random(seed);
    for (int i = 0; i < count; ++i) {
      const double x = random.uniform(-4, 4), y = random.uniform(-3, 3), z = random.uniform(0, 2.5);
      const bool along_x = random.below(2) == 0;
      const double side = random.below(2) == 0 ? 1 : -1;
      points_in_map.push_back(along_x ? Eigen::Vector3d(x, 3 * side, z) : Eigen::Vector3d(4 * side, y, z));
      for (int byte = 0; byte < 32; ++byte) descriptors(i, byte) = static_cast<uint8_t>(random.next());
    }
  }
};

inline MapCamera forwardCamera() {
  MapCamera camera{"front", {{640, 480, 500, 500, 319.5, 239.5}, {}}, Rigid3::Identity(), 0};
  camera.robot_from_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  camera.robot_from_camera.translation() << 0.1, 0.02, 0.4;
  return camera;
}

/// Features and the depth of each along the optical axis (m), 0 for outliers.
struct Seen {
  FeatureSet features;
  std::vector<float> depths;
};

/// What the camera sees of the room: pixels with noise, and a share of features whose pixel is anywhere.
inline Seen see(const Room& room, const ReferenceCamera& view, double sigma_px, double outliers, Random& random) {
  FeatureSet features;
  std::vector<float> depths;
  std::vector<int> seen;
  for (int i = 0; i < std::ssize(room.points_in_map); ++i) {
    const Eigen::Vector3d point_in_camera =
        view.map_from_camera.inverse() * room.points_in_map[static_cast<std::size_t>(i)];
    if (point_in_camera.z() < 0.1) continue;
    const Eigen::Vector2d pixel = view.camera.project(point_in_camera);
    if (!view.camera.contains(pixel)) continue;
    const bool is_outlier = random.uniform() < outliers;
    const Eigen::Vector2d shown =
        is_outlier ? Eigen::Vector2d(random.uniform(0, view.camera.width), random.uniform(0, view.camera.height))
                   : Eigen::Vector2d(pixel + sigma_px * Eigen::Vector2d(random.normal(), random.normal()));
    features.pixels.push_back(shown.cast<float>());
    features.sizes.push_back(31);
    features.responses.push_back(1);
    depths.push_back(is_outlier ? 0 : static_cast<float>(point_in_camera.z()));
    seen.push_back(i);
  }
  features.descriptors = room.descriptors(seen, Eigen::all);
  return {std::move(features), std::move(depths)};
}

/// An oval drive with the nose along the way.
inline std::vector<PlanarPose> ovalDrive(int count) {
  std::vector<PlanarPose> poses;
  for (int i = 0; i < count; ++i) {
    const double a = 2 * std::numbers::pi * i / count;
    poses.push_back({2 * std::cos(a), 1.2 * std::sin(a), std::atan2(1.2 * std::cos(a), -2 * std::sin(a))});
  }
  return poses;
}

/// A posed drive through a room, as a robot would record it: poses with errors, a mount turned against its nominal one.
struct Recording {
  Room room{600, 11};
  std::vector<PlanarPose> drive = ovalDrive(60);
  Eigen::Vector3d mount_error = Eigen::Vector3d::Zero();  ///< roll, pitch, yaw (rad)
  double k1 = 0;                                          ///< true radial distortion; the given one is 0
  double k2 = 0;
  double sigma_px = 0.5;
  double sigma_depth = 0;  ///< of the inverse depth (1/m); 0: none is measured
  double sigma_position = 0.02;
  double sigma_heading = 0.01;
  double sigma_tilt = 0.005;    ///< of the roll and pitch that the floor gives the robot, in addition to those given,
  double sigma_height = 0.003;  ///< and of its height
  double outliers = 0.1;
  mutable std::vector<Rigid3> given_poses{};  ///< of the map built last

  MapCamera trueCamera() const {
    MapCamera camera = forwardCamera();
    const Eigen::Matrix3d turn = (Eigen::AngleAxisd(mount_error.z(), Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(mount_error.y(), Eigen::Vector3d::UnitY()) *
                                  Eigen::AngleAxisd(mount_error.x(), Eigen::Vector3d::UnitX()))
                                     .toRotationMatrix();
    camera.robot_from_camera.linear() = turn * camera.robot_from_camera.linear();
    camera.calibration.distortion = {k1, k2, 0, 0, 0};
    return camera;
  }

  MapBuilderOptions builderOptions() const {
    MapBuilderOptions options;
    options.features = {FeatureKind::orb, 1000, 0};
    options.keyframe_distance = options.keyframe_rotation = 0;
    options.sigma_px = sigma_px;
    options.sigma_position = sigma_position;
    options.sigma_heading = sigma_heading;
    options.sigma_tilt = sigma_tilt;
    options.sigma_height = sigma_height;
    options.words = 8;
    return options;
  }

  Rigid3 stance(Random& random) const {
    const double roll = sigma_tilt * random.normal(), pitch = sigma_tilt * random.normal();
    return Eigen::Translation3d(0, 0, sigma_height * random.normal()) *
           Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
  }

  std::pair<KeyframeMap, MapBuildReport> build(const MapBuilderOptions& options, uint64_t seed) const {
    Random random(seed);
    MapBuilder builder({forwardCamera()}, options);
    const MapCamera camera = trueCamera();
    given_poses.clear();
    for (std::size_t i = 0; i < drive.size(); ++i) {
      const ReferenceCamera view{camera.calibration.pinhole,
                                 toRigid3(drive[i]) * stance(random) * camera.robot_from_camera};
      const PlanarPose given{drive[i].x + sigma_position * random.normal(),
                             drive[i].y + sigma_position * random.normal(),
                             drive[i].phi + sigma_heading * random.normal()};
      given_poses.push_back(toRigid3(given));
      auto [seen, depths] = see(room, view, sigma_px, outliers, random);
      for (Eigen::Vector2f& pixel : seen.pixels) pixel = camera.calibration.distort(pixel.cast<double>()).cast<float>();
      for (float& depth : depths)
        if (depth > 0) depth = static_cast<float>(1 / (1 / depth + sigma_depth * random.normal()));
      if (sigma_depth == 0) depths.clear();
      builder.add(0.1 * static_cast<double>(i), 0, toRigid3(given), std::move(seen), std::move(depths));
    }
    return builder.build();
  }
};

/// A short drive through a small room, for maps that are made by the hundred.
inline Recording shortRecording() {
  Recording recording;
  recording.room = Room(60, 12);
  recording.drive.clear();
  for (int i = 0; i < 6; ++i) recording.drive.push_back({-1.5 + 0.25 * i, 0.15 * i, 0.2 + 0.05 * i});
  recording.outliers = 0;
  return recording;
}

}  // namespace vmcl::testing
