// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/relocalization/relocalizer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <map>
#include <set>

#include "scratch_directory.h"
#include "synthetic_room.h"
#include "tiny_network.h"
#include "vmcl/vision/place_network.h"

namespace vmcl {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

class RelocalizerTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { map_ = std::make_shared<const KeyframeMap>(mapOf(room_)); }
  static void TearDownTestSuite() { map_.reset(); }

  static QueryImage query(const Image& image, double mount_yaw = 0) {
    return {image.view(), SyntheticRoom::calibration(), SyntheticRoom::mount(mount_yaw), 0};
  }

  static void expectNear(const PlanarPose& pose, const PlanarPose& truth) {
    EXPECT_NEAR(pose.x, truth.x, 0.03);
    EXPECT_NEAR(pose.y, truth.y, 0.03);
    EXPECT_NEAR(wrapAngle(pose.phi - truth.phi), 0, 0.01);
  }

  /// Distance in pixels between a match with depth and its point seen from the true pose.
  static double reprojectionError(const RelocalizationResult& result, const Match& match, const PlanarPose& truth) {
    const QueryCamera& camera = result.problem.query_cameras[static_cast<std::size_t>(match.query_camera)];
    const Eigen::Vector3d point = (toRigid3(truth) * camera.robot_from_camera).inverse() * match.point->point_in_map;
    return point.z() > 0 ? (camera.camera.project(point) - match.query_pixel).norm() : 1e9;
  }

  inline static const SyntheticRoom room_;
  inline static std::shared_ptr<const KeyframeMap> map_;
  const PlanarPose truth_{0.15, -0.25, 0.12};
  const PlanarPose truth_back_{-0.1, 0.2, 3.0};
};

TEST_F(RelocalizerTest, FindsTheRobotAtEitherWall) {
  const Relocalizer relocalizer(map_, {});
  for (const PlanarPose& truth : {truth_, truth_back_}) {
    const Image image = room_.look(truth, SyntheticRoom::mount());
    const auto result = relocalizer.relocalize({{query(image)}});
    ASSERT_TRUE(result.estimate.found()) << result.estimate.reason;
    expectNear(result.estimate.modes[0].robot_in_map, truth);
    EXPECT_GT(result.estimate.modes[0].inliers.size(), 50u);
  }
}

TEST_F(RelocalizerTest, FindsTheRobotByARig) {
  const Image front = room_.look(truth_, SyntheticRoom::mount());
  const Image back = room_.look(truth_, SyntheticRoom::mount(std::numbers::pi));
  const QueryImage images[] = {query(front), query(back, std::numbers::pi)};
  const auto result = Relocalizer(map_, {}).relocalize(images);
  EXPECT_EQ(result.problem.query_cameras.size(), 2u);
  std::map<int, int> matches_of_camera;
  for (const Match& match : result.problem.matches) ++matches_of_camera[match.query_camera];
  EXPECT_GT(matches_of_camera[0], 50);
  EXPECT_GT(matches_of_camera[1], 50);
  ASSERT_TRUE(result.estimate.found());
  expectNear(result.estimate.modes[0].robot_in_map, truth_);
}

TEST_F(RelocalizerTest, FindsTheRobotByANetworkOfPlaces) {
  const ScratchDirectory scratch;
  KeyframeMap map = *map_;
  map.vocabulary = {};
  map.place_network.file = TinyNetwork(1, 48, 64, 8).writtenTo(scratch.path() / "places.onnx");
  const PlaceNetwork network(map.place_network);
  map.place_descriptors.resize(network.size(), map_->place_descriptors.cols());
  for (std::size_t i = 0; i < map.keyframes.size(); ++i)
    map.place_descriptors.col(static_cast<Eigen::Index>(i)) =
        network.describe(decompressImage(map.keyframes[i].dense.image).view(), {});
  const PlanarPose truth = planarPart(map.keyframes[5].map_from_robot);
  const Image image = room_.look(truth, SyntheticRoom::mount());
  const auto result =
      Relocalizer(std::make_shared<const KeyframeMap>(map), {.retrieved = 1, .ranked = 0}).relocalize({{query(image)}});
  EXPECT_EQ(result.keyframes, std::vector{5}) << "the same view";
  ASSERT_TRUE(result.estimate.found());
  expectNear(result.estimate.modes[0].robot_in_map, truth);
  map.place_descriptors.conservativeResize(network.size() - 1, Eigen::NoChange);
  EXPECT_THAT([&] { Relocalizer(std::make_shared<const KeyframeMap>(map), {}); },
              ThrowsMessage<std::runtime_error>(HasSubstr("places.onnx")));
}

