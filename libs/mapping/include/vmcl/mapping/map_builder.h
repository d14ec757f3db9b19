// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "vmcl/mapping/keyframe_map.h"
#include "vmcl/vision/depth_image.h"
#include "vmcl/vision/feature_matching.h"
#include "vmcl/vision/image.h"

namespace vmcl {

struct MapBuilderOptions {
  FeatureOptions features;
  MatchingOptions matching;
  double keyframe_distance = 0.10;  ///< a new keyframe after this way (m)
  double keyframe_rotation = 0.09;  ///< or this turn (rad)
  bool flat = true;  ///< the robot stands level at height 0; else on the heights, rolls and pitches of the given poses
  double sigma_tilt = 0.005;       ///< prior of its roll and pitch about those (rad); 0: exact
  double sigma_height = 0.003;     ///< prior of its height about that (m); 0: exact
  double sigma_px = 1.0;           ///< first guess at the standard deviation of a feature's position; residuals tell it
  double sigma_position = 0.02;    ///< prior of the given robot positions (m)
  double sigma_heading = 0.01;     ///< prior of the given robot headings (rad)
  double sigma_mount_tilt = 0.05;  ///< prior of the given mount's roll, pitch and yaw (rad); 0: mount is exact
  double sigma_mount_shift = 0.0;  ///< prior of the given mount's x and y (m); 0: exact
  double sigma_focal = 0.03;       ///< prior of the given focal lengths, relative; 0: exact
  double sigma_radial = 0.1;       ///< prior of the given radial distortion k1 and k2; 0: exact
  int words = 64;                  ///< vocabulary of place recognition
  FeatureModel place_network{};    ///< that describes places instead, if there is a file
  bool dense = false;              ///< keep the images, so that queries can be matched all over them
  uint64_t seed = 1;

  /// Throws std::invalid_argument naming the bad key.
  void check() const;
};

/// What became of the tracks, that is features of several keyframes taken for one scene point. Each of `seen` is either
/// a landmark or counted under the one reason why it is none.
struct TrackCounts {
  int seen = 0;
  int parallax = 0;      ///< seen from directions too much alike to place it
  int behind = 0;        ///< placed behind a camera
  int reprojection = 0;  ///< too few observations agree with each other
  int covariance = 0;    ///< uncertain after the adjustment by over a third of its distance
  int seen_once = 0;     ///< beside the tracks: points of one keyframe, placed by their measured depth
};

/// What building did, for people.
struct MapBuildReport {
  int keyframes = 0;
  int features = 0;
  int landmarks = 0;
  TrackCounts tracks;
  double mean_observations = 0;                   ///< per landmark seen more than once
  double sigma_px = 0;                            ///< standard deviation of a feature's coordinate, as estimated
  double shared_error = 1;                        ///< by how much less measurements counted beside the given poses,
                                                  ///< from which they led the drive away; 1: as much as noise says
  double sigma_depth = 0;                         ///< and of a measured depth at 1 m; 0: there is none
  double median_reprojection_px = 0;              ///< after adjustment
  std::vector<Eigen::Vector3d> mount_correction;  ///< per camera: roll, pitch, yaw turned about the robot axes (rad)
  std::vector<Eigen::Vector3d> mount_shift;       ///< per camera: along the robot axes (m)
  std::vector<double> focal_scale;                ///< per camera: focal length over the given one
};

/// Called with the stage's name and the share done in [0, 1].
using BuildProgress = std::function<void(std::string_view stage, double share)>;

/// Builds a map from posed images: keyframes by motion, tracks over keyframes that look at the same place,
/// triangulation, adjustment of landmarks, poses (under their priors) and the mount's tilt, the noise of features and
/// of measured depths, landmark covariances, vocabulary and place descriptors. Deterministic.
class MapBuilder {
 public:
  /// Throws std::invalid_argument for bad options or a bad camera, std::runtime_error naming a network's file that
  /// cannot be used.
  MapBuilder(std::vector<MapCamera> cameras, const MapBuilderOptions& options);
  ~MapBuilder();
  MapBuilder(MapBuilder&&) noexcept;

  /// A further camera; returns its index. Its mask is at least that of the options. Throws std::invalid_argument for a
  /// bad camera.
  int addCamera(MapCamera camera);

  /// What comes now was recorded on another drive.
  void startSession();

  /// Offers an image taken at `time` (s) by camera `camera` with the robot at map_from_robot. Returns whether it was
  /// taken as a keyframe. `depth` is what a range camera or stereo measured in the image; empty: nothing. Throws
  /// std::invalid_argument for a bad image or depth size, index or pose, std::runtime_error naming the network of
  /// features or places that cannot be used on it.
  bool add(double time, int camera, const Rigid3& map_from_robot, const ImageView& image, const DepthImage& depth = {});

  /// The same with features found elsewhere, and the measured depth of each (m, 0: none) or none at all. Throws
  /// std::invalid_argument for features of another kind, another number of depths, and where a network is to see the
  /// image, too.
  bool add(double time, int camera, const Rigid3& map_from_robot, FeatureSet features, std::vector<float> depths = {});

  /// Whether add() would take this image: the depth of another need not be measured. Throws as add() does.
  bool isNewKeyframe(double time, int camera, const Rigid3& map_from_robot) const;

  int keyframeCount() const;

  /// Consumes the keyframes. Throws std::runtime_error when there are none, or none with features.
  std::pair<KeyframeMap, MapBuildReport> build(const BuildProgress& progress = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vmcl
