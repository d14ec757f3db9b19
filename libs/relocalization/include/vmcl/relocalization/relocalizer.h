// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vmcl/estimation/estimator.h"
#include "vmcl/mapping/keyframe_map.h"
#include "vmcl/vision/feature_matching.h"
#include "vmcl/vision/image.h"

namespace vmcl {

/// How many matches an image has with a keyframe and how many of these have depth (Jiao et al. 2020, section IV-C).
enum class MatchSetting {
  scsd,  ///< features, depth at landmarks
  dcsd,  ///< points anywhere besides, depth at landmarks: needs a dense map
  dcdd,  ///< the same with depth as measured, or as interpolated between landmarks where the map has none measured
};

/// "scsd", "dcsd" or "dcdd", and back. Throws std::invalid_argument naming any other word.
std::string_view nameOf(MatchSetting setting);
MatchSetting matchSettingFromName(std::string_view name);

struct RelocalizerOptions {
  MatchingOptions matching{};
  MatchSetting setting = MatchSetting::scsd;
  std::string dense_network{};  ///< ONNX file of a network that finds the dense matches, see MatchNetwork; empty: none
  int retrieved = 3;            ///< reference keyframes per image (the paper's 3)
  int ranked = 20;              ///< most alike keyframes, from which those are chosen that match best; none more than
                                ///< `retrieved`: these are the most alike
  /// Landmarks farther from the reference than this (m; the paper: 5) give 2D-2D matches. Far and uncertain ones are of
  /// use, since each carries its covariance; as 2D-2D matches they would be taken to be as near as the others.
  double reliable_depth = 100;
  double max_point_sigma = 10;  ///< and so do landmarks less certain than this (m, largest axis)
  /// Floors and tyres give a little. Place recognition may name places where the robot is not, and things that look
  /// alike agree on more than chance would: hence the evidence asked for.
  EstimatorOptions estimator{
      .likelihood = {.sigma_px = 1}, .plane = {.sigma_tilt = 0.005, .sigma_height = 0.003}, .in_sight_log_odds = -9};
  /// Whether samples are drawn as the map's keyframes say (chosenSolution), not as estimator.solver does.
  bool solution_of_map = false;

  /// Throws std::invalid_argument naming the bad key.
  void check() const;
};

/// An image of the robot that is to be localized.
struct QueryImage {
  ImageView image;
  CameraCalibration calibration;
  Rigid3 robot_from_camera = Rigid3::Identity();
  ImageMask mask{};
};

/// Where the robot is believed to be before its images are looked at.
struct ExpectedPose {
  PlanarPose robot_in_map;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of x, y (m), phi (rad), in the map frame

  /// Throws std::invalid_argument for what is not finite, or not symmetric and positive semidefinite.
  void check() const;
};

/// Seconds spent in each step.
struct RelocalizationTimes {
  double features = 0;
  double retrieval = 0;
  double matching = 0;
  double estimation = 0;
};

struct RelocalizationResult {
  PoseProblem problem;         ///< the matches that the estimate rests on
  std::vector<int> keyframes;  ///< of the map, one per reference camera of the problem
  PoseEstimate estimate;
  RelocalizationTimes times;
};

/// estimatePose with the covariance of each mode widened by that of the map's poses, which all matches share.
PoseEstimate estimatePose(const PoseProblem& problem, const KeyframeMap& map, const EstimatorOptions& options);

/// The same from matches with keyframes, whose solution may choose the solver.
PoseEstimate estimatePose(const RelocalizationResult& matched, const KeyframeMap& map,
                          const RelocalizerOptions& options);

/// Finds the robot in the map from its images alone: features, place recognition, matching, estimation. Thread safe.
class Relocalizer {
 public:
  /// Throws std::invalid_argument for bad options, an empty map, or one that is not dense though the setting is;
  /// std::runtime_error naming a network, of the map or of dense matches, when it cannot be used.
  Relocalizer(std::shared_ptr<const KeyframeMap> map, const RelocalizerOptions& options);
  ~Relocalizer();

  const KeyframeMap& map() const;
  const RelocalizerOptions& options() const;

  /// Features, retrieval and matching only; `estimate` stays empty. Throws std::invalid_argument for a malformed
  /// image, std::runtime_error naming a network that fails.
  RelocalizationResult match(std::span<const QueryImage> images) const;

  /// Looks for the landmarks that keyframes about the expected pose show where the images should show them; where that
  /// gives no pose, for the robot may be elsewhere, does as match(images). Faster, and with more right matches. The
  /// others agree with the expected pose, too, which their odds allow for: outliers lie the more densely the smaller
  /// the area is that a feature was sought in. The expected pose is taken to be known to 0.1 m and 2 deg at best.
  /// Features alone are matched so, with setting scsd; the others do as match(images).
  RelocalizationResult match(std::span<const QueryImage> images, const ExpectedPose& expected) const;

  /// match(images) and the estimate.
  RelocalizationResult relocalize(std::span<const QueryImage> images) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vmcl
