// SPDX-License-Identifier: BSD-3-Clause
// PoseLikelihood::evaluate against the likelihood of one pose, on every instruction set that this machine has.
#include "vmcl/geometry/instruction_sets.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "random_scene.h"
#include "vmcl/estimation/estimator.h"
#include "vmcl/estimation/likelihood.h"
#include "vmcl/estimation/pose_refiner.h"

namespace vmcl {
namespace {

constexpr double tolerance = 1e-4;

class ManyPoses : public testing::TestWithParam<int64_t> {
 protected:
  void SetUp() override { useTargets(GetParam()); }
  void TearDown() override { useTargets(0); }

  static void useTargets(int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

std::vector<PlanarTransform> posesAround(const PlanarPose& truth, Random& random, int count) {
  std::vector<PlanarTransform> poses{PlanarTransform(truth)};
  while (static_cast<int>(poses.size()) < count) {
    const double reach = std::pow(10, random.uniform(-4, 1.5));
    poses.emplace_back(PlanarPose{truth.x + reach * random.normal(), truth.y + reach * random.normal(),
                                  truth.phi + 0.3 * reach * random.normal()});
  }
  return poses;
}

/// In units of the information, or of 0.1 m and 0.1 rad where there is less; to what single precision gives.
void expectSameSlopes(const PoseLikelihood& likelihood, const std::vector<PlanarTransform>& poses) {
  constexpr double slope_tolerance = 0.02;
  const PoseRefiner refiner(likelihood, {});
  std::vector<PlanarSlope> slopes(poses.size());
  refiner.linearize(poses, slopes);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    RefinedPose pose;
    pose.map_from_robot = poses[k].pose();
    const PoseRefiner::Linearization exact = refiner.linearize(pose);
    EXPECT_NEAR(slopes[k].log_likelihood, likelihood(poses[k]), tolerance) << "pose " << k;
    const Eigen::Vector3d unit = (exact.information.diagonal().head<3>().array() + 100).sqrt();
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(slopes[k].gradient[i] / unit[i], exact.gradient[i] / unit[i],
                  slope_tolerance * (1 + std::abs(exact.gradient[i]) / unit[i]))
          << "pose " << k;
      for (int j = 0; j < 3; ++j)
        EXPECT_NEAR(slopes[k].information(i, j) / (unit[i] * unit[j]), exact.information(i, j) / (unit[i] * unit[j]),
                    slope_tolerance)
            << "pose " << k;
    }
  }
}

void expectSameAsOneByOne(const PoseLikelihood& likelihood, const std::vector<PlanarTransform>& poses) {
  std::vector<double> values(poses.size());
  likelihood.evaluate(poses, values);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    EXPECT_TRUE(std::isfinite(values[k]));
    EXPECT_NEAR(values[k], likelihood(poses[k]), tolerance) << "pose " << k;
  }
  expectSameSlopes(likelihood, poses);
}

/// Anisotropic, as triangulation gives it, or not of full rank.
void spreadPoints(Scene& scene, Random& random) {
  for (Match& match : scene.problem.matches) {
    if (!match.point) continue;
    Eigen::Matrix3d root = Eigen::Matrix3d::Zero();
    const int rank = static_cast<int>(random.below(4));
    for (int k = 0; k < rank; ++k)
      for (int i = 0; i < 3; ++i) root(i, k) = std::pow(10, random.uniform(-4, -0.5)) * random.normal();
    match.point->covariance = root * root.transpose();
  }
}

void moveMap(Scene& scene, const Eigen::Vector3d& by) {
  scene.map_from_robot.x += by.x();
  scene.map_from_robot.y += by.y();
  for (ReferenceCamera& reference : scene.problem.reference_cameras) reference.map_from_camera.pretranslate(by);
  for (Match& match : scene.problem.matches)
    if (match.point) match.point->point_in_map += by;
}

// No chance is involved in the outcome but that rounding adds up: 50 times the usual error would be needed. Seed 51.
TEST_P(ManyPoses, AgreeWithOneByOne) {
  Random random(51);
  for (int trial = 0; trial < 60; ++trial) {
    Scene scene = randomScene(random, {.cameras = 1 + trial % 3,
                                       .matches = 200,
                                       .outlier_rate = random.uniform(0, 0.9),
                                       .depth_rate = 0.5 * (trial % 3),
                                       .noise_px = random.uniform(0, 3),
                                       .point_sigma = 0.02});
    if (trial % 2) spreadPoints(scene, random);
    const LikelihoodOptions options{.sigma_px = random.uniform(0.5, 8), .inlier_prior = random.uniform(0.05, 0.95)};
    const PoseLikelihood likelihood(scene.problem, options);
    expectSameAsOneByOne(likelihood, posesAround(scene.map_from_robot, random, 37));
  }
}

TEST_P(ManyPoses, AnyOdds) {
  Random random(59);
  Scene scene = randomScene(random, {.matches = 100, .outlier_rate = 0.5, .noise_px = 2, .point_sigma = 0.02});
  for (Match& match : scene.problem.matches) match.inlier_odds = std::pow(10, random.uniform(-3, 3));
  expectSameAsOneByOne(PoseLikelihood(scene.problem, {}), posesAround(scene.map_from_robot, random, 50));
}

// Several references for one query camera, and matches of one camera of the robot with the reference of another.
TEST_P(ManyPoses, AnyPairOfCameras) {
  Random random(52);
  for (int trial = 0; trial < 20; ++trial) {
    Scene scene = randomScene(random, {.cameras = 3, .matches = 60, .depth_rate = 0.5, .noise_px = 2});
    for (Match& match : scene.problem.matches) match.reference_camera = static_cast<int>(random.below(3));
    expectSameAsOneByOne(PoseLikelihood(scene.problem, {}), posesAround(scene.map_from_robot, random, 50));
  }
}

TEST_P(ManyPoses, FarFromTheOriginOfTheMap) {
  Random random(53);
  for (const double distance : {1e3, 1e5, 1e7}) {
    Scene scene = randomScene(random, {.matches = 100, .noise_px = 2, .point_sigma = 0.02});
    moveMap(scene, {distance, -distance, 0});
    expectSameAsOneByOne(PoseLikelihood(scene.problem, {}), posesAround(scene.map_from_robot, random, 40));
  }
}

// Where single precision fails the same values come another way.
TEST_P(ManyPoses, ExtremeNumbers) {
  Random random(54);
  Scene scene = randomScene(random, {.matches = 50, .noise_px = 0.01});
  for (const double sigma_px : {1e-150, 1e-9, 0.003, 0.01, 0.1, 100.0, 1e4, 1e30, 1e150})
    expectSameAsOneByOne(PoseLikelihood(scene.problem, {.sigma_px = sigma_px}),
                         posesAround(scene.map_from_robot, random, 20));
  for (const double inlier_prior : {1e-300, 1e-9, 1 - 1e-9})
    expectSameAsOneByOne(PoseLikelihood(scene.problem, {.inlier_prior = inlier_prior}),
                         posesAround(scene.map_from_robot, random, 20));
  scene.problem.matches[0].point = MapPoint{{1e120, 0, 1}, Eigen::Matrix3d::Identity()};
  expectSameAsOneByOne(PoseLikelihood(scene.problem, {}), posesAround(scene.map_from_robot, random, 20));
  scene.problem.matches[0].point = MapPoint{{1, 0, 1}, 1e200 * Eigen::Matrix3d::Identity()};
  expectSameAsOneByOne(PoseLikelihood(scene.problem, {}), posesAround(scene.map_from_robot, random, 20));
}

// L is continuous where points come near to the camera: rounding cannot make it jump.
TEST_P(ManyPoses, PointsBesideTheCamera) {
  PoseProblem problem;
  Rigid3 mount = Rigid3::Identity();
  mount.linear() = opticalAxes();
  problem.query_cameras.push_back({test_camera, mount});
  problem.reference_cameras.push_back({test_camera, mount});
  problem.matches.push_back({0, {640, 480}, 0, {640, 480}, MapPoint{{1, 0, 0}, Eigen::Matrix3d::Zero()}});
  const PoseLikelihood likelihood(problem, {});
  std::vector<PlanarTransform> poses;
  for (int k = -200; k <= 200; ++k) poses.emplace_back(1, 0, 1 - 0.05 - k * 1e-10, 0);
  for (int k = 0; k <= 200; ++k) poses.emplace_back(1, 0, 1 - k * 1e-3, 0);
  expectSameAsOneByOne(likelihood, poses);
}

TEST_P(ManyPoses, PosesFarAwayOrNotFinite) {
  Random random(55);
  const Scene scene = randomScene(random, {.matches = 30, .noise_px = 2});
  const PoseLikelihood likelihood(scene.problem, {});
  std::vector<PlanarTransform> poses{PlanarTransform(scene.map_from_robot)};
  for (const double x : {1e5, 1e7, -1e40, 1e150}) poses.emplace_back(1, 0, x, x);
  poses.emplace_back(1e3, 0, 0, 0);
  expectSameAsOneByOne(likelihood, poses);
  const double nothing = likelihood.matchCount() * std::log(1 - LikelihoodOptions().inlier_prior);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const std::vector<PlanarTransform> broken{{1, 0, bad, 0}, {bad, 0, 0, 0}, poses[0], {0, bad, 0, -bad}};
    std::vector<double> values(broken.size());
    likelihood.evaluate(broken, values);
    for (const std::size_t k : {0, 1, 3}) EXPECT_NEAR(values[k], nothing, 1e-9);
    EXPECT_NEAR(values[2], likelihood(poses[0]), tolerance);
  }
}

