// SPDX-License-Identifier: BSD-3-Clause
// Time of the likelihood per match and pose (the inverse of items_per_second): one pose at a time, and many at once on
// each instruction set that this machine has. Near: particles about the truth; far: hypotheses anywhere.
#include "vmcl/geometry/instruction_sets.h"

#include <benchmark/benchmark.h>
#include <hwy/highway.h>

#include <string>
#include <vector>

#include "random_scene.h"
#include "vmcl/estimation/likelihood.h"

namespace vmcl {
namespace {

struct Workload {
  int matches = 200;
  double outlier_rate = 0.5;
  double depth_rate = 0.5;
  bool near = true;
};

struct Inputs {
  explicit Inputs(const Workload& workload) : scene(sceneOf(workload)), likelihood(scene.problem, {}) {
    Random random(2);
    for (int i = 0; i < 1024; ++i) {
      const PlanarPose& truth = scene.map_from_robot;
      poses.emplace_back(workload.near ? PlanarPose{truth.x + 0.02 * random.normal(), truth.y + 0.02 * random.normal(),
                                                    truth.phi + 0.005 * random.normal()}
                                       : randomPose(random, 3));
    }
    values.resize(poses.size());
  }

  static Scene sceneOf(const Workload& workload) {
    Random random(1);
    return randomScene(random, {.matches = workload.matches,
                                .outlier_rate = workload.outlier_rate,
                                .depth_rate = workload.depth_rate,
                                .noise_px = 2,
                                .point_sigma = 0.02});
  }

  int64_t pairs() const { return static_cast<int64_t>(poses.size()) * likelihood.matchCount(); }

  Scene scene;
  PoseLikelihood likelihood;
  std::vector<PlanarTransform> poses;
  std::vector<double> values;
};

void oneByOne(benchmark::State& state, const Workload& workload) {
  Inputs inputs(workload);
  for (auto _ : state)
    for (std::size_t i = 0; i < inputs.poses.size(); ++i) inputs.values[i] = inputs.likelihood(inputs.poses[i]);
  state.SetItemsProcessed(state.iterations() * inputs.pairs());
}

void manyPoses(benchmark::State& state, const Workload& workload, int64_t target) {
  Inputs inputs(workload);
  hwy::SetSupportedTargetsForTest(target);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  for (auto _ : state) inputs.likelihood.evaluate(inputs.poses, inputs.values);
  state.SetItemsProcessed(state.iterations() * inputs.pairs());
}

void prepare(benchmark::State& state, const Workload& workload) {
  const Scene scene = Inputs::sceneOf(workload);
  for (auto _ : state) benchmark::DoNotOptimize(PoseLikelihood(scene.problem, {}));
  state.SetItemsProcessed(state.iterations() * workload.matches);
}

std::string nameOf(const Workload& workload) {
  const auto percent = [](double rate) { return std::to_string(static_cast<int>(100 * rate)); };
  return std::string(workload.near ? "near" : "far") + "/outliers:" + percent(workload.outlier_rate) +
         "/depth:" + percent(workload.depth_rate) + "/matches:" + std::to_string(workload.matches);
}

void registerAll() {
  for (const int matches : {50, 200, 1000}) {
    const Workload workload{.matches = matches};
    benchmark::RegisterBenchmark(("prepare/" + nameOf(workload)).c_str(), prepare, workload);
  }
  for (const bool near : {true, false})
    for (const double depth_rate : {1.0, 0.5, 0.0})
      for (const double outlier_rate : {0.0, 0.5, 0.8}) {
        const Workload workload{.outlier_rate = outlier_rate, .depth_rate = depth_rate, .near = near};
        benchmark::RegisterBenchmark(("oneByOne/" + nameOf(workload)).c_str(), oneByOne, workload);
        for (const int64_t target : hwy::SupportedAndGeneratedTargets())
          benchmark::RegisterBenchmark(
              ("manyPoses/" + std::string(hwy::TargetName(target)) + "/" + nameOf(workload)).c_str(), manyPoses,
              workload, target);
      }
}

const bool registered = (registerAll(), true);

}  // namespace
}  // namespace vmcl
