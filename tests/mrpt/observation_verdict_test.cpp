// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/observation_verdict.h"

#include <gtest/gtest.h>

#include "fake_camera_map.h"
#include "filter_setup.h"

namespace vmcl {
namespace {

/// 20 matches of log likelihood `gain` each within a metre of x = 1, of -0.2 elsewhere.
FakeCameraMap imageTakenAtOne(double gain) {
  return FakeCameraMap([gain](const PlanarPose& pose) { return std::abs(pose.x - 1) < 1 ? gain : -0.2; });
}

Verdict judge(const FakeCameraMap& map, const PlanarPose& estimate, std::vector<PlanarPose> mode_poses) {
  std::vector<PoseMode> modes;
  for (const PlanarPose& pose : mode_poses) modes.push_back(mode(pose, 0.1));
  return judgeImage(map, *mrpt::obs::CObservationComment::Create(), modes, estimate);
}

TEST(ObservationVerdict, AnImageAgreesWhereItFits) {
  EXPECT_EQ(judge(imageTakenAtOne(0.5), {1, 0, 0}, {{1.1, 0, 0}}), Verdict::agrees);
  EXPECT_EQ(judge(imageTakenAtOne(0.5), {1, 0, 0}, {}), Verdict::agrees);  // nothing found, but it fits
}

TEST(ObservationVerdict, AnImageContradictsWhenItFitsElsewhere) {
  EXPECT_EQ(judge(imageTakenAtOne(0.5), {5, 0, 0}, {{1, 0, 0}}), Verdict::contradicts);
  EXPECT_EQ(judge(imageTakenAtOne(0.5), {5, 0, 0}, {{5.1, 0, 0}, {1, 0, 0}}), Verdict::contradicts);
}

TEST(ObservationVerdict, AnImageThatFitsNowhereIsSilent) {
  EXPECT_EQ(judge(imageTakenAtOne(0.05), {5, 0, 0}, {{1, 0, 0}}), Verdict::silent);
  EXPECT_EQ(judge(imageTakenAtOne(0.5), {5, 0, 0}, {}), Verdict::silent);
}

TEST(ObservationVerdict, AnImageThatFitsBetterNearbyIsSilent) {
  EXPECT_EQ(judge(imageTakenAtOne(0.5), {2.1, 0, 0}, {{1.9, 0, 0}}), Verdict::silent);
}

Verdict judgeScan(const std::function<double(const PlanarPose&)>& likelihood, const PlanarPose& estimate,
                  const PoseBox& where = box) {
  Random random(1);
  return judgeByRank(FakeMap(likelihood), *mrpt::obs::CObservationComment::Create(), PoseRegion(where), estimate,
                     random);
}

/// A tenth of a percent of the map is better than the right pose, half of it than the wrong one: of 100 poses two or
/// more and nine or fewer come with probabilities of 5e-3 and 1e-17, here by seed 1.
TEST(ObservationVerdict, AScanIsJudgedByRank) {
  const auto fits_at_origin = [](const PlanarPose& pose) { return -std::hypot(pose.x, pose.y); };
  EXPECT_EQ(judgeScan(fits_at_origin, {0.1, 0, 0}), Verdict::agrees);
  EXPECT_EQ(judgeScan(fits_at_origin, {3.2, 0, 0}), Verdict::contradicts);
}

TEST(ObservationVerdict, AScanThatFitsEverywhereTellsNothing) {
  EXPECT_EQ(judgeScan([](const PlanarPose&) { return -3; }, {0, 0, 0}), Verdict::untestable);
  EXPECT_EQ(judgeScan([](const PlanarPose& p) { return p.x; }, {0, 0, 0}, {1, 1, 1, 1}), Verdict::untestable);
}

}  // namespace
}  // namespace vmcl
