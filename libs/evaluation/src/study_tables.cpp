// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iomanip>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "vmcl/evaluation/study_report.h"
#include "vmcl/geometry/atomic_file.h"

namespace vmcl {
namespace {

using Json = nlohmann::ordered_json;

bool isCramerRao(const MethodSummary& row) { return row.method == cramer_rao_name; }

const char* const cell_columns =
    "figure,world,cameras,matches_per_camera,outlier_rate,depth_rate,noise_px,tilt_deg,method";

std::string cellFields(const StudyCell& cell, const MethodSummary& row) {
  std::ostringstream fields;
  const WorldSettings& w = cell.world;
  fields << nameOf(cell.figure) << ',' << nameOf(w.world) << ',' << w.cameras << ',' << w.matches_per_camera << ','
         << w.outlier_rate << ',' << w.depth_rate << ',' << w.noise_px << ',' << w.tilt / degree << ',' << row.method;
  return fields.str();
}

void writeSuccess(std::ostream& out, int successes, int trials) {
  const Interval interval = wilsonInterval(successes, trials);
  out << ',' << static_cast<double>(successes) / trials << ',' << interval.low << ',' << interval.high;
}

void writeErrors(std::ostream& out, const ErrorSummary& errors, int answered, double unit) {
  if (answered == 0)
    out << ",,,,";
  else
    out << ',' << errors.rms * unit << ',' << errors.rms_interval.low * unit << ',' << errors.rms_interval.high * unit
        << ',' << errors.median * unit;
}

/// Without noise the bound is next to nothing.
bool isComparableWithBound(const StudyCell& cell, const MethodSummary& row) {
  return !isCramerRao(row) && row.successes > 0 && cell.world.noise_px > 0;
}

void writeOverBound(std::ostream& out, const StudyCell& cell, const MethodSummary& row) {
  if (isComparableWithBound(cell, row))
    out << ',' << row.over_bound << ',' << row.over_bound_interval.low << ',' << row.over_bound_interval.high;
  else
    out << ",,,";
}

void writeResults(const std::filesystem::path& file, const StudyRun& run) {
  AtomicFile csv(file);
  std::ostream& out = csv.stream();
  out << cell_columns << ",trials,answered,success,success_low,success_high,any_success,any_success_low,"
      << "any_success_high,rmse_m,rmse_m_low,rmse_m_high,median_m,rmse_deg,rmse_deg_low,rmse_deg_high,median_deg,"
      << "over_cramer_rao,over_cramer_rao_low,over_cramer_rao_high\n"
      << std::setprecision(5);
  for (const auto& [cell, rows] : run.cells) {
    for (const MethodSummary& row : rows) {
      out << cellFields(cell, row) << ',' << row.trials << ',' << row.answered;
      if (isCramerRao(row)) {
        out << ",,,,,,";
      } else {
        writeSuccess(out, row.successes, row.trials);
        writeSuccess(out, row.any_successes, row.trials);
      }
      writeErrors(out, row.distance, row.answered, 1);
      writeErrors(out, row.angle, row.answered, 1 / degree);
      writeOverBound(out, cell, row);
      out << '\n';
    }
  }
  csv.commit();
}

void writeTimings(const std::filesystem::path& file, const StudyRun& run) {
  AtomicFile csv(file);
  csv.stream() << cell_columns << ",trials,lower_quartile_ms,median_ms,upper_quartile_ms\n" << std::setprecision(4);
  for (const auto& [cell, rows] : run.cells) {
    for (const MethodSummary& row : rows) {
      if (isCramerRao(row)) continue;
      csv.stream() << cellFields(cell, row) << ',' << row.trials;
      for (const double seconds : row.seconds) csv.stream() << ',' << 1e3 * seconds;
      csv.stream() << '\n';
    }
  }
  csv.commit();
}

/// Successes over all cells of one kind of world.
struct WorldTotal {
  World world;
  int cameras;
  std::string method;
  int trials = 0, successes = 0, any_successes = 0;
};

std::vector<WorldTotal> worldTotals(const StudyRun& run) {
  std::vector<WorldTotal> totals;
  for (const auto& [cell, rows] : run.cells) {
    if (cell.figure != Figure::success) continue;
    for (const MethodSummary& row : rows) {
      if (isCramerRao(row)) continue;
      const WorldTotal key{cell.world.world, cell.world.cameras, row.method};
      auto total = std::find_if(totals.begin(), totals.end(), [&](const WorldTotal& t) {
        return t.world == key.world && t.cameras == key.cameras && t.method == key.method;
      });
      if (total == totals.end()) total = totals.insert(totals.end(), key);
      total->trials += row.trials;
      total->successes += row.successes;
      total->any_successes += row.any_successes;
    }
  }
  return totals;
}

Json accuracyJson(const StudyRun& run) {
  Json list = Json::array();
  for (const auto& [cell, rows] : run.cells) {
    if (cell.figure != Figure::accuracy) continue;
    for (const MethodSummary& row : rows)
      if (isComparableWithBound(cell, row))
        list.push_back({{"cameras", cell.world.cameras},
                        {"noise_px", cell.world.noise_px},
                        {"method", row.method},
                        {"rmse_m", row.distance.rms},
                        {"rmse_deg", row.angle.rms / degree},
                        {"over_cramer_rao", row.over_bound},
                        {"over_cramer_rao_95", {row.over_bound_interval.low, row.over_bound_interval.high}}});
  }
  return list;
}

void writeSummary(const std::filesystem::path& file, const StudyRun& run) {
  const MethodSettings settings;
  Json json{{"seed", run.seed},
            {"trials", run.trials},
            {"success", {{"max_error_m", success_distance}, {"max_error_deg", success_angle / degree}}},
            {"iterations", settings.iterations},
            {"confidence", settings.confidence},
            {"methods", Json::array()},
            {"success_rates", Json::array()},
            {"accuracy", accuracyJson(run)}};
  for (const PoseMethod& method : poseMethods())
    json["methods"].push_back(
        {{"name", method.name}, {"description", method.description}, {"takes_rigs", method.takes_rigs}});
  for (const WorldTotal& total : worldTotals(run)) {
    const Interval interval = wilsonInterval(total.successes, total.trials);
    json["success_rates"].push_back({{"world", nameOf(total.world)},
                                     {"cameras", total.cameras},
                                     {"method", total.method},
                                     {"trials", total.trials},
                                     {"success", static_cast<double>(total.successes) / total.trials},
                                     {"success_95", {interval.low, interval.high}},
                                     {"any_success", static_cast<double>(total.any_successes) / total.trials}});
  }
  AtomicFile out(file);
  out.stream() << json.dump(2) << '\n';
  out.commit();
}

}  // namespace

void writeStudyTables(const std::filesystem::path& directory, const StudyRun& run) {
  writeResults(directory / "results.csv", run);
  writeTimings(directory / "timings.csv", run);
  writeSummary(directory / "summary.json", run);
}

}  // namespace vmcl
