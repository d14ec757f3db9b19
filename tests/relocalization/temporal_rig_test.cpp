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

TEST(TemporalRigTest, RefusesBadInput) {
  const auto refused = [](const TemporalRigOptions& options, const char* key) {
    EXPECT_THAT([&] { TemporalRig{options}; }, ThrowsMessage<std::invalid_argument>(HasSubstr(key)));
  };
  refused({.frames = 0}, "frames");
  refused({.min_distance = -1}, "min_distance");
  refused({.min_rotation = std::nan("")}, "min_rotation");
  EXPECT_THROW(TemporalRig({}).add(frame(0), {std::nan(""), 0, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace vmcl
