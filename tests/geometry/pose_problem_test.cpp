// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/geometry/pose_problem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

namespace vmcl {
namespace {

PoseProblem goodProblem() {
  PoseProblem problem;
  problem.query_cameras.push_back({{640, 480, 500, 500, 320, 240}, Rigid3::Identity()});
  problem.reference_cameras.push_back({{640, 480, 500, 500, 320, 240}, Rigid3::Identity()});
  problem.matches.push_back({0, {1, 2}, 0, {3, 4}, MapPoint{{1, 2, 3}, Eigen::Matrix3d::Identity()}});
  return problem;
}

/// The complaint about a good problem after one change.
std::string complaint(const std::function<void(PoseProblem&)>& change) {
  PoseProblem problem = goodProblem();
  change(problem);
  try {
    problem.check();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(PoseProblem, GoodProblemPasses) {
  EXPECT_EQ(complaint([](PoseProblem&) {}), "");
}

TEST(PoseProblem, NamesWhatIsWrong) {
  EXPECT_EQ(complaint([](auto& p) { p.query_cameras[0].camera.fx = 0; }), "query camera 0: camera fx is 0.000000");
  EXPECT_EQ(complaint([](auto& p) { p.query_cameras[0].robot_from_camera.matrix()(0, 3) = NAN; }),
            "query camera 0: pose is not finite");
  EXPECT_EQ(complaint([](auto& p) { p.reference_cameras[0].map_from_camera.matrix()(0, 0) = 1.01; }),
            "reference camera 0: rotation is not orthonormal");
  EXPECT_EQ(complaint([](auto& p) { p.reference_cameras[0].map_from_camera.matrix()(2, 2) = -1; }),
            "reference camera 0: rotation is not orthonormal");
  EXPECT_EQ(complaint([](auto& p) { p.matches[0].query_camera = 1; }), "match 0: no query camera 1");
  EXPECT_EQ(complaint([](auto& p) { p.matches[0].reference_camera = -1; }), "match 0: no reference camera -1");
  EXPECT_EQ(complaint([](auto& p) { p.matches[0].query_pixel.y() = INFINITY; }), "match 0: pixel is not finite");
  for (const double odds : {0.0, -1.0, 1e9, double{NAN}})
    EXPECT_EQ(complaint([=](auto& p) { p.matches[0].inlier_odds = odds; }),
              "match 0: inlier odds are not in [0.001, 1000]");
  EXPECT_EQ(complaint([](auto& p) { p.matches[0].point->point_in_map.z() = NAN; }), "match 0: point is not finite");
  EXPECT_EQ(complaint([](auto& p) { p.matches[0].point->covariance(0, 0) = -1; }),
            "match 0: point covariance is not positive semidefinite");
  EXPECT_EQ(complaint([](auto& p) { p.matches[0].point->covariance(0, 1) = 0.5; }),
            "match 0: point covariance is not symmetric");
}

}  // namespace
}  // namespace vmcl
