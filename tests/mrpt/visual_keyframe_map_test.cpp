// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/visual_keyframe_map.h"

#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/opengl/CPointCloud.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/serialization/CArchive.h>

#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <limits>

#include "scratch_directory.h"
#include "visual_keyframe_map_fixture.h"
#include "vmcl/mapping/map_file.h"

namespace vmcl {
namespace {

TEST_F(VisualKeyframeMapTest, IsKnownToMrpt) {
  EXPECT_NE(mrpt::rtti::findRegisteredClass("vmcl::VisualKeyframeMap"), nullptr);
  const std::unique_ptr<mrpt::maps::TMetricMapInitializer> definition(
      mrpt::maps::TMetricMapInitializer::factory("visualKeyframes"));
  ASSERT_TRUE(definition);
  mrpt::maps::TSetOfMetricMapInitializers definitions;
  definitions.push_back(
      mrpt::maps::TMetricMapInitializer::Ptr(mrpt::maps::TMetricMapInitializer::factory("vmcl::VisualKeyframeMap")));
  const mrpt::maps::CMultiMetricMap maps(definitions);
  EXPECT_TRUE(maps.mapByClass<VisualKeyframeMap>());
}

TEST_F(VisualKeyframeMapTest, LikelihoodPeaksAtTheTruth) {
  const VisualKeyframeMap map({}, content_);
  for (const PlanarPose& truth : {truth_, PlanarPose{-0.1, 0.2, 3.0}}) expectPeakAt(truth, map, imageFrom(truth));
}

TEST_F(VisualKeyframeMapTest, MatchesThatErrTogetherCountAsOneThoseThatDoNotEach) {
  VisualMapOptions apart, together;
  apart.match_correlation = 0;
  together.match_correlation = 1;
  const VisualKeyframeMap each(apart, content_), one(together, content_);
  const CObservationImage image = imageFrom(truth_);
  std::vector<double> sums(1);
  const double matches = each.addLogLikelihoods(image, {&truth_, 1}, 1, sums);
  EXPECT_GT(matches, 10);
  EXPECT_NEAR(one.addLogLikelihoods(image, {&truth_, 1}, 1, sums), 1, 1e-12);
  EXPECT_NEAR(logLikelihood(each, image, truth_), matches * logLikelihood(one, image, truth_), 1e-6);
  for (const double correlation : {-0.1, 1.1}) {
    together.match_correlation = correlation;
    EXPECT_THROW(together.check(), std::invalid_argument);
  }
}

TEST_F(VisualKeyframeMapTest, KeptMatchesAreFoundAgain) {
  const ScratchDirectory scratch;
  VisualMapOptions options;
  options.match_directory = (scratch.path() / "matches").string();
  const CObservationImage image = imageFrom(truth_);
  const double value = logLikelihood(VisualKeyframeMap(options, content_), image, truth_);
  CObservationImage dark = image;  // of this time and camera, but with nothing in it
  dark.image.filledRectangle(0, 0, static_cast<int>(dark.image.getWidth()), static_cast<int>(dark.image.getHeight()),
                             mrpt::img::TColor(0, 0, 0));
  const double of_dark = logLikelihood(VisualKeyframeMap({}, content_), dark, truth_);
  EXPECT_NE(of_dark, value);
  EXPECT_EQ(logLikelihood(VisualKeyframeMap(options, content_), dark, truth_), value);
  VisualMapOptions others = options;
  others.relocalizer.matching.max_ratio = 0.5;
  EXPECT_EQ(logLikelihood(VisualKeyframeMap(others, content_), dark, truth_), of_dark);
  for (const auto& file : std::filesystem::directory_iterator(options.match_directory))
    std::filesystem::resize_file(file, std::filesystem::file_size(file) - 8);
  EXPECT_EQ(logLikelihood(VisualKeyframeMap(options, content_), dark, truth_), of_dark);
}

TEST_F(VisualKeyframeMapTest, TheLeftImageOfAStereoCameraSaysAsMuchAsAlone) {
  const VisualKeyframeMap map({}, content_);
  const CObservationImage mono = imageFrom(truth_);
  mrpt::obs::CObservationStereoImages pair;
  pair.sensorLabel = mono.sensorLabel;
  pair.timestamp = mrpt::Clock::fromDouble(1);
  pair.imageLeft = mono.image;
  pair.leftCamera = mono.cameraParams;
  pair.cameraPose = mrpt::poses::CPose3DQuat(mono.cameraPose);
  EXPECT_TRUE(map.canComputeObservationLikelihood(pair));
  EXPECT_NE(map.computeObservationLikelihood(mono, mrpt::poses::CPose3D(mrptPose(truth_))), 0);
  EXPECT_NEAR(map.computeObservationLikelihood(pair, mrpt::poses::CPose3D(mrptPose(truth_))),
              map.computeObservationLikelihood(mono, mrpt::poses::CPose3D(mrptPose(truth_))), 1e-6);
}

TEST_F(VisualKeyframeMapTest, OtherObservationsSayNothing) {
  const VisualKeyframeMap map({}, content_);
  const mrpt::obs::CObservation2DRangeScan scan;
  EXPECT_FALSE(map.canComputeObservationLikelihood(scan));
  EXPECT_EQ(logLikelihood(map, scan, truth_), 0);
}

TEST_F(VisualKeyframeMapTest, NothingNonFiniteComesOut) {
  const VisualKeyframeMap map({}, content_);
  const CObservationImage image = imageFrom(truth_);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e300})
    EXPECT_TRUE(std::isfinite(logLikelihood(map, image, {bad, 0, 0})));
}

