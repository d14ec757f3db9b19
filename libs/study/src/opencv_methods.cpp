// SPDX-License-Identifier: BSD-3-Clause
#include <opencv2/calib3d.hpp>

#include "peers.h"

namespace vmcl {
namespace {

/// The matches with depth of a robot with one camera.
struct PointMatches {
  std::vector<cv::Point3d> points_in_map;
  std::vector<cv::Point2d> pixels;
  cv::Mat intrinsics;

  explicit PointMatches(const PoseProblem& problem) {
    const PinholeCamera& camera = problem.query_cameras.at(0).camera;
    intrinsics = (cv::Mat_<double>(3, 3) << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
    for (const Match& match : problem.matches) {
      if (!match.point) continue;
      const Eigen::Vector3d& point = match.point->point_in_map;
      points_in_map.emplace_back(point.x(), point.y(), point.z());
      pixels.emplace_back(match.query_pixel.x(), match.query_pixel.y());
    }
  }
};

/// Planar pose of the robot from OpenCV's camera_from_map.
std::vector<PlanarPose> robotPose(const PoseProblem& problem, const cv::Mat& rotation_vector, const cv::Mat& t) {
  cv::Matx33d R;
  cv::Rodrigues(rotation_vector, R);
  Rigid3 camera_from_map = Rigid3::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) camera_from_map.linear()(i, k) = R(i, k);
    camera_from_map.translation()[i] = t.at<double>(i);
  }
  const PlanarPose pose = planarPart((problem.query_cameras[0].robot_from_camera * camera_from_map).inverse());
  return isFinite(pose) ? std::vector{pose} : std::vector<PlanarPose>{};
}

/// Runs a solver, solve(matches, rotation_vector, translation, inliers), and optimizes its answer over its inliers.
template <class Solve>
std::vector<PlanarPose> solveAndRefine(const PoseProblem& problem, const Solve& solve) {
  PointMatches matches(problem);
  cv::Mat rotation_vector, translation;
  std::vector<int> inliers;
  try {
    if (!solve(matches, rotation_vector, translation, inliers)) return {};
    std::vector<cv::Point3d> points;
    std::vector<cv::Point2d> pixels;
    for (const int i : inliers) {
      points.push_back(matches.points_in_map[static_cast<std::size_t>(i)]);
      pixels.push_back(matches.pixels[static_cast<std::size_t>(i)]);
    }
    if (points.size() >= 3)
      cv::solvePnPRefineLM(points, pixels, matches.intrinsics, cv::noArray(), rotation_vector, translation);
    return robotPose(problem, rotation_vector, translation);
  } catch (const cv::Exception&) {  // too few points, or a degenerate set
    return {};
  }
}

template <cv::SolvePnPMethod kernel>
std::vector<PlanarPose> ransac(const PoseProblem& problem, const MethodSettings& settings) {
  return solveAndRefine(problem, [&](PointMatches& m, cv::Mat& rotation, cv::Mat& t, std::vector<int>& inliers) {
    return cv::solvePnPRansac(m.points_in_map, m.pixels, m.intrinsics, cv::noArray(), rotation, t, false,
                              settings.iterations, static_cast<float>(settings.threshold_px), settings.confidence,
                              inliers, kernel);
  });
}

std::vector<PlanarPose> magsac(const PoseProblem& problem, const MethodSettings& settings) {
  cv::UsacParams params;
  params.score = cv::SCORE_METHOD_MAGSAC;
  params.loMethod = cv::LOCAL_OPTIM_SIGMA;
  params.confidence = settings.confidence;
  params.maxIterations = settings.iterations;
  params.threshold = settings.threshold_px;
  params.randomGeneratorState = static_cast<int>(settings.seed & 0x7fffffff);
  return solveAndRefine(problem, [&](PointMatches& m, cv::Mat& rotation, cv::Mat& t, std::vector<int>& inliers) {
    return cv::solvePnPRansac(m.points_in_map, m.pixels, m.intrinsics, cv::noArray(), rotation, t, inliers, params);
  });
}

}  // namespace

std::vector<PoseMethod> openCvMethods() {
  cv::setNumThreads(1);  // the study runs trials side by side, and times them
  return {
      {"AP3P", "OpenCV AP3P in RANSAC, refined; uses the matches with depth of one camera", false,
       ransac<cv::SOLVEPNP_AP3P>},
      {"EPnP", "OpenCV EPnP in RANSAC, refined; uses the matches with depth of one camera", false,
       ransac<cv::SOLVEPNP_EPNP>},
      {"MAGSAC", "OpenCV USAC P3P with MAGSAC++, refined; uses the matches with depth of one camera", false, magsac}};
}

}  // namespace vmcl
