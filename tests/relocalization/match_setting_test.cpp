// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scratch_directory.h"
#include "synthetic_room.h"
#include "tiny_network.h"
#include "vmcl/relocalization/relocalizer.h"

namespace vmcl {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

class MatchSettingTest : public testing::Test {
 protected:
  RelocalizationResult relocalize(MatchSetting setting, const KeyframeMap& map) const {
    const QueryImage query{image_.view(), SyntheticRoom::calibration(), SyntheticRoom::mount()};
    return Relocalizer(std::make_shared<const KeyframeMap>(map), {.setting = setting}).relocalize({{query}});
  }

  /// How many matches have depth, and the share of these whose point the true pose shows within 4 pixels.
  static std::pair<int, double> depthsOf(const RelocalizationResult& result) {
    int with_depth = 0, good = 0;
    for (const Match& match : result.problem.matches) {
      if (!match.point) continue;
      ++with_depth;
      const Eigen::Vector3d point = (toRigid3(truth_) * SyntheticRoom::mount()).inverse() * match.point->point_in_map;
      good += (SyntheticRoom::calibration().pinhole.project(point) - match.query_pixel).norm() < 4;
    }
    return {with_depth, static_cast<double>(good) / with_depth};
  }

  static void expectFound(const RelocalizationResult& result) {
    EXPECT_NO_THROW(result.problem.check());
    ASSERT_TRUE(result.estimate.found());
    const PlanarPose& pose = result.estimate.modes[0].robot_in_map;
    EXPECT_NEAR(pose.x, truth_.x, 0.05);
    EXPECT_NEAR(pose.y, truth_.y, 0.05);
    EXPECT_NEAR(wrapAngle(pose.phi - truth_.phi), 0, 0.01);
  }

  static constexpr PlanarPose truth_{0.15, -0.25, 0.12};
  const SyntheticRoom room_;
  const KeyframeMap map_ = [this] {
    KeyframeMap map = mapOf(room_);
    map.feature_options.max_features = 60;  // of the query: leaves most of the image to dense matches
    for (Keyframe& keyframe : map.keyframes)
      for (std::size_t i = 0; i < keyframe.landmark_of_feature.size(); ++i)
        if (i % 2 != 0) keyframe.landmark_of_feature[i] = -1;  // and most of that to matches without depth
    return map;
  }();
  const Image image_ = room_.look(truth_, SyntheticRoom::mount());
};

TEST_F(MatchSettingTest, DenserSettingsMatchMore) {
  const auto scsd = relocalize(MatchSetting::scsd, map_), dcsd = relocalize(MatchSetting::dcsd, map_),
             dcdd = relocalize(MatchSetting::dcdd, map_);
  for (const auto& result : {scsd, dcsd, dcdd}) {
    expectFound(result);
    EXPECT_GT(depthsOf(result).second, 0.8);
  }
  EXPECT_GT(dcsd.problem.matches.size(), scsd.problem.matches.size() + 30);
  EXPECT_GE(depthsOf(dcsd).first, depthsOf(scsd).first);
  EXPECT_GT(depthsOf(dcdd).first, depthsOf(dcsd).first + 10);
}

TEST_F(MatchSettingTest, DepthComesFromLandmarksWhereItWasNotMeasured) {
  KeyframeMap map = map_;
  for (Keyframe& keyframe : map.keyframes) keyframe.dense.depth.clear();
  const auto dcsd = relocalize(MatchSetting::dcsd, map), dcdd = relocalize(MatchSetting::dcdd, map);
  expectFound(dcdd);
  EXPECT_GT(depthsOf(dcdd).first, depthsOf(dcsd).first + 10);
  EXPECT_GT(depthsOf(dcdd).second, 0.8);
}

TEST_F(MatchSettingTest, NeedsADenseMap) {
  KeyframeMap map = map_;
  map.keyframes[3].dense = {};
  EXPECT_NO_THROW(relocalize(MatchSetting::scsd, map));
  for (const MatchSetting setting : {MatchSetting::dcsd, MatchSetting::dcdd})
    EXPECT_THAT([&] { relocalize(setting, map); }, ThrowsMessage<std::invalid_argument>(HasSubstr("--dense")));
}

// This network names places on the image's diagonal, as far along it as the query is bright.
TEST_F(MatchSettingTest, ANetworkMayFindDenseMatches) {
  const ScratchDirectory scratch;
  RelocalizerOptions options{.setting = MatchSetting::dcsd};
  options.dense_network = TinyNetwork::ofTwoImages(1, 240, 320, 8).writtenTo(scratch.path() / "dense.onnx");
  const auto map = std::make_shared<const KeyframeMap>(map_);
  const QueryImage query{image_.view(), SyntheticRoom::calibration(), SyntheticRoom::mount()};
  const auto matched = Relocalizer(map, options).match({{query}});
  const auto features = Relocalizer(map, {}).match({{query}});
  std::size_t on_the_diagonal = 0;
  for (const Match& match : matched.problem.matches)
    on_the_diagonal += std::abs(match.query_pixel.y() + 0.5 - 0.75 * (match.query_pixel.x() + 0.5)) < 1e-3;
  EXPECT_GT(on_the_diagonal, 2u);
  EXPECT_EQ(matched.problem.matches.size(), features.problem.matches.size() + on_the_diagonal);
  options.setting = MatchSetting::scsd;
  EXPECT_THAT([&] { Relocalizer(map, options); }, ThrowsMessage<std::invalid_argument>(HasSubstr("dense_network")));
  options.setting = MatchSetting::dcsd;
  options.dense_network = (scratch.path() / "absent.onnx").string();
  EXPECT_THAT([&] { Relocalizer(map, options); }, ThrowsMessage<std::runtime_error>(HasSubstr("absent.onnx")));
}

TEST_F(MatchSettingTest, RefusesAMapWhoseImagesAreBroken) {
  KeyframeMap map = map_;
  for (Keyframe& keyframe : map.keyframes) keyframe.dense.image = {1, 2, 3};
  EXPECT_THROW(relocalize(MatchSetting::dcsd, map), std::runtime_error);
  const Image small{32, 24, std::vector<uint8_t>(32 * 24)};
  for (Keyframe& keyframe : map.keyframes) keyframe.dense.image = compressImage(small.view());
  EXPECT_THAT([&] { relocalize(MatchSetting::dcsd, map); },
              ThrowsMessage<std::runtime_error>(HasSubstr("another size")));
}

TEST(MatchSettingNameTest, GoesBothWays) {
  for (const MatchSetting setting : {MatchSetting::scsd, MatchSetting::dcsd, MatchSetting::dcdd})
    EXPECT_EQ(matchSettingFromName(nameOf(setting)), setting);
  EXPECT_THROW(matchSettingFromName("dense"), std::invalid_argument);
}

}  // namespace
}  // namespace vmcl