TEST_F(VisualKeyframeMapTest, ACameraOfTheMapKeepsItsMount) {
  const VisualKeyframeMap map({}, content_);
  CObservationImage image = imageFrom(truth_);
  image.cameraPose = mrptPose(SyntheticRoom::mount(1.0));  // as a log may wrongly say
  expectPeakAt(truth_, map, image);
  image.sensorLabel = "other";  // now the log is believed
  EXPECT_LT(logLikelihood(map, image, truth_), 5);
  EXPECT_GT(logLikelihood(map, image, truth_ * inverse(planarPart(toRigid3({0, 0, 1.0})))), 10);
}

TEST_F(VisualKeyframeMapTest, ANewImageInTheSameObjectIsSeen) {
  const VisualKeyframeMap map({}, content_);
  CObservationImage image = imageFrom(truth_);
  expectPeakAt(truth_, map, image);
  const PlanarPose next{0.3, 0, -0.1};
  image = imageFrom(next);
  expectPeakAt(next, map, image);
}

TEST_F(VisualKeyframeMapTest, ManyPosesAtOnceAsOneByOne) {
  const VisualKeyframeMap map({}, content_);
  const CObservationImage image = imageFrom(truth_);
  std::vector<PlanarPose> poses;
  Random random(1);
  for (int i = 0; i < 101; ++i) poses.push_back({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-3, 3)});
  std::vector<double> one(poses.size(), 1), three(poses.size(), 1);
  map.addLogLikelihoods(image, poses, 1, one);
  map.addLogLikelihoods(image, poses, 3, three);
  EXPECT_EQ(one, three);
  for (std::size_t i = 0; i < poses.size(); ++i) EXPECT_EQ(one[i], 1 + logLikelihood(map, image, poses[i]));
}

TEST_F(VisualKeyframeMapTest, RelocalizesByTheImageAlone) {
  const VisualKeyframeMap map({}, content_);
  const PoseEstimate estimate = map.relocalize(imageFrom(truth_), 1);
  ASSERT_TRUE(estimate.found()) << estimate.reason;
  EXPECT_NEAR(estimate.modes[0].robot_in_map.x, truth_.x, 0.03);
  EXPECT_NEAR(estimate.modes[0].robot_in_map.phi, truth_.phi, 0.01);
}

TEST_F(VisualKeyframeMapTest, BrokenImagesAreNamedAndSayNothing) {
  const VisualKeyframeMap map({}, content_);
  CObservationImage image = imageFrom(truth_);
  image.cameraParams.ncols = 100;
  EXPECT_EQ(logLikelihood(map, image, truth_), 0);
  std::vector<double> sums(1, 7);
  map.addLogLikelihoods(image, {&truth_, 1}, 1, sums);
  EXPECT_EQ(sums[0], 7);
  try {
    map.relocalize(image, 1);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("'front'"), std::string::npos) << error.what();
  }
}

TEST_F(VisualKeyframeMapTest, SurvivesAStream) {
  VisualMapOptions options;
  options.particle_sigma_px = 5.25;
  options.relocalizer.retrieved = 2;
  const VisualKeyframeMap map(options, content_);
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  archive << map;
  stream.Seek(0);
  const auto copy = std::dynamic_pointer_cast<VisualKeyframeMap>(archive.ReadObject());
  ASSERT_TRUE(copy);
  EXPECT_EQ(encodeMap(*copy->content()), encodeMap(*content_));
  EXPECT_EQ(copy->visualOptions().particle_sigma_px, 5.25);
  EXPECT_EQ(copy->visualOptions().relocalizer.retrieved, 2);
  const CObservationImage image = imageFrom(truth_);
  EXPECT_EQ(logLikelihood(*copy, image, truth_), logLikelihood(map, image, truth_));
}

