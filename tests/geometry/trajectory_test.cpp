// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/geometry/trajectory.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace vmcl {
namespace {

namespace fs = std::filesystem;

class TrajectoryFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    directory_ = fs::temp_directory_path() / (std::string("vmcl_trajectory_") + test->name());
    fs::create_directories(directory_);
  }
  void TearDown() override { fs::remove_all(directory_); }

  fs::path write(const std::string& text) const {
    std::ofstream(directory_ / "t.tum") << text;
    return directory_ / "t.tum";
  }

  std::string complaint(const std::string& text) const {
    try {
      readTumTrajectory(write(text));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  fs::path directory_;
};

TEST(Trajectory, InterpolatesBetweenNeighboursOnly) {
  const Trajectory trajectory({{1, toRigid3({0, 0, 3.0})}, {1.4, toRigid3({2, 4, -3.0})}, {9, toRigid3({5, 5, 0})}});
  const PlanarPose half = planarPart(trajectory.at(1.2).value());
  EXPECT_NEAR(half.x, 1, 1e-12);
  EXPECT_NEAR(half.y, 2, 1e-12);
  EXPECT_NEAR(std::abs(half.phi), M_PI, 1e-9);  // the short way round
  EXPECT_EQ(planarPart(trajectory.at(9).value()).x, 5);
  EXPECT_FALSE(trajectory.at(0.99));
  EXPECT_FALSE(trajectory.at(9.01));
  EXPECT_FALSE(trajectory.at(5)) << "the gap is too long";
  EXPECT_TRUE(trajectory.at(5, 10));
}

TEST(Trajectory, RefusesTimesOutOfOrderAndBrokenPoses) {
  EXPECT_THROW(Trajectory({{2, Rigid3::Identity()}, {2, Rigid3::Identity()}}), std::invalid_argument);
  Rigid3 broken = Rigid3::Identity();
  broken.translation().x() = NAN;
  EXPECT_THROW(Trajectory({{2, broken}}), std::invalid_argument);
}

TEST_F(TrajectoryFile, ReadsBackWhatWasWritten) {
  const Trajectory trajectory({{100.123456789, toRigid3({0.1, -7.3, 2.2})}, {101, toRigid3({1e-7, 3, -1})}});
  writeTumTrajectory(directory_ / "out.tum", trajectory);
  const Trajectory back = readTumTrajectory(directory_ / "out.tum");
  ASSERT_EQ(back.poses().size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.poses()[i].time, trajectory.poses()[i].time);
    EXPECT_TRUE(back.poses()[i].map_from_robot.isApprox(trajectory.poses()[i].map_from_robot, 1e-14));
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(directory_), {}), 1) << "no temporary is left";
}

TEST_F(TrajectoryFile, NamesFileLineAndReason) {
  EXPECT_EQ(complaint("# comment\n\n1 0 0 0 0 0 0 1\n"), "");
  EXPECT_NE(complaint("1 0 0 0 0 0 0 1\n2 0 0\n").find("t.tum:2: expected"), std::string::npos);
  EXPECT_NE(complaint("1 0 0 0 0 0 0 2\n").find("t.tum:1: quaternion"), std::string::npos);
  EXPECT_NE(complaint("1 nan 0 0 0 0 0 1\n"), "");
  EXPECT_NE(complaint("2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n").find("not later"), std::string::npos);
  EXPECT_THROW(readTumTrajectory(directory_ / "absent.tum"), std::runtime_error);
}

}  // namespace
}  // namespace vmcl