TEST_P(ManyPoses, AnyNumberOfPosesAndMatches) {
  Random random(56);
  for (const int matches : {1, 300}) {
    const Scene scene = randomScene(random, {.matches = matches, .noise_px = 2});
    const PoseLikelihood likelihood(scene.problem, {});
    for (int count = 1; count < 20; ++count)
      expectSameAsOneByOne(likelihood, posesAround(scene.map_from_robot, random, count));
    likelihood.evaluate({}, {});
    std::vector<double> too_few(1);
    EXPECT_THROW(likelihood.evaluate(posesAround(scene.map_from_robot, random, 2), too_few), std::invalid_argument);
  }
  PoseProblem empty;
  std::vector<double> value{1};
  PoseLikelihood(empty, {}).evaluate(std::vector{PlanarTransform()}, value);
  EXPECT_EQ(value[0], 0);
}

// Rounding may lead the search elsewhere, but to the same peak: none of 1200 problems of other seeds differed by more
// than 2e-7, so that a false alarm in 30 is rarer than one in ten runs of other seeds.
TEST_P(ManyPoses, SameEstimateAsBaseline) {
  if (GetParam() == HWY_SCALAR) GTEST_SKIP() << "the baseline itself";
  Random random(58);
  for (int trial = 0; trial < 30; ++trial) {
    const Scene scene = randomScene(random, {.matches = 100, .outlier_rate = 0.5, .noise_px = 2, .point_sigma = 0.02});
    const PoseEstimate estimate = estimatePose(scene.problem, {});
    useTargets(HWY_SCALAR);
    const PoseEstimate baseline = estimatePose(scene.problem, {});
    useTargets(GetParam());
    ASSERT_TRUE(estimate.found() && baseline.found());
    const PoseMode &best = estimate.modes.front(), &same = baseline.modes.front();
    EXPECT_LT(difference(best.robot_in_map, same.robot_in_map).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_EQ(best.inliers, same.inliers);
  }
}

// So that threads may share the poses out as they like.
TEST_P(ManyPoses, ValuesDoNotDependOnTheOtherPoses) {
  Random random(57);
  for (int trial = 0; trial < 10; ++trial) {
    const Scene scene = randomScene(random, {.cameras = 2, .matches = 300, .outlier_rate = 0.5, .noise_px = 2});
    const PoseLikelihood likelihood(scene.problem, {});
    const std::vector<PlanarTransform> poses = posesAround(scene.map_from_robot, random, 50);
    std::vector<double> together(poses.size()), apart(poses.size());
    likelihood.evaluate(poses, together);
    for (std::size_t first = 0, size = 1; first < poses.size(); first += size, ++size) {
      size = std::min(size, poses.size() - first);
      likelihood.evaluate(std::span(poses).subspan(first, size), std::span(apart).subspan(first, size));
    }
    EXPECT_EQ(together, apart);
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, ManyPoses, testing::ValuesIn(hwy::SupportedAndGeneratedTargets()),
                         [](const auto& instance) { return std::string(hwy::TargetName(instance.param)); });

}  // namespace
}  // namespace vmcl
