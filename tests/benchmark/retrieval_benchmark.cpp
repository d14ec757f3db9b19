// SPDX-License-Identifier: BSD-3-Clause
// Time to find the twenty most alike among many places of 8192 entries (64 words of SIFT), exactly and by the index,
// and how many of them the index finds. 100,000 take 4 GB of memory.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "vmcl/geometry/random.h"
#include "vmcl/vision/place_index.h"

namespace vmcl {
namespace {

constexpr int entries = 8192, count = 20, queries = 16;

/// A unit vector: `before` and a little noise.
Eigen::VectorXf walked(const Eigen::VectorXf& before, Random& random) {
  Eigen::VectorXf noise(entries);
  for (float& value : noise) value = static_cast<float>(random.uniform(-1, 1));
  return (before + 0.3f * noise.normalized()).normalized();
}

/// Places along a way: neighbours look alike.
struct Way {
  explicit Way(Eigen::Index length) : places(entries, length) {
    Random random(1);
    Eigen::VectorXf place = Eigen::VectorXf::Zero(entries);
    for (Eigen::Index i = 0; i < length; ++i) places.col(i) = place = walked(place, random);
    for (int i = 0; i < queries; ++i) seen.push_back(walked(places.col(i * length / queries), random));
  }

  Eigen::MatrixXf places;
  std::vector<Eigen::VectorXf> seen;
};

const Way& way(Eigen::Index length) {
  static std::unique_ptr<const Way> last;
  if (!last || last->places.cols() != length) {
    last.reset();
    last = std::make_unique<const Way>(length);
  }
  return *last;
}

void retrieveExactly(benchmark::State& state) {
  const Way& all = way(state.range(0));
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(retrieve(all.places, all.seen[i++ % queries], count));
}

void retrieveByIndex(benchmark::State& state) {
  const Way& all = way(state.range(0));
  const PlaceIndex index(all.places);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(index.retrieve(all.seen[i++ % queries], count));
  int found = 0;
  for (const Eigen::VectorXf& query : all.seen) {
    const auto by_index = index.retrieve(query, count);
    for (const RetrievedPlace& exact : retrieve(all.places, query, count))
      found += std::ranges::count(by_index, exact.index, &RetrievedPlace::index) > 0;
  }
  state.counters["found"] = static_cast<double>(found) / (queries * count);
}

const int registered = [] {
  for (const int places : {1000, 10'000, 100'000}) {
    benchmark::RegisterBenchmark("exact", retrieveExactly)->Arg(places)->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark("index", retrieveByIndex)->Arg(places)->Unit(benchmark::kMillisecond);
  }
  return 0;
}();

}  // namespace
}  // namespace vmcl
