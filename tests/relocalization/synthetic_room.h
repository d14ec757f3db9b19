// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "vmcl/geometry/random.h"
#include "vmcl/mapping/keyframe_map.h"
#include "vmcl/relocalization/relocalizer.h"

namespace vmcl {

/// Two walls to look at, with a box before one of them: each surface is a rectangle x = const in the map, covered with
/// random patches. The truth of every pixel is known.
class SyntheticRoom {
 public:
  SyntheticRoom() : surfaces_{{4, -4, 4, 1}, {2.5, -2, -0.4, 2}, {-4, -4, 4, 3}} {}

  static CameraCalibration calibration() {
    CameraCalibration calibration;
    calibration.pinhole = {320, 240, 250, 250, 159.5, 119.5};
    return calibration;
  }

  /// A camera 0.4 m above ground, 0.1 m ahead of the robot's centre when it looks ahead.
  static Rigid3 mount(double yaw = 0) {
    Rigid3 robot_from_body = toRigid3({0, 0, yaw});
    Rigid3 body_from_camera = Rigid3::Identity();
    body_from_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    body_from_camera.translation() << 0.1, 0, 0.4;
    return robot_from_body * body_from_camera;
  }

  /// Where the ray of a pixel meets a surface.
  static std::optional<Eigen::Vector3d> hit(const SyntheticRoom& room, const Rigid3& map_from_camera,
                                            const Eigen::Vector2d& pixel) {
    const Eigen::Vector3d origin = map_from_camera.translation();
    const Eigen::Vector3d ray = map_from_camera.linear() * calibration().pinhole.ray(pixel);
    std::optional<Eigen::Vector3d> nearest;
    double nearest_depth = std::numeric_limits<double>::max();
    for (const Surface& surface : room.surfaces_) {
      const double depth = (surface.x - origin.x()) / ray.x();
      const Eigen::Vector3d point = origin + depth * ray;
      if (!(depth > 0 && depth < nearest_depth) || point.y() < surface.y_min || point.y() > surface.y_max) continue;
      nearest = point;
      nearest_depth = depth;
    }
    return nearest;
  }

  Image look(const PlanarPose& map_from_robot, const Rigid3& robot_from_camera) const {
    const Rigid3 map_from_camera = toRigid3(map_from_robot) * robot_from_camera;
    Image image{320, 240, std::vector<uint8_t>(320 * 240)};
    for (int v = 0; v < 240; ++v)
      for (int u = 0; u < 320; ++u) {
        double sum = 0;  // four rays a pixel
        for (double du : {-0.25, 0.25})
          for (double dv : {-0.25, 0.25})
            sum += brightness(hit(*this, map_from_camera, Eigen::Vector2d(u + du, v + dv)));
        image.pixels[static_cast<std::size_t>(v * 320 + u)] = static_cast<uint8_t>(std::lround(sum / 4));
      }
    return image;
  }

 private:
  struct Surface {
    double x, y_min, y_max;
    uint64_t seed;
  };

  /// Patches of 6 cm, each of its own brightness.
  static double brightness(const std::optional<Eigen::Vector3d>& point) {
    if (!point) return 128;
    const auto cell = [](double coordinate) { return static_cast<uint64_t>(std::floor(coordinate / 0.06) + 100'000); };
    Random random(cell(point->y()) * 1'000'003 + cell(point->z()), cell(point->x()));
    return 20 + random.below(216);
  }

  std::vector<Surface> surfaces_;
};

/// The image, and the depths of what it shows.
inline DenseView denseView(const SyntheticRoom& room, const Image& image, const Rigid3& map_from_camera) {
  DenseView view{compressImage(image.view()), {}};
  for (int v = 0; v < image.height; v += DenseView::depth_step)
    for (int u = 0; u < image.width; u += DenseView::depth_step) {
      const auto point = SyntheticRoom::hit(room, map_from_camera, {u, v});
      const double depth = point ? (map_from_camera.inverse() * *point).z() : 0;
      view.depth.push_back(static_cast<uint16_t>(std::lround(1e3 * depth)));
    }
  return view;
}

/// A map of the room from exact truth: keyframes that look at either wall, landmarks merged where they meet.
inline KeyframeMap mapOf(const SyntheticRoom& room, double sigma = 0.01) {
  KeyframeMap map;
  map.feature_options = {.kind = FeatureKind::sift, .max_features = 500};
  map.cameras.push_back({"front", SyntheticRoom::calibration(), SyntheticRoom::mount(), 0});
  const FeatureExtractor extractor(map.feature_options);
  for (double heading : {0.0, std::numbers::pi})
    for (int i = 0; i < 4; ++i) {
      const PlanarPose map_from_robot{0.2 * i - 0.3, 0.25 * i - 0.4, heading + 0.05 * i};
      Keyframe keyframe;
      keyframe.time = static_cast<double>(map.keyframes.size());
      keyframe.map_from_robot = toRigid3(map_from_robot);
      const Image image = room.look(map_from_robot, SyntheticRoom::mount());
      keyframe.features = extractor.extract(image.view(), SyntheticRoom::calibration());
      keyframe.dense = denseView(room, image, map.referenceCamera(keyframe).map_from_camera);
      for (const Eigen::Vector2f& pixel : keyframe.features.pixels) {
        const auto point =
            SyntheticRoom::hit(room, map.referenceCamera(keyframe).map_from_camera, pixel.cast<double>());
        const auto known = std::find_if(map.landmarks.begin(), map.landmarks.end(), [&](const Landmark& landmark) {
          return point && (landmark.point_in_map - *point).norm() < 0.01;
        });
        keyframe.landmark_of_feature.push_back(point ? static_cast<int>(known - map.landmarks.begin()) : -1);
        if (point && known == map.landmarks.end())
          map.landmarks.push_back({*point, sigma * sigma * Eigen::Matrix3d::Identity(), 2});
      }
      map.keyframes.push_back(std::move(keyframe));
    }
  std::vector<const FeatureSet*> sets;
  for (const Keyframe& keyframe : map.keyframes) sets.push_back(&keyframe.features);
  map.vocabulary = VladVocabulary::train(sets, 16, 1);
  map.place_descriptors.resize(map.vocabulary.words().size(), static_cast<Eigen::Index>(sets.size()));
  for (std::size_t i = 0; i < sets.size(); ++i)
    map.place_descriptors.col(static_cast<Eigen::Index>(i)) = map.vocabulary.describe(*sets[i]);
  return map;
}

}  // namespace vmcl
