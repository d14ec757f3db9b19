// SPDX-License-Identifier: BSD-3-Clause
#include "measure_table.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace vmcl {
namespace {

using Summary = Measure::Summary;
using Value = std::optional<double>;

Value scaled(const Value& value, double scale) { return value ? Value(*value * scale) : std::nullopt; }
double asNumber(bool yes) { return yes ? 1 : 0; }

/// A field of RunMeasures.
template <class Field>
auto of(Field field, double scale = 1) {
  return [=](const RunResult& run) { return scaled(Value(run.measures.*field), scale); };
}

auto successWithin(std::size_t threshold) {
  return [=](const RunResult& run) { return Value(run.measures.success[threshold]); };
}

/// The smallest latency that the share q of the updates does not exceed.
auto latency(double q) {
  return [=](const RunResult& run) -> Value {
    std::vector<double> latencies = run.cost.latencies;
    if (latencies.empty()) return std::nullopt;
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(q * static_cast<double>(latencies.size()))) - 1;
    std::nth_element(latencies.begin(), latencies.begin() + rank, latencies.end());
    return 1e3 * latencies[static_cast<std::size_t>(rank)];
  };
}

Value recovered(const RunResult& run) {
  if (!run.measures.kidnapped_distance) return std::nullopt;
  return asNumber(run.measures.recovery_time.has_value());
}

}  // namespace

const std::vector<Measure>& resultMeasures() {
  using M = RunMeasures;
  static const std::vector<Measure> measures{
      {"converged", "runs that converge", "", 2, Summary::rate,
       [](const RunResult& run) { return Value(asNumber(run.measures.time_to_converge.has_value())); }},
      {"time_to_converge_s", "time to converge", "s", 2, Summary::median, of(&M::time_to_converge)},
      {"distance_to_converge_m", "distance to converge", "m", 2, Summary::median, of(&M::distance_to_converge)},
      {"found", "converge within 30 s, right at the end", "", 2, Summary::rate,
       [](const RunResult& run) { return Value(asNumber(run.measures.found)); }},
      {"position_rmse_m", "position error, RMSE", "m", 3, Summary::median, of(&M::position_rmse)},
      {"position_median_m", "position error, median", "m", 3, Summary::median, of(&M::position_median)},
      {"heading_rmse_deg", "heading error, RMSE", "deg", 2, Summary::median, of(&M::heading_rmse, 1 / degree)},
      {"heading_median_deg", "heading error, median", "deg", 2, Summary::median, of(&M::heading_median, 1 / degree)},
      {"relative_position_m", "relative error over 1 s, position", "m", 3, Summary::median, of(&M::relative_position)},
      {"relative_heading_deg", "relative error over 1 s, heading", "deg", 2, Summary::median,
       of(&M::relative_heading, 1 / degree)},
      {"success_025", "success within 0.25 m, 5 deg", "", 3, Summary::mean, successWithin(0)},
      {"success_050", "success within 0.5 m, 5 deg", "", 3, Summary::mean, successWithin(1)},
      {"success_100", "success within 1 m, 5 deg", "", 3, Summary::mean, successWithin(2)},
      {"false_accept_share", "false accepts (off by 1 m or 15 deg)", "", 3, Summary::mean, of(&M::false_accept_share)},
      {"any_false_accept", "runs with a false accept", "", 2, Summary::rate,
       [](const RunResult& run) { return Value(asNumber(run.measures.false_accept_share > 0)); }},
      {"recovered", "kidnapped runs that recover", "", 2, Summary::rate, recovered},
      {"recovery_time_s", "time to recover", "s", 2, Summary::median, of(&M::recovery_time)},
      {"noticed", "runs localized when kidnapped that say lost within 2 s", "", 2, Summary::rate, of(&M::noticed)},
      {"notice_time_s", "time to say lost", "s", 2, Summary::median, of(&M::notice_time)},
      {"kidnapped_distance_m", "carried off by", "m", 2, Summary::median, of(&M::kidnapped_distance)},
      {"correct_rate", "OpenLORIS CR (1 m, 30 deg)", "", 3, Summary::mean,
       [](const RunResult& run) { return Value(run.measures.lifelong.correct_rate); }},
      {"relocalization_score", "OpenLORIS C-RS (60 s)", "", 3, Summary::mean,
       [](const RunResult& run) { return Value(run.measures.lifelong.relocalization_score); }},
      {"nees", "NEES (3 if consistent)", "", 2, Summary::median, of(&M::nees)},
      {"particles", "particles", "", 0, Summary::median, of(&M::particles)}};
  return measures;
}

const std::vector<Measure>& costMeasures() {
  constexpr double mebibyte = 1 << 20;
  static const std::vector<Measure> measures{
      {"latency_p50_ms", "latency of an update, 50 %", "ms", 1, Summary::median, latency(0.50)},
      {"latency_p95_ms", "latency of an update, 95 %", "ms", 1, Summary::median, latency(0.95)},
      {"latency_p99_ms", "latency of an update, 99 %", "ms", 1, Summary::median, latency(0.99)},
      {"peak_memory_mib", "peak memory", "MiB", 0, Summary::median,
       [](const RunResult& run) { return Value(run.cost.peak_memory / mebibyte); }},
      {"processor_time_s", "processor time of a run", "s", 2, Summary::median,
       [](const RunResult& run) { return Value(run.cost.processor_seconds); }},
      {"real_time_s", "real time of a run", "s", 2, Summary::median,
       [](const RunResult& run) { return Value(run.cost.seconds); }}};
  return measures;
}

std::vector<Cell> cellsOf(const ExperimentResults& results) {
  std::vector<Cell> cells;
  for (const RunResult& run : results.runs) {
    const Job& job = run.job;
    if (cells.empty() || cells.back().session != job.session || cells.back().start != job.start ||
        cells.back().method != job.method)
      cells.push_back({job.session, job.start, job.method, {}, 0, 0});
    Cell& cell = cells.back();
    if (run.end.done) cell.done.push_back(&run);
    cell.failed += run.end.there && !run.end.done;
    cell.missing += !run.end.there;
  }
  return cells;
}

std::optional<SummaryValue> summarize(const Measure& measure, const Cell& cell) {
  std::vector<double> values;
  for (const RunResult* run : cell.done)
    if (const auto value = measure.of(*run)) values.push_back(*value);
  if (values.empty()) return std::nullopt;
  const auto runs = static_cast<int>(values.size());
  switch (measure.summary) {
    case Summary::rate:
      return SummaryValue{runs, mean(values),
                          wilsonInterval(static_cast<int>(std::count(values.begin(), values.end(), 1.0)), runs)};
    case Summary::mean:
      return SummaryValue{runs, mean(values), bootstrapMean(values)};
    case Summary::median:
      break;
  }
  return SummaryValue{runs, median(values), bootstrapMedian(values)};
}

std::string textOf(const Measure& measure, const std::optional<SummaryValue>& value) {
  if (!value) return "-";
  std::ostringstream text;
  text << std::fixed << std::setprecision(measure.digits) << value->value << " (" << value->interval.low << " to "
       << value->interval.high << ')';
  return text.str();
}

}  // namespace vmcl
