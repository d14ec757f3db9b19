// SPDX-License-Identifier: BSD-3-Clause
// Time of one call of each minimal solver, over samples of inliers and outliers.
#include <benchmark/benchmark.h>

#include <array>
#include <vector>

#include "random_scene.h"
#include "vmcl/estimation/depth_points.h"
#include "vmcl/estimation/one_point_one_depth.h"

namespace vmcl {
namespace {

constexpr std::size_t samples = 1024;

std::vector<RayToPoint> pointsOf(const Scene& scene) {
  std::vector<RayToPoint> points;
  for (const Match& match : scene.problem.matches)
    points.push_back({raysOf(scene.problem, match).ray_in_robot, match.point->point_in_map});
  return points;
}

Scene manyMatches() {
  Random random(1);
  return randomScene(random, {.matches = samples, .outlier_rate = 0.3, .depth_rate = 1, .noise_px = 1});
}

void onePointOneDepth(benchmark::State& state) {
  const Scene scene = manyMatches();
  const std::vector<RayToPoint> points = pointsOf(scene);
  std::vector<RayToRay> rays;
  for (const Match& match : scene.problem.matches) rays.push_back(raysOf(scene.problem, match));
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(solveOnePointOneDepth(points[i % samples], rays[(i + 7) % samples]));
    ++i;
  }
}
BENCHMARK(onePointOneDepth);

void depthPoints(benchmark::State& state) {
  const std::vector<RayToPoint> points = pointsOf(manyMatches());
  const auto count = static_cast<std::size_t>(state.range(0));
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(solveDepthPoints({points.data() + i % (samples / 2), count}));
    ++i;
  }
}
BENCHMARK(depthPoints)->Arg(2)->Arg(8);

}  // namespace
}  // namespace vmcl
