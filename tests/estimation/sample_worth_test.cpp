// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/estimation/sample_worth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

#include "random_scene.h"
#include "vmcl/estimation/match_information.h"
#include "vmcl/estimation/one_point_one_depth.h"

namespace vmcl {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr MatchRates rates{.sparse_inliers = 0.6, .dense_inliers = 0.9, .reliable_depth = 0.5};

TEST(SampleWorthTest, ChancesAreThoseOfThePaper) {
  EXPECT_DOUBLE_EQ(chanceOfGoodSample(Solver::two_depth, rates), 0.3 * 0.3);
  EXPECT_DOUBLE_EQ(chanceOfGoodSample(Solver::one_point_one_depth, rates), 0.9 * 0.3);            // DCSD
  EXPECT_DOUBLE_EQ(chanceOfGoodSample(Solver::one_point_one_depth, {0.6, 0.6, 0.5}), 0.6 * 0.3);  // SCSD
  EXPECT_DOUBLE_EQ(chanceOfGoodSample(Solver::one_point_one_depth, {0.6, 0.6, 1}), 0.6 * 0.6);    // as 2DP
  EXPECT_THROW(chanceOfGoodSample(Solver::three_rays, rates), std::invalid_argument);
  EXPECT_THAT([] { chanceOfGoodSample(Solver::two_depth, {.reliable_depth = 1.1}); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("reliable_depth is 1.1")));
}

TEST(SampleWorthTest, SoManySamplesHoldAGoodOne) {
  for (const double chance : {0.01, 0.2, 0.9}) {
    const double samples = samplesNeeded(chance, 0.99);
    EXPECT_LE(std::pow(1 - chance, samples), 0.01);
    EXPECT_GT(std::pow(1 - chance, samples - 1), 0.01);
  }
  EXPECT_EQ(samplesNeeded(1), 1);
  EXPECT_EQ(samplesNeeded(0), std::numeric_limits<double>::infinity());
}

/// Points some 4 m ahead of a camera that is 0.5 m above the ground.
ReferenceView pointsAhead(double point_sigma, std::size_t with_depth) {
  ReferenceView view;
  view.camera.camera = test_camera;
  view.camera.map_from_camera.linear() = opticalAxes();
  view.camera.map_from_camera.translation() = Eigen::Vector3d(0, 0, 0.5);
  Random random(1);
  for (int i = 0; i < 60; ++i)
    view.points.push_back({Eigen::Vector3d(random.uniform(3.5, 4.5), random.uniform(-1.5, 1.5), random.uniform(0, 1.8)),
                           point_sigma * point_sigma * Eigen::Matrix3d::Identity()});
  view.with_depth = with_depth;
  return view;
}

SampleWorth worthOf(Solver solver, const ReferenceView& view) {
  const QueryCamera query{test_camera, view.camera.map_from_camera};
  return sampleWorth(solver, view, query, {}, {0.5, 0.5, 1}, 1);
}

TEST(SampleWorthTest, TwoGoodDepthsAreMoreExact) {
  const ReferenceView view = pointsAhead(0.01, 60);
  const SampleWorth one = worthOf(Solver::one_point_one_depth, view), two = worthOf(Solver::two_depth, view);
  EXPECT_DOUBLE_EQ(one.chance_good, 0.25);
  EXPECT_GT(two.chance_within, 0.5);
  EXPECT_LT(two.sigma_position, one.sigma_position);
  EXPECT_LT(two.sigma_heading, one.sigma_heading);
}

TEST(SampleWorthTest, PoorDepthIsWorthLess) {
  for (const Solver solver : {Solver::one_point_one_depth, Solver::two_depth}) {
    const SampleWorth good = worthOf(solver, pointsAhead(0.01, 60)), poor = worthOf(solver, pointsAhead(0.5, 60));
    EXPECT_LT(poor.chance_within, 0.7 * good.chance_within);
    EXPECT_GT(poor.sigma_position, 2 * good.sigma_position);
  }
}

TEST(SampleWorthTest, NothingIsWorthWhatCannotBeDrawn) {
  EXPECT_EQ(worthOf(Solver::two_depth, pointsAhead(0.01, 1)).chance(), 0);
  EXPECT_GT(worthOf(Solver::one_point_one_depth, pointsAhead(0.01, 1)).chance(), 0);
  EXPECT_EQ(worthOf(Solver::one_point_one_depth, pointsAhead(0.01, 0)).chance(), 0);
  EXPECT_EQ(worthOf(Solver::one_point_one_depth, {}).chance(), 0);
  ReferenceView behind = pointsAhead(0.01, 60);
  for (MapPoint& point : behind.points) point.point_in_map.x() *= -1;
  EXPECT_EQ(worthOf(Solver::two_depth, behind).chance(), 0);
}

TEST(MatchInformationTest, AMatchWithoutDepthAndBaselineSaysNothing) {
  Random random(3);
  const Scene scene = randomScene(random, {.matches = 1, .depth_rate = 1, .point_sigma = 0});
  const QueryCamera& query = scene.problem.query_cameras[0];
  ReferenceCamera reference = scene.problem.reference_cameras[0];
  const Eigen::Vector3d point = scene.problem.matches[0].point->point_in_map;
  EXPECT_FALSE(informationWithoutDepth(query, reference, scene.map_from_robot, point, 1).isZero());
  reference.map_from_camera = toRigid3(scene.map_from_robot) * query.robot_from_camera;
  EXPECT_TRUE(informationWithoutDepth(query, reference, scene.map_from_robot, point, 1).isZero());
}

// 4000 draws: a sample covariance is within 10 % of the true one but for once in 10^5; 20 % leaves room for what small
// errors are not linear. Seed 7.
TEST(MatchInformationTest, IsTheInverseOfTheCovarianceOfSamples) {
  Random random(7);
  constexpr double sigma_px = 0.2, point_sigma = 0.002;
  int tried = 0;
  for (int trial = 0; trial < 200 && tried < 10; ++trial) {
    const Scene scene = randomScene(random, {.matches = 2, .depth_rate = 1, .point_sigma = 0});
    const Match &deep = scene.problem.matches[0], &flat = scene.problem.matches[1];
    const QueryCamera& query = scene.problem.query_cameras[0];
    const ReferenceCamera& reference = scene.problem.reference_cameras[0];
    const MapPoint point{deep.point->point_in_map, point_sigma * point_sigma * Eigen::Matrix3d::Identity()};
    const Eigen::Matrix3d covariance =
        (informationWithDepth(query, scene.map_from_robot, point, sigma_px) +
         informationWithoutDepth(query, reference, scene.map_from_robot, flat.point->point_in_map, sigma_px))
            .inverse();
    if (!(covariance.diagonal().maxCoeff() < 1e-3)) continue;  // not linear
    ++tried;
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    constexpr int draws = 4000;
    for (int i = 0; i < draws; ++i) {
      const auto noise = [&]() -> Eigen::Vector2d {
        return sigma_px * Eigen::Vector2d(random.normal(), random.normal());
      };
      Scene noisy = scene;
      for (Match& match : noisy.problem.matches) {
        match.query_pixel += noise();
        match.reference_pixel += noise();
      }
      const Eigen::Vector3d error(random.normal(), random.normal(), random.normal());
      const PlanarRoots found = solveOnePointOneDepth({raysOf(noisy.problem, noisy.problem.matches[0]).ray_in_robot,
                                                       deep.point->point_in_map + point_sigma * error},
                                                      raysOf(noisy.problem, noisy.problem.matches[1]));
      ASSERT_GT(found.count, 0);
      Eigen::Vector3d nearest = difference(found.roots[0].pose(), scene.map_from_robot);
      if (found.count > 1) {
        const Eigen::Vector3d other = difference(found.roots[1].pose(), scene.map_from_robot);
        if (other.norm() < nearest.norm()) nearest = other;
      }
      sum += nearest * nearest.transpose();
    }
    const Eigen::Matrix3d whitener = covariance.llt().matrixL().solve(Eigen::Matrix3d::Identity());
    const Eigen::Matrix3d ratio = whitener * (sum / draws) * whitener.transpose();
    EXPECT_LT((ratio - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 0.2) << ratio;
  }
  EXPECT_EQ(tried, 10);
}

}  // namespace
}  // namespace vmcl