TEST_F(VisualKeyframeMapTest, AMapThatCannotBeBuiltSaysNothing) {
  VisualKeyframeMap map;
  CObservationImage blank = imageFrom(truth_);
  std::vector<uint8_t> grey(blank.image.getWidth() * blank.image.getHeight(), 90);
  blank.image.loadFromMemoryBuffer(static_cast<unsigned>(blank.image.getWidth()),
                                   static_cast<unsigned>(blank.image.getHeight()), false, grey.data());
  EXPECT_TRUE(map.insertObservation(blank));
  EXPECT_THROW(map.content(), std::runtime_error);
  std::vector<double> sums(1, 7);
  EXPECT_EQ(map.addLogLikelihoods(blank, {&truth_, 1}, 1, sums), 0);
  EXPECT_EQ(sums[0], 7);
  EXPECT_EQ(logLikelihood(map, blank, truth_), 0);
}

TEST_F(VisualKeyframeMapTest, IsReadyBeforeTheFirstImageOrSaysWhyNot) {
  EXPECT_TRUE(VisualKeyframeMap({}, content_).prepare());
  EXPECT_FALSE(VisualKeyframeMap().prepare());
  VisualMapOptions dense;
  dense.relocalizer.setting = MatchSetting::dcsd;
  KeyframeMap sparse = *content_;
  for (Keyframe& keyframe : sparse.keyframes) keyframe.dense = {};
  EXPECT_THROW(VisualKeyframeMap(dense, std::make_shared<KeyframeMap>(sparse)).prepare(), std::invalid_argument);
  KeyframeMap of_network = *content_;
  of_network.feature_options.kind = FeatureKind::network;
  of_network.feature_options.model.file = "/nowhere/features.onnx";
  EXPECT_THROW(VisualKeyframeMap({}, std::make_shared<KeyframeMap>(of_network)).prepare(), std::exception);
}

#ifndef __SANITIZE_ADDRESS__  // which needs the address space that the test takes away
TEST_F(VisualKeyframeMapTest, DoesWithoutThreadsWhereThereAreNone) {
  const VisualKeyframeMap map({}, content_);
  const CObservationImage image = imageFrom(truth_);
  const std::vector<PlanarPose> poses(100, truth_);
  std::vector<double> alone(poses.size()), threaded(poses.size());
  map.addLogLikelihoods(image, poses, 1, alone);
  const auto weighWithoutMemoryForStacks = [&] {
    const rlimit none{0, 0};
    setrlimit(RLIMIT_AS, &none);
    map.addLogLikelihoods(image, poses, 8, threaded);
    _exit(threaded == alone ? 0 : 1);
  };
  EXPECT_EXIT(weighWithoutMemoryForStacks(), ::testing::ExitedWithCode(0), "");
}
#endif

TEST_F(VisualKeyframeMapTest, CountsIndependentMatches) {
  VisualMapOptions all;
  all.match_correlation = 0;
  const VisualKeyframeMap map({}, content_), undivided(all, content_);
  const CObservationImage image = imageFrom(truth_);
  std::vector<double> sums(1);
  const double matches = undivided.addLogLikelihoods(image, {&truth_, 1}, 1, sums);
  EXPECT_GT(matches, 10);
  const double expected = matches / (1 + (matches - 1) * VisualMapOptions().match_correlation);
  EXPECT_NEAR(map.addLogLikelihoods(image, {&truth_, 1}, 1, sums), expected, 1e-9);
}

TEST_F(VisualKeyframeMapTest, FewMatchesCountAsAll) {
  VisualMapOptions few, more;
  few.max_matches = 10;
  more.max_matches = 1'000'000;
  const VisualKeyframeMap all({}, content_), some(few, content_), not_so_many(more, content_);
  const CObservationImage image = imageFrom(truth_);
  const PlanarPose elsewhere{truth_.x + 1, truth_.y, truth_.phi};
  std::vector<double> of_all(1), of_some(1);
  EXPECT_EQ(all.addLogLikelihoods(image, {&truth_, 1}, 1, of_all),
            some.addLogLikelihoods(image, {&truth_, 1}, 1, of_some));
  EXPECT_NE(of_all, of_some);
  EXPECT_GT(of_some[0], logLikelihood(some, image, elsewhere));
  EXPECT_EQ(logLikelihood(not_so_many, image, truth_), of_all[0]);
  few.max_matches = -1;
  EXPECT_THROW(few.check(), std::invalid_argument);
}

TEST_F(VisualKeyframeMapTest, ShowsLandmarksAndKeyframes) {
  const VisualKeyframeMap map({}, content_);
  const auto scene = map.getVisualization();
  EXPECT_TRUE(scene->getByName("landmarks"));
  EXPECT_TRUE(scene->getByName("keyframes"));
  EXPECT_FALSE(scene->getByName("matches"));
}

TEST_F(VisualKeyframeMapTest, ShowsWhatTheLatestImageIsMatchedWith) {
  const VisualKeyframeMap map({}, content_);
  logLikelihood(map, imageFrom(truth_), truth_);
  const auto matches =
      std::dynamic_pointer_cast<mrpt::opengl::CPointCloud>(map.getVisualization()->getByName("matches"));
  ASSERT_TRUE(matches);
  EXPECT_GT(matches->size(), 10U);
}

}  // namespace
}  // namespace vmcl
