// SPDX-License-Identifier: BSD-3-Clause
// Time to build a map of a corridor against the number of its keyframes, images aside.
#include <benchmark/benchmark.h>

#include "synthetic_room.h"

namespace vmcl {
namespace {

/// A drive to and fro along a corridor, 20 cm between keyframes, some 100 features in view.
testing::Recording corridor(int keyframes) {
  testing::Recording recording;
  const double length = 0.1 * keyframes;
  recording.room = testing::Room(20 * keyframes, 1);
  Random random(2);
  for (Eigen::Vector3d& point : recording.room.points_in_map)
    point = {random.uniform(0, length + 4), random.below(2) == 0 ? -1.2 : 1.2, random.uniform(0, 2.5)};
  recording.drive.clear();
  for (int i = 0; i < keyframes; ++i) {
    const bool returning = 2 * i >= keyframes;
    recording.drive.push_back(
        {returning ? 0.2 * (keyframes - i) : 0.2 * i, returning ? 0.3 : -0.3, returning ? std::numbers::pi : 0.0});
  }
  return recording;
}

void buildMap(benchmark::State& state) {
  const testing::Recording recording = corridor(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(recording.build(recording.builderOptions(), 1));
  state.SetComplexityN(state.range(0));
}
BENCHMARK(buildMap)->RangeMultiplier(2)->Range(125, 2000)->Unit(benchmark::kSecond)->Iterations(1)->Complexity();

}  // namespace
}  // namespace vmcl
