// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CMetricMap.h>
#include <mrpt/maps/TMetricMapTypesRegistry.h>

#include <memory>

#include "vmcl/mapping/keyframe_map.h"
#include "vmcl/mrpt/relocalizing_map.h"
#include "vmcl/mrpt/visual_map_options.h"

namespace vmcl {

struct ImageMeasurement;

/// A keyframe map as an MRPT metric map, in an ini `visualKeyframes_count = 1`. It weighs particles by images
/// (CObservationImage, or the intensity image of CObservation3DRangeScan) wherever MRPT uses metric maps: preload
/// libvmcl-mrpt.so, or load it as a plugin. All other observations have log likelihood 0.
///
/// The content is that of map_file, which is then closed for insertion and outlives clear(); or it is given or read
/// from a stream, and closed for insertion until clear(); or it is built, at the first use, from the images inserted,
/// such as those of a CSimpleMap. What is wrong in a callback of MRPT is told on stderr, once. An image whose sensor
/// label is that of a camera of the map is taken by that camera: mount and mask come from the map.
class VisualKeyframeMap : public mrpt::maps::CMetricMap, public RelocalizingMap {
  DEFINE_SERIALIZABLE(VisualKeyframeMap, vmcl)

 public:
  VisualKeyframeMap();

  /// Loads map_file, if any. Throws std::runtime_error naming the file, std::invalid_argument naming a bad option.
  explicit VisualKeyframeMap(const VisualMapOptions& options);

  /// With this content; map_file is not read.
  VisualKeyframeMap(const VisualMapOptions& options, std::shared_ptr<const KeyframeMap> content);

  ~VisualKeyframeMap() override;
  VisualKeyframeMap(const VisualKeyframeMap& other);
  VisualKeyframeMap& operator=(const VisualKeyframeMap& other);

  /// The content, built from the inserted images where need be; null when there is none. Throws std::runtime_error when
  /// it cannot be built.
  std::shared_ptr<const KeyframeMap> content() const;
  /// Gets ready for the first image, which does it otherwise; false when the map is empty. Throws std::exception for
  /// content that cannot be built or does not suit the options, and for networks that cannot be read.
  bool prepare() const;
  const VisualMapOptions& visualOptions() const { return options_; }

  double addLogLikelihoods(const mrpt::obs::CObservation& observation, std::span<const PlanarPose> robot_in_map,
                           int threads, std::span<double> log_likelihoods) const override;
  PoseEstimate relocalize(const mrpt::obs::CObservation& observation, uint64_t seed) const override;
  void expect(const mrpt::obs::CObservation& observation, const PoseWithCovariance& robot) const override;
  void extend(PoseBox& box) const override;

  bool isEmpty() const override;
  std::string asString() const override;

  /// `prefix`.vmap. Throws std::runtime_error naming the file.
  void saveMetricMapRepresentationToFile(const std::string& prefix) const override;

  /// Landmarks as points, those that the latest image is matched with as larger ones, keyframes as their cameras'
  /// views.
  void getVisualizationInto(mrpt::opengl::CSetOfObjects& objects) const override;

  MAP_DEFINITION_START(VisualKeyframeMap)
  VisualMapOptions options;
  MAP_DEFINITION_END(VisualKeyframeMap)

 private:
  struct State;

  /// For callbacks of MRPT, where an exception would end the program: null, and a line on stderr, instead.
  std::shared_ptr<const KeyframeMap> contentOrReport() const;

  /// What the latest image said; null before the first.
  std::shared_ptr<const ImageMeasurement> latestMeasurement() const;

  void internal_clear() override;
  bool internal_insertObservation(const mrpt::obs::CObservation& observation,
                                  const std::optional<const mrpt::poses::CPose3D>& robot_in_map) override;
  double internal_computeObservationLikelihood(const mrpt::obs::CObservation& observation,
                                               const mrpt::poses::CPose3D& robot_in_map) const override;
  bool internal_canComputeObservationLikelihood(const mrpt::obs::CObservation& observation) const override;

  VisualMapOptions options_;
  std::unique_ptr<State> state_;
};

}  // namespace vmcl
