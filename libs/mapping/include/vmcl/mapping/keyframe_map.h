// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "vmcl/estimation/pose_mixture.h"
#include "vmcl/geometry/camera.h"
#include "vmcl/geometry/planar_pose.h"
#include "vmcl/geometry/pose_problem.h"
#include "vmcl/mapping/dense_view.h"
#include "vmcl/vision/features.h"
#include "vmcl/vision/place_recognition.h"

namespace vmcl {

/// Where a camera's depth comes from.
enum class DepthSource : uint8_t {
  none = 0,    ///< from motion alone
  range = 1,   ///< a range image beside each image
  stereo = 2,  ///< a second camera beside it
};

/// A camera of the robot that made the map.
struct MapCamera {
  std::string label;  ///< sensor label in the log
  CameraCalibration calibration;
  Rigid3 robot_from_camera = Rigid3::Identity();  ///< as estimated by the builder
  int mask_rows_from_top = 0;                     ///< rows that show the robot itself
  Image mask{};                                   ///< 255 where the image shows the robot itself; empty: nowhere
  DepthSource depth = DepthSource::none;

  /// Of the camera's own pixels.
  ImageMask imageMask() const { return {mask_rows_from_top, mask.view()}; }
};

/// A scene point seen from several keyframes.
struct Landmark {
  Eigen::Vector3d point_in_map = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  int observation_count = 0;
};

/// An image of the map session, reduced to what localization needs.
struct Keyframe {
  double time = 0;  ///< seconds
  int camera = 0;   ///< index into KeyframeMap::cameras
  int session = 0;  ///< number of the drive that it was taken on
  Rigid3 map_from_robot = Rigid3::Identity();
  FeatureSet features;
  std::vector<int> landmark_of_feature;  ///< index into KeyframeMap::landmarks, -1 where none; one per feature
  DenseView dense{};
  Solver solution = Solver::automatic;  ///< that suits matches with this keyframe: 1P1DP, 2DP, or automatic for both
};

/// What is kept of the places where the robot has been. Plain data; MapBuilder makes it, map_file.h stores it.
struct KeyframeMap {
  FeatureOptions feature_options;
  std::vector<MapCamera> cameras;
  std::vector<Keyframe> keyframes;
  std::vector<Landmark> landmarks;
  /// How far the keyframes' poses (x, y, phi) stand from those that they were made from: covariance in the robot frame
  /// (m, rad). Whichever of the two errs, a pose found in the map shares it, however many landmarks it rests on.
  Eigen::Matrix3d pose_covariance = Eigen::Matrix3d::Zero();
  VladVocabulary vocabulary;          ///< that describes places; none where a network does
  FeatureModel place_network;         ///< that describes places; no file where the vocabulary does
  Eigen::MatrixXf place_descriptors;  ///< one column a keyframe

  /// Whether all keyframes can be matched densely.
  bool isDense() const;

  /// Throws std::invalid_argument naming the broken entry: indices out of range, sizes that disagree or exceed their
  /// bounds, values that are not finite.
  void check() const;

  ReferenceCamera referenceCamera(const Keyframe& keyframe) const {
    const MapCamera& camera = cameras[static_cast<std::size_t>(keyframe.camera)];
    return {camera.calibration.pinhole, keyframe.map_from_robot * camera.robot_from_camera};
  }
};

}  // namespace vmcl
