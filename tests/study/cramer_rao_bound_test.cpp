// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/study/cramer_rao_bound.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "vmcl/estimation/likelihood.h"
#include "vmcl/estimation/pose_refiner.h"

namespace vmcl {
namespace {

constexpr double sigma_px = 2;

/// What is measured of one inlier if the robot and the scene point are here: pixels over their noise, the point's depth
/// over its own.
Eigen::VectorXd measurement(const SimulatedProblem& simulated, std::size_t i, const PlanarPose& map_from_robot,
                            const Eigen::Vector3d& point_in_map) {
  const Match& match = simulated.problem.matches[i];
  const auto& query = simulated.problem.query_cameras[std::size_t(match.query_camera)];
  const auto& reference = simulated.problem.reference_cameras[std::size_t(match.reference_camera)];
  const Eigen::Vector2d in_query =
      query.camera.project((toRigid3(map_from_robot) * query.robot_from_camera).inverse() * point_in_map);
  const Eigen::Vector3d in_reference = reference.map_from_camera.inverse() * point_in_map;
  if (!match.point) {
    Eigen::VectorXd pixels(4);
    pixels << in_query, reference.camera.project(in_reference);
    return pixels / sigma_px;
  }
  constexpr double sure = 1e-6;  // m; the point is off along the optical axis only
  Eigen::VectorXd values(5);
  values << in_query / sigma_px, in_reference.head<2>() / sure, in_reference.z() / depthNoise(World::paper);
  return values;
}

/// The bound the long way: the Fisher information about the pose and all points, by numeric derivatives, inverted.
Eigen::Matrix3d boundWithAllPoints(const SimulatedProblem& simulated) {
  std::vector<std::size_t> inliers;
  for (std::size_t i = 0; i < simulated.truth.size(); ++i)
    if (simulated.truth[i].inlier) inliers.push_back(i);
  const auto size = static_cast<Eigen::Index>(3 + 3 * inliers.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(size, size);
  constexpr double delta = 1e-6;
  for (std::size_t k = 0; k < inliers.size(); ++k) {
    const Eigen::Vector3d& point = simulated.truth[inliers[k]].point_in_map;
    const auto at = [&](const Eigen::Matrix<double, 6, 1>& step) {
      const PlanarPose& pose = simulated.map_from_robot;
      return measurement(simulated, inliers[k], {pose.x + step[0], pose.y + step[1], pose.phi + step[2]},
                         point + step.tail<3>());
    };
    Eigen::MatrixXd J(at(Eigen::Matrix<double, 6, 1>::Zero()).size(), 6);
    for (int c = 0; c < 6; ++c) {
      const Eigen::Matrix<double, 6, 1> step = delta * Eigen::Matrix<double, 6, 1>::Unit(c);
      J.col(c) = (at(step) - at(-step)) / (2 * delta);
    }
    const Eigen::Index own = 3 + 3 * static_cast<Eigen::Index>(k);
    information.topLeftCorner<3, 3>() += J.leftCols<3>().transpose() * J.leftCols<3>();
    information.block<3, 3>(0, own) = J.leftCols<3>().transpose() * J.rightCols<3>();
    information.block<3, 3>(own, 0) = information.block<3, 3>(0, own).transpose();
    information.block<3, 3>(own, own) = J.rightCols<3>().transpose() * J.rightCols<3>();
  }
  return information.inverse().topLeftCorner<3, 3>();
}

TEST(CramerRaoBound, IsThatOfPoseAndPointsTogether) {
  Random random(1);
  for (const double depth_rate : {1.0, 0.5, 0.2}) {
    for (const int cameras : {1, 2}) {
      const SimulatedProblem simulated =
          simulateProblem({World::paper, cameras, 16, 0.25, depth_rate, sigma_px}, random);
      const auto bound = cramerRaoBound(simulated, sigma_px);
      ASSERT_TRUE(bound);
      const Eigen::Matrix3d expected = boundWithAllPoints(simulated);
      EXPECT_LT((*bound - expected).norm(), 1e-3 * expected.norm()) << *bound << "\n\n" << expected;
    }
  }
}

/// Maximum likelihood reaches the bound: over 400 worlds without outliers the squared error, measured by the bound, is
/// a mean of chi squares of three degrees of freedom. 4 sigma: a false alarm of 1 in 16,000 seeds.
TEST(CramerRaoBound, IsReachedByMaximumLikelihood) {
  constexpr int trials = 400;
  Random random(2);
  LikelihoodOptions options;
  options.sigma_px = sigma_px;
  options.inlier_prior = 0.999;
  double sum = 0;
  for (int k = 0; k < trials; ++k) {
    const SimulatedProblem simulated = simulateProblem({World::paper, 1, 50, 0, 1, sigma_px}, random);
    const PoseLikelihood likelihood(simulated.problem, options);
    const PlanarPose found =
        PoseRefiner(likelihood, {}).refine(PlanarTransform(simulated.map_from_robot)).map_from_robot;
    const Eigen::Vector3d error(found.x - simulated.map_from_robot.x, found.y - simulated.map_from_robot.y,
                                wrapAngle(found.phi - simulated.map_from_robot.phi));
    sum += error.dot(fisherInformation(simulated, sigma_px) * error);
  }
  EXPECT_NEAR(sum / trials, 3, 4 * std::sqrt(6.0 / trials));
}

TEST(CramerRaoBound, OutliersAddNothing) {
  Random random(3);
  SimulatedProblem simulated = simulateProblem({World::paper, 1, 20, 0.5, 0.5, sigma_px}, random);
  const Eigen::Matrix3d with = fisherInformation(simulated, sigma_px);
  for (std::size_t i = simulated.truth.size(); i-- > 0;) {
    if (simulated.truth[i].inlier) continue;
    simulated.truth.erase(simulated.truth.begin() + std::ptrdiff_t(i));
    simulated.problem.matches.erase(simulated.problem.matches.begin() + std::ptrdiff_t(i));
  }
  EXPECT_EQ(fisherInformation(simulated, sigma_px), with);
}

TEST(CramerRaoBound, NoneWithoutScale) {
  Random random(4);
  SimulatedProblem simulated = simulateProblem({World::paper, 1, 20, 0, 0.5, sigma_px}, random);
  for (Match& match : simulated.problem.matches) match.point.reset();
  EXPECT_FALSE(cramerRaoBound(simulated, sigma_px));
  simulated.problem.matches.clear();
  simulated.truth.clear();
  EXPECT_FALSE(cramerRaoBound(simulated, sigma_px));
}

}  // namespace
}  // namespace vmcl
