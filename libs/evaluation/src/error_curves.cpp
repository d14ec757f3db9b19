// SPDX-License-Identifier: BSD-3-Clause
#include "error_curves.h"

#include <algorithm>
#include <limits>
#include <map>

namespace vmcl {
namespace {

constexpr double max_age = 1;  // s
constexpr int max_times = 300;
constexpr double min_step = 0.1;  // s

/// The last error at or before a time, unless it is too old. Errors are in increasing time.
std::optional<PoseError> errorAt(const std::vector<PoseError>& errors, double time) {
  const auto after = std::upper_bound(errors.begin(), errors.end(), time,
                                      [](double t, const PoseError& error) { return t < error.time; });
  if (after == errors.begin() || std::prev(after)->time < time - max_age) return std::nullopt;
  return *std::prev(after);
}

bool succeeds(const std::optional<PoseError>& error, double distance) {
  return error && error->position <= distance && error->heading <= EvaluationOptions().success_heading;
}

/// Leaves out the times at which no run has an error: the robot was being carried.
void dropBlindTimes(ErrorGrid& grid) {
  std::vector<std::size_t> kept;
  for (std::size_t t = 0; t < grid.times.size(); ++t)
    if (std::any_of(grid.cells.begin(), grid.cells.end(), [&](const auto& cell) {
          return std::any_of(cell.begin(), cell.end(),
                             [&](const auto& series) { return series.errors[t].has_value(); });
        }))
      kept.push_back(t);
  const auto keep = [&](auto& values) {
    for (std::size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
    values.resize(kept.size());
  };
  keep(grid.times);
  for (auto& cell : grid.cells)
    for (auto& series : cell) keep(series.errors);
}

}  // namespace

ErrorGrid errorGridOf(const CellGroup& group) {
  double begin = std::numeric_limits<double>::infinity(), end = -begin;
  for (const Cell& cell : group.cells)
    for (const RunResult* run : cell.done) {
      if (run->errors.empty()) continue;
      begin = std::min(begin, run->errors.front().time);
      end = std::max(end, run->errors.back().time);
    }
  ErrorGrid grid;
  if (!(begin <= end)) return grid;
  const double step = std::max(min_step, (end - begin) / max_times);
  for (int i = 0; i * step <= end - begin + 1e-6; ++i) grid.times.push_back(i * step);
  for (const Cell& cell : group.cells) {
    auto& runs = grid.cells.emplace_back();
    for (const RunResult* run : cell.done) {
      auto& series = runs.emplace_back(ErrorGrid::Series{run->job.seed, {}});
      for (const double time : grid.times) series.errors.push_back(errorAt(run->errors, begin + time));
    }
  }
  dropBlindTimes(grid);
  return grid;
}

std::vector<ErrorQuartiles> quartilesOverTime(const ErrorGrid& grid, std::size_t cell) {
  std::vector<ErrorQuartiles> curve;
  for (std::size_t t = 0; t < grid.times.size(); ++t) {
    std::vector<double> positions, headings;
    for (const auto& series : grid.cells[cell]) {
      if (!series.errors[t]) continue;
      positions.push_back(series.errors[t]->position);
      headings.push_back(series.errors[t]->heading);
    }
    if (positions.empty() || 2 * positions.size() < grid.cells[cell].size()) continue;
    std::sort(positions.begin(), positions.end());
    std::sort(headings.begin(), headings.end());
    ErrorQuartiles& quartiles = curve.emplace_back(ErrorQuartiles{grid.times[t], {}, {}});
    for (std::size_t q = 0; q < 3; ++q) {
      const std::size_t rank = ((q + 1) * (positions.size() - 1) + 2) / 4;  // nearest to the share (q + 1) / 4
      quartiles.position[q] = positions[rank];
      quartiles.heading[q] = headings[rank];
    }
  }
  return curve;
}

SuccessRates successRates(const ErrorGrid& grid, double distance) {
  std::map<uint64_t, std::vector<std::pair<std::size_t, const ErrorGrid::Series*>>> by_seed;
  for (std::size_t c = 0; c < grid.cells.size(); ++c)
    for (const auto& series : grid.cells[c]) by_seed[series.seed].emplace_back(c, &series);
  std::vector<double> counts(grid.cells.size());
  double any_count = 0;
  for (const auto& [seed, runs] : by_seed)
    for (std::size_t t = 0; t < grid.times.size(); ++t) {
      bool any = false;
      for (const auto& [cell, series] : runs) {
        if (!succeeds(series->errors[t], distance)) continue;
        any = true;
        ++counts[cell];
      }
      any_count += any;
    }
  const auto over = [&](double all) {
    std::vector<double> shares;
    for (const double count : counts) shares.push_back(all > 0 ? count / all : 0);
    return shares;
  };
  return {over(static_cast<double>(by_seed.size() * grid.times.size())), over(any_count)};
}

}  // namespace vmcl
