// SPDX-License-Identifier: BSD-3-Clause
#include "health_report.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>

#include "vmcl/geometry/atomic_file.h"

namespace vmcl {
namespace {

using enum LocalizationStatus;
constexpr std::array reported{searching, tracking, degraded, lost};

auto countOf(const std::vector<LocalizationFrame>& frames, LocalizationStatus status) {
  return std::count_if(frames.begin(), frames.end(), [&](const auto& frame) { return frame.health.status == status; });
}

}  // namespace

void writeHealth(const std::filesystem::path& file, const std::vector<LocalizationFrame>& frames) {
  AtomicFile out(file);
  out.stream() << "t[s],status,unconfirmed_for[s],contradictions,testable,agreeing,contradicting,steady,jumped,"
                  "scattered,blind_motion\n"
               << std::fixed << std::setprecision(6);
  for (const LocalizationFrame& frame : frames) {
    const Health& health = frame.health;
    const UpdateEvidence& last = health.last;
    out.stream() << frame.time << ',' << nameOf(health.status) << ',' << health.unconfirmed_for << ','
                 << health.contradictions << ',' << last.testable << ',' << last.agreeing << ',' << last.contradicting
                 << ',' << last.steady << ',' << last.jumped << ',' << last.scattered << ',' << last.blind_motion
                 << '\n';
  }
  out.commit();
}

void writeHealthSummary(const std::filesystem::path& file, const std::vector<LocalizationFrame>& frames) {
  nlohmann::ordered_json json;
  for (const LocalizationStatus status : reported) json["updates"][nameOf(status)] = countOf(frames, status);
  json["final"] = nameOf(frames.empty() ? uninitialized : frames.back().health.status);
  json["became_lost_at"] = nlohmann::ordered_json::array();
  LocalizationStatus before = uninitialized;
  for (const LocalizationFrame& frame : frames) {
    if (frame.health.status == lost && before != lost) json["became_lost_at"].push_back(frame.time);
    before = frame.health.status;
  }
  AtomicFile out(file);
  out.stream() << json.dump(2) << '\n';
  out.commit();
}

void printHealth(std::ostream& out, const std::vector<LocalizationFrame>& frames) {
  out << "status:";
  for (const LocalizationStatus status : reported) {
    const double share = static_cast<double>(countOf(frames, status)) / static_cast<double>(frames.size());
    out << ' ' << nameOf(status) << ' ' << std::lround(100 * share) << " %" << (status == reported.back() ? "\n" : ",");
  }
}

}  // namespace vmcl
