// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>

#include "synthetic_room.h"
#include "vmcl/relocalization/relocalizer.h"

namespace vmcl {
namespace {

class ExpectedPoseTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { map_ = std::make_shared<const KeyframeMap>(mapOf(room_)); }
  static void TearDownTestSuite() { map_.reset(); }

  static ExpectedPose about(const PlanarPose& pose, double sigma = 0.1) {
    return {pose, Eigen::Vector3d(sigma * sigma, sigma * sigma, 1e-3).asDiagonal()};
  }

  /// Matches with depth whose point the true pose shows within 3 pixels.
  static int rightMatches(const PoseProblem& problem) {
    int right = 0;
    for (const Match& match : problem.matches) {
      if (!match.point) continue;
      const Eigen::Vector3d point = (toRigid3(truth_) * SyntheticRoom::mount()).inverse() * match.point->point_in_map;
      right += (SyntheticRoom::calibration().pinhole.project(point) - match.query_pixel).norm() < 3;
    }
    return right;
  }

  static double greatestOdds(const PoseProblem& problem) {
    double greatest = 0;
    for (const Match& match : problem.matches) greatest = std::max(greatest, match.inlier_odds);
    return greatest;
  }

  static constexpr PlanarPose truth_{0.15, -0.25, 0.12};
  inline static const SyntheticRoom room_;
  inline static std::shared_ptr<const KeyframeMap> map_;
  const Relocalizer relocalizer_{map_, {}};
  const Image image_ = room_.look(truth_, SyntheticRoom::mount());
  const QueryImage query_{image_.view(), SyntheticRoom::calibration(), SyntheticRoom::mount()};
};

TEST_F(ExpectedPoseTest, BringsMoreRightMatchesAndNoWrongPose) {
  const auto anywhere = relocalizer_.match({{query_}});
  const auto near = relocalizer_.match({{query_}}, about({0.25, -0.33, 0.16}));
  near.problem.check();
  EXPECT_GT(rightMatches(near.problem), rightMatches(anywhere.problem));
  EXPECT_EQ(near.keyframes.size(), near.problem.reference_cameras.size());
  ASSERT_TRUE(near.estimate.found());
  const PlanarPose& pose = near.estimate.modes[0].robot_in_map;
  EXPECT_NEAR(pose.x, truth_.x, 0.03);
  EXPECT_NEAR(pose.y, truth_.y, 0.03);
  EXPECT_NEAR(pose.phi, truth_.phi, 0.01);
}

TEST_F(ExpectedPoseTest, DoesNotKeepTheRobotWhereItIsNot) {
  const auto anywhere = relocalizer_.match({{query_}});
  for (const PlanarPose& wrong : {PlanarPose{-0.1, 0.2, 3}, {1.5, 1, 0.12}, {0.15, -0.25, 1}, {1e6, 0, 0}}) {
    const auto matched = relocalizer_.match({{query_}}, about(wrong));
    EXPECT_EQ(matched.keyframes, anywhere.keyframes) << wrong.x << ' ' << wrong.phi;
    EXPECT_EQ(matched.problem.matches.size(), anywhere.problem.matches.size());
  }
}

TEST_F(ExpectedPoseTest, AMatchThatWasSoughtInASmallAreaTellsLess) {
  const auto narrow = relocalizer_.match({{query_}}, about(truth_)).problem;
  const auto wide = relocalizer_.match({{query_}}, about(truth_, 0.5)).problem;
  EXPECT_LT(greatestOdds(narrow), 0.5 * greatestOdds(wide));
  EXPECT_LT(greatestOdds(wide), greatestOdds(relocalizer_.match({{query_}}).problem));
}

TEST_F(ExpectedPoseTest, IsOfNoMatterToDenseSettings) {
  const Relocalizer dense(map_, {.setting = MatchSetting::dcsd});
  EXPECT_EQ(dense.match({{query_}}, about(truth_)).problem.matches.size(),
            dense.match({{query_}}).problem.matches.size());
}

TEST_F(ExpectedPoseTest, IsRefusedWhenItIsNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refuses = [&](const ExpectedPose& bad) {
    EXPECT_THROW(relocalizer_.match({{query_}}, bad), std::invalid_argument);
  };
  refuses(about({nan, 0, 0}));
  refuses(about(truth_, nan));
  refuses({truth_, -Eigen::Matrix3d::Identity()});
  Eigen::Matrix3d askew = Eigen::Matrix3d::Identity();
  askew(0, 1) = 0.5;
  refuses({truth_, askew});
  const Image blank{320, 240, std::vector<uint8_t>(320 * 240, 90)};
  const QueryImage nothing{blank.view(), SyntheticRoom::calibration(), SyntheticRoom::mount()};
  EXPECT_TRUE(relocalizer_.match({{nothing}}, about(truth_)).problem.matches.empty());
}

}  // namespace
}  // namespace vmcl
