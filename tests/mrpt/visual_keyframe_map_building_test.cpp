// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <filesystem>

#include "scratch_directory.h"
#include "visual_keyframe_map_fixture.h"
#include "vmcl/mapping/map_file.h"

namespace vmcl {
namespace {

TEST_F(VisualKeyframeMapTest, IsEmptyUntilFilled) {
  VisualKeyframeMap map;
  EXPECT_TRUE(map.isEmpty());
  EXPECT_EQ(map.content(), nullptr);
  EXPECT_EQ(logLikelihood(map, imageFrom(truth_), truth_), 0);
  EXPECT_FALSE(map.relocalize(imageFrom(truth_), 1).found());
}

TEST_F(VisualKeyframeMapTest, IsBuiltFromASimplemap) {
  mrpt::maps::CSimpleMap drive;
  for (int i = 0; i < 8; ++i) {
    const PlanarPose pose{0.15 * i - 0.5, 0.1 * i - 0.4, 0.03 * i};
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(CObservationImage::Create(imageFrom(pose)));
    drive.insert(mrpt::poses::CPose3DPDFGaussian::Create(mrptPose(pose)), frame);
  }
  VisualKeyframeMap map;
  map.loadFromProbabilisticPosesAndObservations(drive);
  ASSERT_FALSE(map.isEmpty());
  ASSERT_TRUE(map.content());
  EXPECT_GT(map.content()->keyframes.size(), 4U);
  EXPECT_GT(map.content()->landmarks.size(), 20U);
  expectPeakAt(truth_, map, imageFrom(truth_));
  map.clear();
  EXPECT_TRUE(map.isEmpty());
}

TEST_F(VisualKeyframeMapTest, AMapFromAFileStaysAsItIs) {
  const ScratchDirectory scratch;
  VisualMapOptions options;
  options.map_file = (scratch.path() / "room.vmap").string();
  EXPECT_THROW(VisualKeyframeMap{options}, std::runtime_error);
  saveMap(options.map_file, *content_);
  VisualKeyframeMap map(options);
  EXPECT_FALSE(map.insertObservation(imageFrom(truth_)));
  map.clear();
  ASSERT_FALSE(map.isEmpty());
  expectPeakAt(truth_, map, imageFrom(truth_));
  map.saveMetricMapRepresentationToFile((scratch.path() / "again").string());
  EXPECT_EQ(encodeMap(loadMap(scratch.path() / "again.vmap")), encodeMap(*content_));
}

TEST_F(VisualKeyframeMapTest, GivenContentIsNotLostByInserting) {
  VisualKeyframeMap given({}, content_);
  EXPECT_FALSE(given.insertObservation(imageFrom(truth_)));
  EXPECT_EQ(given.content(), content_);
  given.clear();
  EXPECT_TRUE(given.insertObservation(imageFrom(truth_)));
}

TEST_F(VisualKeyframeMapTest, OneLabelIsOneCamera) {
  VisualKeyframeMap map;
  CObservationImage image = imageFrom(truth_);
  EXPECT_TRUE(map.insertObservation(image));
  image.cameraParams.fx(image.cameraParams.fx() * 1.1);
  EXPECT_FALSE(map.insertObservation(image));
  image.sensorLabel = "rear";
  EXPECT_TRUE(map.insertObservation(image));
}

}  // namespace
}  // namespace vmcl
