// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/relocalization/temporal_rig.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vmcl {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A frame of one camera at the robot's centre with a match with each of two keyframes.
RelocalizationResult frame(int first_keyframe) {
  RelocalizationResult result;
  result.problem.query_cameras.push_back({{640, 480, 500, 500, 320, 240}, Rigid3::Identity()});
  for (int i = 0; i < 2; ++i) {
    result.keyframes.push_back(first_keyframe + i);
    ReferenceCamera reference{{640, 480, 500, 500, 320, 240}, Rigid3::Identity()};
    reference.map_from_camera.translation().x() = first_keyframe + i;
    result.problem.reference_cameras.push_back(reference);
    Match match;
    match.reference_camera = i;
    match.query_pixel = {first_keyframe, i};
    match.point = MapPoint{{0, 3, 1}, 0.0004 * Eigen::Matrix3d::Identity()};
    result.problem.matches.push_back(match);
  }
  return result;
}

TEST(TemporalRigTest, MountsEarlierCamerasWhereTheyWere) {
  TemporalRig rig({});
  rig.add(frame(0), {1, 2, 0});
  const auto joined = rig.add(frame(1), {1, 3, std::numbers::pi / 2});
  EXPECT_NO_THROW(joined.problem.check());
  EXPECT_THAT(joined.keyframes, ElementsAre(1, 2, 0));
  ASSERT_EQ(joined.problem.query_cameras.size(), 2u);
  EXPECT_TRUE(joined.problem.query_cameras[0].robot_from_camera.isApprox(Rigid3::Identity()));
  const Rigid3& earlier = joined.problem.query_cameras[1].robot_from_camera;
  EXPECT_TRUE(earlier.isApprox(toRigid3({-1, 0, -std::numbers::pi / 2}))) << earlier.matrix();
  ASSERT_EQ(joined.problem.matches.size(), 4u);
  for (const Match& match : joined.problem.matches) {
    const auto& reference = joined.problem.reference_cameras[static_cast<std::size_t>(match.reference_camera)];
    EXPECT_EQ(match.query_camera, match.query_pixel.x() == 0 ? 1 : 0);
    EXPECT_EQ(reference.map_from_camera.translation().x(), match.query_pixel.sum());
  }
}

TEST(TemporalRigTest, JoinsFramesApartAlone) {
  const auto cameras = [](const TemporalRigOptions& options, const PlanarPose& step, int count) {
    TemporalRig rig(options);
    PlanarPose pose{};
    std::vector<std::size_t> sizes;
    for (int i = 0; i < count; ++i, pose = pose * step)
      sizes.push_back(rig.add(frame(0), pose).problem.query_cameras.size());
    return sizes;
  };
  EXPECT_THAT(cameras({}, {0.26, 0, 0}, 7), ElementsAre(1, 2, 3, 4, 5, 5, 5));
  EXPECT_THAT(cameras({}, {0, 0, 21 * degree}, 3), ElementsAre(1, 2, 3));
  EXPECT_THAT(cameras({}, {0.13, 0, 9 * degree}, 5), ElementsAre(1, 1, 2, 2, 3));
  EXPECT_THAT(cameras({}, {0, 0, 0}, 4), ElementsAre(1, 1, 1, 1));
  EXPECT_THAT(cameras({.frames = 2}, {1, 0, 0}, 4), ElementsAre(1, 2, 2, 2));
  EXPECT_THAT(cameras({.frames = 1}, {1, 0, 0}, 3), ElementsAre(1, 1, 1));
}

TEST(TemporalRigTest, EarlierPointsAreAsUncertainAsOdometry) {
  const RelocalizationResult seen = frame(0);
  TemporalRig rig({.shift_noise = 0.1, .drift_noise = 0.2, .turn_noise = 0.3});
  rig.add(seen, {0, 0, 0});
  rig.add(seen, {0.5, 0, 0});
  const auto joined = rig.add(seen, {0.5, 0, -0.4});  // 0.5 m and 0.4 rad after the first frame
  ASSERT_EQ(joined.problem.query_cameras.size(), 3u);
  const auto variance = [](double position, double heading) -> Eigen::Vector3d {
    return Eigen::Vector3d(0.0004, 0.0004, 0.0004) +
           (position * position + 9 * heading * heading) * Eigen::Vector3d(1, 1, 0);
  };
  const Eigen::Vector3d expected[] = {variance(0, 0), variance(0, 0.12), variance(0.05, std::hypot(0.1, 0.12))};
  for (const Match& match : joined.problem.matches) {
    if (match.reference_camera != 0) continue;  // the other stands elsewhere
    const Eigen::Matrix3d covariance = expected[match.query_camera].asDiagonal();
    EXPECT_TRUE(match.point->covariance.isApprox(covariance, 1e-9)) << match.point->covariance;
  }
}

// 100 points, of which 30 are expected to be inliers: each is as unsure as makes the 30 together as sure as one was.
TEST(TemporalRigTest, ManyPointsDoNotAverageTheErrorOfOdometryAway) {
  const auto addedVariance = [](int points) {
    RelocalizationResult seen = frame(0);
    const Match match = seen.problem.matches[0];
    seen.problem.matches.assign(static_cast<std::size_t>(points), match);
    TemporalRig rig({});
    rig.add(seen, {0, 0, 0});
    return rig.add(seen, {0.5, 0, 0}).problem.matches.back().point->covariance(0, 0) - match.point->covariance(0, 0);
  };
  EXPECT_NEAR(addedVariance(100), 30 * addedVariance(1), 1e-9);
}

TEST(TemporalRigTest, MatchesWithoutDepthAreOfTheNewestFrameAlone) {
  RelocalizationResult seen = frame(0);
  seen.problem.matches[0].point.reset();
  TemporalRig rig({});
  rig.add(seen, {0, 0, 0});
  const auto joined = rig.add(seen, {0.5, 0, 0});
  ASSERT_EQ(joined.problem.matches.size(), 3u);
  for (const Match& match : joined.problem.matches) EXPECT_TRUE(match.point || match.query_camera == 0);
}

TEST(TemporalRigTest, RefusesBadInput) {
  const auto refused = [](const TemporalRigOptions& options, const char* key) {
    EXPECT_THAT([&] { TemporalRig{options}; }, ThrowsMessage<std::invalid_argument>(HasSubstr(key)));
  };
  refused({.frames = 0}, "frames");
  refused({.min_distance = -1}, "min_distance");
  refused({.min_rotation = std::nan("")}, "min_rotation");
  refused({.shift_noise = -1}, "shift_noise");
  refused({.drift_noise = -1}, "drift_noise");
  refused({.turn_noise = std::nan("")}, "turn_noise");
  EXPECT_THROW(TemporalRig({}).add(frame(0), {std::nan(""), 0, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace vmcl
