// SPDX-License-Identifier: BSD-3-Clause
#include "run_files.h"

#include <string.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "vmcl/geometry/atomic_file.h"

namespace vmcl {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void writeJson(const fs::path& file, const Json& json) {
  AtomicFile out(file);
  out.stream() << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  out.commit();
}

/// Calls read with the file's content; does nothing if there is no such file.
template <class Read>
void readJson(const fs::path& file, Read&& read) {
  std::ifstream in(file);
  if (!in) return;
  try {
    read(Json::parse(in));
  } catch (const Json::exception&) {
    throw std::runtime_error(file.string() + ": is broken");
  }
}

/// What a program said on stderr, without its own name.
std::vector<std::string> complaints(const fs::path& file) {
  constexpr std::size_t max_lines = 1000;
  std::vector<std::string> lines;
  std::ifstream in(file);
  for (std::string line; lines.size() < max_lines && std::getline(in, line);) {
    for (const std::string prefix : {"vmcl: ", "vmcl localize: "})
      if (line.starts_with(prefix)) line.erase(0, prefix.size());
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

std::string reasonOf(const ProcessEnd& end, const std::vector<std::string>& said) {
  if (end.signal != 0) return std::string("ended by a signal: ") + strsignal(end.signal);
  return said.empty() ? "exit code " + std::to_string(end.exit_code) : said.front();
}

/// The rows below a heading, each of so many fields.
std::vector<std::vector<std::string>> readCsv(const fs::path& file, std::size_t columns) {
  std::ifstream in(file);
  std::vector<std::vector<std::string>> rows;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::vector<std::string>& row = rows.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) row.push_back(field);
    if (row.size() != columns) throw std::runtime_error(file.string() + ": is broken");
  }
  return rows;
}

double numberIn(const fs::path& file, const std::string& field) {
  double number = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), number);
  if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(number))
    throw std::runtime_error(file.string() + ": '" + field + "' is no number");
  return number;
}

}  // namespace

fs::path runDirectory(const fs::path& directory, const Job& job) { return directory / "runs" / job.id; }

void writeRunEnd(const fs::path& run, const ProcessEnd& end, const std::string& job_description) {
  const std::vector<std::string> said = complaints(run / "stderr.txt");
  constexpr int some_input_bad = 1;
  const bool done = end.signal == 0 && (end.exit_code == 0 || end.exit_code == some_input_bad);
  Json json = {{"done", done}};
  if (!done) json["reason"] = reasonOf(end, said);
  if (done && end.exit_code == some_input_bad) json["problems"] = said;
  writeJson(run / "run.json", json);
  writeJson(
      run / "cost.json",
      {{"seconds", end.seconds}, {"processor_seconds", end.processor_seconds}, {"peak_memory_bytes", end.peak_memory}});
  AtomicFile job(run / "job.json");
  job.stream() << job_description << '\n';
  job.commit();
}

RunEnd readRunEnd(const fs::path& run) {
  RunEnd end;
  readJson(run / "run.json", [&](const Json& json) {
    end.there = true;
    end.done = json.at("done").get<bool>();
    end.reason = json.value("reason", "");
    end.problems = json.value("problems", std::vector<std::string>());
  });
  return end;
}

std::optional<std::string> readJobHash(const fs::path& run) {
  std::optional<std::string> hash;
  readJson(run / "job.json", [&](const Json& json) { hash = json.at("hash").get<std::string>(); });
  return hash;
}

RunCost readRunCost(const fs::path& run) {
  RunCost cost;
  readJson(run / "cost.json", [&](const Json& json) {
    cost.seconds = json.at("seconds").get<double>();
    cost.processor_seconds = json.at("processor_seconds").get<double>();
    cost.peak_memory = json.at("peak_memory_bytes").get<double>();
  });
  const fs::path timing = run / "timing.csv";
  for (const auto& row : readCsv(timing, 2)) cost.latencies.push_back(numberIn(timing, row[1]));
  return cost;
}

std::vector<RunUpdate> readUpdates(const fs::path& run) {
  enum Column { time, status, x, y, phi, xx, xy, xphi, yy, yphi, phiphi, share, ess, particles, inliers, columns };
  const fs::path file = run / "frames.csv";
  std::vector<RunUpdate> updates;
  for (const auto& row : readCsv(file, columns)) {
    const auto number = [&](Column column) { return numberIn(file, row[column]); };
    RunUpdate& update = updates.emplace_back();
    update.estimate = {
        number(time), row[status] == nameOf(LocalizationStatus::tracking), {number(x), number(y), number(phi)}};
    update.covariance << number(xx), number(xy), number(xphi), number(xy), number(yy), number(yphi), number(xphi),
        number(yphi), number(phiphi);
    update.particles = static_cast<int>(number(particles));
    update.lost = row[status] == nameOf(LocalizationStatus::lost);
  }
  return updates;
}

std::optional<Kidnapped> readKidnapped(const fs::path& run) {
  std::optional<Kidnapped> kidnapped;
  readJson(run / "summary.json", [&](const Json& json) {
    if (!json.contains("kidnapped")) return;
    const Json& part = json.at("kidnapped");
    kidnapped = {part.at("from").get<double>(), part.at("until").get<double>()};
  });
  return kidnapped;
}

}  // namespace vmcl
