// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/pose_with_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <fstream>

#include "scratch_directory.h"
#include "vmcl/estimation/pose_mixture.h"

namespace vmcl {
namespace {

PoseWithCovariance somewhere() {
  PoseWithCovariance pose{{1.0 / 3, -2e-7, 3.1}, {}};
  pose.covariance << 0.04, 0.01, 0.002, 0.01, 0.09, -0.003, 0.002, -0.003, 0.01;
  return pose;
}

TEST(PoseWithCovariance, ComesBackToTheBit) {
  const ScratchDirectory scratch;
  const auto file = scratch.path() / "pose.yaml";
  savePose(file, somewhere());
  const PoseWithCovariance read = loadPose(file);
  EXPECT_EQ(difference(read.robot_in_map, somewhere().robot_in_map).norm(), 0);
  EXPECT_EQ(read.covariance, somewhere().covariance);
}

TEST(PoseWithCovariance, BrokenFilesAreNamed) {
  const ScratchDirectory scratch;
  const auto file = scratch.path() / "pose.yaml";
  const std::string pose = "robot_in_map: [0, 0, 0]\n", covariance = "covariance: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n";
  for (const std::string& content :
       {std::string(), std::string("garbage"), pose, covariance, pose + "covariance: [1]\n",
        pose + "covariance: [1, 0, 0, 0, -1, 0, 0, 0, 1]\n", pose + "covariance: [1, 2, 0, 0, 1, 0, 0, 0, 1]\n",
        "robot_in_map: [nan, 0, 0]\n" + covariance, "robot_in_map: [1e30, 0, 0]\n" + covariance,
        pose + covariance + "more: 1\n"}) {
    std::ofstream(file) << content;
    try {
      loadPose(file);
      ADD_FAILURE() << content;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).find(file.string()), 0U) << error.what();
    }
  }
  EXPECT_THROW(loadPose(scratch.path() / "nowhere.yaml"), std::runtime_error);
}

TEST(PoseWithCovariance, OfNoUseIsNotWritten) {
  const ScratchDirectory scratch;
  PoseWithCovariance pose = somewhere();
  pose.covariance(0, 0) = 1e15;
  EXPECT_THROW(savePose(scratch.path() / "pose.yaml", pose), std::invalid_argument);
  pose.robot_in_map.x = std::nan("");
  EXPECT_THROW(savePose(scratch.path() / "pose.yaml", pose), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "pose.yaml"));
}

/// Moments of 20,000 draws, seed 3: a variance is known to 1 %, a mean to 0.002; six standard deviations of each, false
/// alarm 2e-8 of the nine together.
TEST(PoseWithCovariance, DrawsHaveItsMoments) {
  Random random(3);
  const auto draw = somewhere().sampler(random);
  constexpr int draws = 20000;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (int i = 0; i < draws; ++i) {
    const Eigen::Vector3d offset = difference(draw(), somewhere().robot_in_map);
    sum += offset;
    squares += offset * offset.transpose();
  }
  EXPECT_LT((sum / draws).cwiseAbs().maxCoeff(), 0.013);
  EXPECT_LT((squares / draws - somewhere().covariance).cwiseAbs().maxCoeff(), 0.006);
}

}  // namespace
}  // namespace vmcl
