// SPDX-License-Identifier: BSD-3-Clause
#include "minimal_sampler.h"

#include <array>

#include "vmcl/estimation/depth_points.h"
#include "vmcl/estimation/one_point_one_depth.h"

namespace vmcl {

MinimalSampler::MinimalSampler(const PoseProblem& problem) {
  for (const Match& match : problem.matches) {
    const QueryCamera& query = problem.query_cameras[static_cast<std::size_t>(match.query_camera)];
    const ReferenceCamera& reference = problem.reference_cameras[static_cast<std::size_t>(match.reference_camera)];
    const Ray ray_in_robot{query.robot_from_camera.translation(),
                           query.robot_from_camera.linear() * query.camera.ray(match.query_pixel)};
    const Ray ray_in_map{reference.map_from_camera.translation(),
                         reference.map_from_camera.linear() * reference.camera.ray(match.reference_pixel)};
    if (match.point) {
      with_depth_.push_back({ray_in_robot, match.point->point_in_map});
      match_of_depth_.push_back(static_cast<int>(rays_.size()));
    }
    rays_.push_back({ray_in_robot, ray_in_map});
  }
}

void MinimalSampler::drawOnePointOneDepth(int count, Random& random, std::vector<PlanarTransform>& poses) const {
  for (int i = 0; i < count; ++i) {
    const uint32_t depth = random.below(static_cast<uint32_t>(with_depth_.size()));
    auto other = static_cast<int>(random.below(static_cast<uint32_t>(rays_.size() - 1)));
    if (other >= match_of_depth_[depth]) ++other;
    const PlanarRoots roots = solveOnePointOneDepth(with_depth_[depth], rays_[static_cast<std::size_t>(other)]);
    poses.insert(poses.end(), roots.roots.begin(), roots.roots.begin() + roots.count);
  }
}

void MinimalSampler::drawTwoDepth(int count, Random& random, std::vector<PlanarTransform>& poses) const {
  const auto add = [&](std::size_t first, std::size_t second) {
    const std::array<RayToPoint, 2> pair{with_depth_[first], with_depth_[second]};
    if (const auto pose = solveDepthPoints(pair)) poses.push_back(*pose);
  };
  const std::size_t n = with_depth_.size();
  if (n * (n - 1) / 2 <= static_cast<std::size_t>(count)) {
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = i + 1; k < n; ++k) add(i, k);
    return;
  }
  for (int i = 0; i < count; ++i) {
    const uint32_t first = random.below(static_cast<uint32_t>(n));
    uint32_t second = random.below(static_cast<uint32_t>(n - 1));
    if (second >= first) ++second;
    add(first, second);
  }
}

}  // namespace vmcl
