// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vmcl/estimation/rays.h"
#include "vmcl/geometry/pose_problem.h"
#include "vmcl/geometry/random.h"

namespace vmcl {

inline const PinholeCamera test_camera{1280, 960, 800, 800, 640, 480};

/// Optical axes (x right, y down, z forward) in robot axes (x forward, y left, z up).
inline Eigen::Matrix3d opticalAxes() {
  Eigen::Matrix3d R;
  R << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return R;
}

inline PlanarPose randomPose(Random& random, double reach = 2) {
  return {random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-3.1, 3.1)};
}

/// A camera mount or reference anywhere, up to 0.3 rad off in every angle from looking along `heading`.
inline Rigid3 randomMount(Random& random, double heading) {
  Rigid3 pose = Rigid3::Identity();
  pose.translation() << random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(0.1, 1);
  const auto tilt = [&](const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(random.uniform(-0.3, 0.3), axis).toRotationMatrix();
  };
  pose.linear() = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
                  tilt(Eigen::Vector3d::UnitX()) * tilt(Eigen::Vector3d::UnitY()) * tilt(Eigen::Vector3d::UnitZ()) *
                  opticalAxes();
  return pose;
}

struct SceneOptions {
  int cameras = 1;
  int matches = 40;
  double outlier_rate = 0;
  double depth_rate = 0.5;
  double noise_px = 0;
  double point_sigma = 0;  ///< isotropic noise of the map points (m)
};

struct Scene {
  PlanarPose map_from_robot;
  PoseProblem problem;
  std::vector<bool> inlier;
};

/// Points seen by random cameras of the robot and of the map, looking roughly the same way.
inline Scene randomScene(Random& random, const SceneOptions& options) {
  Scene scene;
  scene.map_from_robot = randomPose(random);
  const Rigid3 map_from_robot = toRigid3(scene.map_from_robot);
  for (int k = 0; k < options.cameras; ++k) {
    const double heading = 1.2 * k;
    scene.problem.query_cameras.push_back({test_camera, randomMount(random, heading)});
    Rigid3 reference = map_from_robot * randomMount(random, heading);
    reference.translation() += Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), 0);
    scene.problem.reference_cameras.push_back({test_camera, reference});
  }
  const auto noise = [&]() -> Eigen::Vector2d {
    return options.noise_px * Eigen::Vector2d(random.normal(), random.normal());
  };
  while (static_cast<int>(scene.problem.matches.size()) < options.matches) {
    const int k = static_cast<int>(scene.problem.matches.size()) % options.cameras;
    const Rigid3 map_from_query = map_from_robot * scene.problem.query_cameras[std::size_t(k)].robot_from_camera;
    const Rigid3& map_from_reference = scene.problem.reference_cameras[std::size_t(k)].map_from_camera;
    const Eigen::Vector3d in_query = random.uniform(1, 8) * test_camera.ray({random.uniform(0, test_camera.width),
                                                                             random.uniform(0, test_camera.height)});
    const Eigen::Vector3d in_map = map_from_query * in_query, in_reference = map_from_reference.inverse() * in_map;
    if (in_reference.z() < 0.5) continue;
    Match match{k, test_camera.project(in_query) + noise(), k, test_camera.project(in_reference) + noise(), {}};
    if (!test_camera.contains(match.reference_pixel)) continue;
    const bool inlier = random.uniform() >= options.outlier_rate;
    if (!inlier) match.query_pixel = {random.uniform(0, test_camera.width), random.uniform(0, test_camera.height)};
    if (random.uniform() < options.depth_rate) {
      const double s = options.point_sigma;
      const Eigen::Vector3d error(s * random.normal(), s * random.normal(), s * random.normal());
      match.point = MapPoint{in_map + error, s * s * Eigen::Matrix3d::Identity()};
    }
    scene.problem.matches.push_back(match);
    scene.inlier.push_back(inlier);
  }
  return scene;
}

/// Query ray in the robot frame and reference ray in the map frame of a match.
inline RayToRay raysOf(const PoseProblem& problem, const Match& match) {
  const auto& query = problem.query_cameras[std::size_t(match.query_camera)];
  const auto& reference = problem.reference_cameras[std::size_t(match.reference_camera)];
  return {
      {query.robot_from_camera.translation(), query.robot_from_camera.linear() * query.camera.ray(match.query_pixel)},
      {reference.map_from_camera.translation(),
       reference.map_from_camera.linear() * reference.camera.ray(match.reference_pixel)}};
}

}  // namespace vmcl
