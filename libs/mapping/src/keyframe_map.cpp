// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mapping/keyframe_map.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "feature_check.h"

namespace vmcl {
namespace {

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument(what);
}

void checkPose(const Rigid3& pose, const std::string& name) {
  require(pose.matrix().allFinite(), name + ": pose is not finite");
  const Eigen::Matrix3d R = pose.linear();
  require((R.transpose() * R).isIdentity(1e-6) && R.determinant() > 0, name + ": rotation is not orthonormal");
}

void checkCamera(const MapCamera& camera, const std::string& name) {
  try {
    camera.calibration.check();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(name + ": " + error.what());
  }
  checkPose(camera.robot_from_camera, name);
  require(camera.mask_rows_from_top >= 0, name + ": mask_rows_from_top is negative");
  const PinholeCamera& pinhole = camera.calibration.pinhole;
  require(
      camera.mask.view().empty() || (camera.mask.width == pinhole.width && camera.mask.height == pinhole.height &&
                                     std::ssize(camera.mask.pixels) == std::ptrdiff_t{pinhole.width} * pinhole.height),
      name + ": the mask has another size than the images");
  require(camera.depth <= DepthSource::stereo, name + ": unknown source of depth");
}

void checkCovariance(const Eigen::Matrix3d& covariance, const std::string& name) {
  require(covariance.allFinite(), name + ": covariance is not finite");
  require(covariance.isApprox(covariance.transpose(), 1e-6), name + ": covariance is not symmetric");
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance, Eigen::EigenvaluesOnly);
  require(eigen.eigenvalues()[0] >= -1e-9 * covariance.cwiseAbs().maxCoeff(),
          name + ": covariance is not positive semidefinite");
}

void checkLandmark(const Landmark& landmark, const std::string& name) {
  require(landmark.point_in_map.allFinite(), name + ": point is not finite");
  checkCovariance(landmark.covariance, name);
  require(landmark.observation_count >= 0, name + ": observation count is negative");
}

}  // namespace

void checkFeatures(const FeatureSet& features, FeatureKind kind, const std::string& name) {
  const auto finite = [](float value) { return std::isfinite(value); };
  const std::size_t count = features.pixels.size();
  require(features.kind == kind, name + ": features of another kind");
  require(
      count <= static_cast<std::size_t>(FeatureOptions::most_features),
      name + ": " + std::to_string(count) + " features, more than " + std::to_string(FeatureOptions::most_features));
  require(features.sizes.size() == count && features.responses.size() == count &&
              static_cast<std::size_t>(features.descriptors.rows()) == count,
          name + ": feature arrays differ in length");
  require(count == 0 || isDescriptorLength(kind, features.descriptors.cols()),
          name + ": descriptors have " + std::to_string(features.descriptors.cols()) + " bytes");
  require(std::ranges::all_of(features.pixels, [](const auto& pixel) { return pixel.allFinite(); }) &&
              std::ranges::all_of(features.sizes, finite) && std::ranges::all_of(features.responses, finite),
          name + ": a feature is not finite");
}

bool KeyframeMap::isDense() const {
  return std::ranges::none_of(keyframes, [](const Keyframe& keyframe) { return keyframe.dense.image.empty(); });
}

void KeyframeMap::check() const {
  feature_options.check();
  for (std::size_t i = 0; i < cameras.size(); ++i) checkCamera(cameras[i], "camera " + std::to_string(i));
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    const Keyframe& keyframe = keyframes[i];
    const std::string name = "keyframe " + std::to_string(i);
    require(std::isfinite(keyframe.time), name + ": time is not finite");
    require(keyframe.camera >= 0 && keyframe.camera < std::ssize(cameras),
            name + ": no camera " + std::to_string(keyframe.camera));
    require(keyframe.session >= 0, name + ": session is negative");
    require(keyframe.solution == Solver::automatic || keyframe.solution == Solver::one_point_one_depth ||
                keyframe.solution == Solver::two_depth,
            name + ": solution is none of auto, 1p1dp and 2dp");
    checkPose(keyframe.map_from_robot, name);
    checkFeatures(keyframe.features, feature_options.kind, name);
    const PinholeCamera& pinhole = cameras[static_cast<std::size_t>(keyframe.camera)].calibration.pinhole;
    require(keyframe.dense.depth.empty() ||
                std::ssize(keyframe.dense.depth) == DenseView::depthColumns(pinhole) * DenseView::depthRows(pinhole),
            name + ": depths for another size of image");
    require(keyframe.landmark_of_feature.size() == keyframe.features.pixels.size(),
            name + ": not one landmark entry a feature");
    for (int landmark : keyframe.landmark_of_feature)
      require(landmark >= -1 && landmark < std::ssize(landmarks), name + ": no landmark " + std::to_string(landmark));
  }
  for (std::size_t i = 0; i < landmarks.size(); ++i) checkLandmark(landmarks[i], "landmark " + std::to_string(i));
  checkCovariance(pose_covariance, "poses");
  const Eigen::MatrixXf& words = vocabulary.words();
  require(vocabulary.empty() || vocabulary.kind() == feature_options.kind, "vocabulary: words of another kind");
  require(place_descriptors.cols() == std::ssize(keyframes), "place descriptors: not one a keyframe");
  if (place_network.file.empty())
    require(place_descriptors.rows() == words.size(), "place descriptors: other size than the vocabulary's");
  else
    require(vocabulary.empty(), "place network: there is a vocabulary besides");
  require(place_descriptors.allFinite(), "place descriptors: a value is not finite");
}

}  // namespace vmcl