TEST_F(RelocalizerTest, StatesAWholeProblem) {
  const Image image = room_.look(truth_, SyntheticRoom::mount());
  const auto result = Relocalizer(map_, {.retrieved = 4}).match({{query(image)}});
  EXPECT_NO_THROW(result.problem.check());
  EXPECT_FALSE(result.estimate.found());
  ASSERT_EQ(result.keyframes.size(), 4u);
  ASSERT_EQ(result.problem.reference_cameras.size(), 4u);
  EXPECT_EQ(std::set<int>(result.keyframes.begin(), result.keyframes.end()), (std::set<int>{0, 1, 2, 3}))
      << "the keyframes that look at the same wall";
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& keyframe = map_->keyframes[static_cast<std::size_t>(result.keyframes[i])];
    EXPECT_TRUE(
        result.problem.reference_cameras[i].map_from_camera.isApprox(map_->referenceCamera(keyframe).map_from_camera));
  }
  int good = 0, with_depth = 0;
  for (const Match& match : result.problem.matches) {
    if (!match.point) continue;
    ++with_depth;
    good += reprojectionError(result, match, truth_) < 4;
  }
  EXPECT_GT(with_depth, 80);
  EXPECT_GT(good, 0.8 * with_depth);
}

TEST_F(RelocalizerTest, CountsALandmarkAndAPlaceOfTheImageOnce) {
  const Image image = room_.look(truth_, SyntheticRoom::mount());
  const auto result = Relocalizer(map_, {.retrieved = 4}).match({{query(image)}});
  std::set<std::array<double, 3>> points;
  std::set<std::pair<double, double>> pixels;
  for (const Match& match : result.problem.matches) {
    EXPECT_TRUE(pixels.insert({match.query_pixel.x(), match.query_pixel.y()}).second);
    if (!match.point) continue;
    const Eigen::Vector3d& p = match.point->point_in_map;
    EXPECT_TRUE(points.insert({p.x(), p.y(), p.z()}).second);
  }
  EXPECT_GT(points.size(), 80u);
}

TEST_F(RelocalizerTest, IsNoSurerThanTheMap) {
  KeyframeMap uncertain = *map_;
  uncertain.pose_covariance = Eigen::Vector3d(4e-4, 1e-4, 9e-4).asDiagonal();
  const Image image = room_.look(truth_back_, SyntheticRoom::mount());
  const auto modeIn = [&](std::shared_ptr<const KeyframeMap> map) {
    return Relocalizer(std::move(map), {}).relocalize({{query(image)}}).estimate.modes.at(0);
  };
  const PoseMode certain = modeIn(map_), widened = modeIn(std::make_shared<const KeyframeMap>(uncertain));
  const double c = std::cos(certain.robot_in_map.phi), s = std::sin(certain.robot_in_map.phi);
  Eigen::Matrix3d expected;
  expected << 4e-4 * c * c + 1e-4 * s * s, 3e-4 * c * s, 0, 3e-4 * c * s, 4e-4 * s * s + 1e-4 * c * c, 0, 0, 0, 9e-4;
  EXPECT_TRUE((widened.covariance - certain.covariance).isApprox(expected, 1e-6));
}

TEST_F(RelocalizerTest, SharesAReferenceAmongTheImagesOfARig) {
  const Image image = room_.look(truth_, SyntheticRoom::mount());
  const QueryImage images[] = {query(image), query(image)};
  const auto result = Relocalizer(map_, {}).match(images);
  EXPECT_EQ(result.keyframes.size(), 3u);
}

