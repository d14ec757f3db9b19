// SPDX-License-Identifier: BSD-3-Clause
// Time of the whole estimate, against the number of matches, the percentage of outliers and the number of cameras.
#include <benchmark/benchmark.h>

#include <vector>

#include "random_scene.h"
#include "vmcl/estimation/estimator.h"

namespace vmcl {
namespace {

void estimate(benchmark::State& state) {
  const SceneOptions options{.cameras = static_cast<int>(state.range(2)),
                             .matches = static_cast<int>(state.range(0)),
                             .outlier_rate = 0.01 * static_cast<double>(state.range(1)),
                             .noise_px = 1};
  Random random(1);
  std::vector<Scene> scenes;
  for (int i = 0; i < 16; ++i) scenes.push_back(randomScene(random, options));
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(estimatePose(scenes[i++ % scenes.size()].problem, {}));
}
BENCHMARK(estimate)
    ->ArgNames({"matches", "outliers", "cameras"})
    ->ArgsProduct({{50, 200, 1000, 10000}, {50}, {1}})
    ->ArgsProduct({{200}, {20, 80}, {1}})
    ->ArgsProduct({{200}, {50}, {3, 8}})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace vmcl
