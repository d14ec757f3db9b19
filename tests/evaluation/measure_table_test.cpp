// SPDX-License-Identifier: BSD-3-Clause
#include "measure_table.h"

#include <gtest/gtest.h>

namespace vmcl {
namespace {

const Measure& measure(const std::vector<Measure>& all, const std::string& key) {
  for (const Measure& m : all)
    if (m.key == key) return m;
  throw std::logic_error("no measure " + key);
}

TEST(MeasureTable, RatesHaveWilsonsInterval) {
  RunResult converged, lost;
  converged.measures.time_to_converge = 1;
  const Cell cell{0, 0, {}, {&converged, &converged, &converged, &lost}, 0, 0};
  const auto rate = summarize(measure(resultMeasures(), "converged"), cell);
  ASSERT_TRUE(rate);
  EXPECT_EQ(rate->runs, 4);
  EXPECT_DOUBLE_EQ(rate->value, 0.75);
  EXPECT_NEAR(rate->interval.low, 0.3006, 1e-4);  // Wilson's for 3 of 4
  EXPECT_NEAR(rate->interval.high, 0.9544, 1e-4);
  EXPECT_EQ(textOf(measure(resultMeasures(), "converged"), rate), "0.75 (0.30 to 0.95)");
}

TEST(MeasureTable, MediansAreOfTheRunsThatHaveTheFigure) {
  std::vector<RunResult> runs(4);
  runs[0].measures.time_to_converge = 3;
  runs[1].measures.time_to_converge = 1;
  runs[2].measures.time_to_converge = 2;
  const Cell cell{0, 0, {}, {&runs[0], &runs[1], &runs[2], &runs[3]}, 0, 0};
  const auto median = summarize(measure(resultMeasures(), "time_to_converge_s"), cell);
  EXPECT_EQ(median->runs, 3);
  EXPECT_EQ(median->value, 2);
  EXPECT_LE(median->interval.low, 2);
  EXPECT_EQ(textOf(measure(resultMeasures(), "recovery_time_s"),
                   summarize(measure(resultMeasures(), "recovery_time_s"), cell)),
            "-");
}

TEST(MeasureTable, OnlyRunsThatWereLocalizedCanNotice) {
  std::vector<RunResult> runs(3);
  runs[0].measures.noticed = true;
  runs[1].measures.noticed = false;
  const Cell cell{0, 0, {}, {&runs[0], &runs[1], &runs[2]}, 0, 0};
  const auto rate = summarize(measure(resultMeasures(), "noticed"), cell);
  EXPECT_EQ(rate->runs, 2);
  EXPECT_EQ(rate->value, 0.5);
}

TEST(MeasureTable, HeadingsAreInDegrees) {
  RunResult run;
  run.measures.heading_rmse = 2 * degree;
  EXPECT_NEAR(measure(resultMeasures(), "heading_rmse_deg").of(run).value(), 2, 1e-12);
}

// 1 to 100 ms: 95 of 100 take no longer than 95 ms.
TEST(MeasureTable, LatencyIsOfAllUpdates) {
  RunResult run;
  for (int i = 100; i > 0; --i) run.cost.latencies.push_back(1e-3 * i);
  for (const auto& [key, milliseconds] :
       {std::pair("latency_p50_ms", 50.0), std::pair("latency_p95_ms", 95.0), std::pair("latency_p99_ms", 99.0)})
    EXPECT_NEAR(measure(costMeasures(), key).of(run).value(), milliseconds, 1e-9);
  EXPECT_FALSE(measure(costMeasures(), "latency_p50_ms").of(RunResult()));
}

TEST(MeasureTable, ACellIsAMethodInASessionFromAStart) {
  ExperimentResults results;
  const auto add = [&](std::size_t start, Sensors sensors, bool there, bool done) {
    RunResult& run = results.runs.emplace_back();
    run.job.start = start;
    run.job.method.sensors = sensors;
    run.end.there = there;
    run.end.done = done;
  };
  add(0, Sensors::camera, true, true);
  add(0, Sensors::camera, true, false);
  add(0, Sensors::camera, false, false);
  add(0, Sensors::laser, true, true);
  add(1, Sensors::laser, true, true);
  const std::vector<Cell> cells = cellsOf(results);
  ASSERT_EQ(cells.size(), 3U);
  EXPECT_EQ(cells[0].done.size(), 1U);
  EXPECT_EQ(cells[0].failed, 1);
  EXPECT_EQ(cells[0].missing, 1);
}

}  // namespace
}  // namespace vmcl