TEST_F(RelocalizerTest, OnlyReliableDepthIsUsed) {
  const Image image = room_.look(truth_, SyntheticRoom::mount());
  const auto matchesWithDepth = [&](const RelocalizerOptions& options) {
    const auto result = Relocalizer(map_, options).match({{query(image)}});
    EXPECT_GT(result.problem.matches.size(), 80u);
    double farthest = 0;
    int count = 0;
    for (const Match& match : result.problem.matches)
      if (match.point) {
        const auto& reference = result.problem.reference_cameras[static_cast<std::size_t>(match.reference_camera)];
        farthest = std::max(farthest, (match.point->point_in_map - reference.map_from_camera.translation()).norm());
        ++count;
      }
    EXPECT_LE(farthest, options.reliable_depth);
    return count;
  };
  const int all = matchesWithDepth({.reliable_depth = 100});
  const int near = matchesWithDepth({.reliable_depth = 3});
  EXPECT_GT(near, 0);
  EXPECT_GT(all, near);
  EXPECT_EQ(matchesWithDepth({.reliable_depth = 0.1}), 0);
  EXPECT_EQ(matchesWithDepth({.reliable_depth = 100, .max_point_sigma = 0.0099}), 0);
  EXPECT_EQ(matchesWithDepth({.reliable_depth = 100, .max_point_sigma = 0.0101}), all);
}

TEST_F(RelocalizerTest, SameAnswerFromAnyThread) {
  const Relocalizer relocalizer(map_, {});
  const Image images[] = {room_.look(truth_, SyntheticRoom::mount()), room_.look(truth_back_, SyntheticRoom::mount())};
  const auto poses = [&](int i) { return relocalizer.relocalize({{query(images[i % 2])}}).estimate.modes.at(0); };
  const PoseMode expected[] = {poses(0), poses(1)};
  std::vector<std::future<PoseMode>> modes;
  for (int i = 0; i < 6; ++i) modes.push_back(std::async(std::launch::async, poses, i));
  for (int i = 0; i < 6; ++i) {
    const PoseMode mode = modes[static_cast<std::size_t>(i)].get();
    EXPECT_EQ(mode.robot_in_map.x, expected[i % 2].robot_in_map.x);
    EXPECT_EQ(mode.robot_in_map.phi, expected[i % 2].robot_in_map.phi);
    EXPECT_EQ(mode.covariance, expected[i % 2].covariance);
  }
}

TEST_F(RelocalizerTest, MeasuresEachStep) {
  const Image image = room_.look(truth_, SyntheticRoom::mount());
  const RelocalizationTimes times = Relocalizer(map_, {}).relocalize({{query(image)}}).times;
  for (double seconds : {times.features, times.retrieval, times.matching, times.estimation}) {
    EXPECT_GT(seconds, 0);
    EXPECT_LT(seconds, 10);
  }
}

TEST_F(RelocalizerTest, ABlankImageIsNoPlace) {
  const Image blank{320, 240, std::vector<uint8_t>(320 * 240, 90)};
  const auto result = Relocalizer(map_, {}).relocalize({{query(blank)}});
  EXPECT_TRUE(result.problem.matches.empty());
  EXPECT_FALSE(result.estimate.found());
  EXPECT_FALSE(result.estimate.reason.empty());
}

TEST_F(RelocalizerTest, RefusesBadInput) {
  const Image small{32, 24, std::vector<uint8_t>(32 * 24)};
  EXPECT_THROW(Relocalizer(map_, {}).match({{query(small)}}), std::invalid_argument);
  EXPECT_THROW(Relocalizer(nullptr, {}), std::invalid_argument);
  EXPECT_THROW(Relocalizer(std::make_shared<KeyframeMap>(), {}), std::invalid_argument);
}

TEST(RelocalizerOptionsTest, NameTheBadKey) {
  const auto refused = [](const RelocalizerOptions& options, const char* key) {
    EXPECT_THAT([&] { options.check(); }, ThrowsMessage<std::invalid_argument>(HasSubstr(key)));
  };
  refused({.retrieved = 0}, "retrieved");
  refused({.ranked = -1}, "ranked");
  refused({.reliable_depth = 0}, "reliable_depth");
  refused({.max_point_sigma = std::nan("")}, "max_point_sigma");
  refused({.matching = {.max_ratio = 2}}, "max_ratio");
  RelocalizerOptions options;
  options.estimator.iterations = 0;
  refused(options, "iterations");
}

}  // namespace
}  // namespace vmcl
