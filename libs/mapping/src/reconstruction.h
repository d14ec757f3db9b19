// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vmcl/mapping/keyframe_map.h"

namespace vmcl {

/// A feature of a keyframe that shows a scene point.
struct Observation {
  int keyframe = 0;
  int feature = 0;
};

/// Observations taken for one scene point, at most one a keyframe, by increasing keyframe.
using Track = std::vector<Observation>;

/// A track with its place in the map frame.
struct ScenePoint {
  Eigen::Vector3d point_in_map = Eigen::Vector3d::Zero();
  Track track;
};

/// Rotation by roll, pitch and yaw about the fixed x, y and z axis in this order.
inline Eigen::Matrix3d rotationFromRollPitchYaw(const Eigen::Vector3d& angles) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return (AngleAxisd(angles.z(), Vector3d::UnitZ()) * AngleAxisd(angles.y(), Vector3d::UnitY()) *
          AngleAxisd(angles.x(), Vector3d::UnitX()))
      .toRotationMatrix();
}

/// How a camera differs from what was given.
struct CameraCorrection {
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();  ///< roll, pitch, yaw about the robot axes (rad)
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();     ///< along the robot axes (m); z stays 0: driving on flat ground
                                                       ///< does not show it
  Eigen::Vector3d lens = Eigen::Vector3d::Zero();  ///< relative change of the focal lengths, change of k1 and of k2;
                                                   ///< the principal point looks like a turn of the mount
};

/// What the builder knows of the scene and of where its keyframes were taken.
struct Reconstruction {
  std::vector<MapCamera> cameras;             ///< as given
  std::vector<CameraCorrection> corrections;  ///< per camera
  std::vector<Keyframe> keyframes;            ///< with the poses as given
  std::vector<std::vector<float>> depths;     ///< per keyframe: of each feature along the axis (m), 0 where it was not
                                              ///< measured; empty where no feature's was
  std::vector<Eigen::VectorXf> places;        ///< per keyframe: what a network makes of the image; empty without one
  std::vector<PlanarPose> map_from_robot;     ///< per keyframe
  std::vector<Eigen::Vector3d> stance;        ///< per keyframe: roll and pitch (rad) and height (m) off the level
  std::vector<Rigid3> level_from_robot;       ///< per keyframe: height, roll and pitch as given, over pose and stance
  std::vector<ScenePoint> points;

  Rigid3 robotFromCamera(int camera) const {
    const auto i = static_cast<std::size_t>(camera);
    Rigid3 corrected = cameras[i].robot_from_camera;
    corrected.linear() = rotationFromRollPitchYaw(corrections[i].rotation) * corrected.linear();
    corrected.translation() += corrections[i].shift;
    return corrected;
  }

  Rigid3 pose(int keyframe) const {
    const auto k = static_cast<std::size_t>(keyframe);
    Rigid3 ground_from_level = Rigid3::Identity();
    ground_from_level.linear() = rotationFromRollPitchYaw({stance[k].x(), stance[k].y(), 0});
    ground_from_level.translation().z() = stance[k].z();
    return toRigid3(map_from_robot[k]) * ground_from_level * level_from_robot[k];
  }

  CameraCalibration calibration(int camera) const;

  ReferenceCamera view(int keyframe) const {
    const int camera = keyframes[static_cast<std::size_t>(keyframe)].camera;
    return {calibration(camera).pinhole, pose(keyframe) * robotFromCamera(camera)};
  }

  /// As measured along the optical axis (m); 0 where it was not.
  double depth(const Observation& observation) const {
    const std::vector<float>& of_keyframe = depths[static_cast<std::size_t>(observation.keyframe)];
    return of_keyframe.empty() ? 0 : of_keyframe[static_cast<std::size_t>(observation.feature)];
  }

  /// Pixel of the camera as it was given, without its distortion: as features are.
  Eigen::Vector2d givenPixel(const Observation& observation) const {
    return keyframes[static_cast<std::size_t>(observation.keyframe)]
        .features.pixels[static_cast<std::size_t>(observation.feature)]
        .cast<double>();
  }

  /// Pixel of the real image.
  Eigen::Vector2d distortedPixel(const Observation& observation) const;

  /// Ideal pixel of the camera as it is now thought to be.
  Eigen::Vector2d idealPixel(const Observation& observation) const;
};

}  // namespace vmcl
