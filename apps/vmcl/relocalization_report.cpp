// SPDX-License-Identifier: BSD-3-Clause
#include "relocalization_report.h"

#include <algorithm>
#include <array>
#include <iomanip>
#include <iostream>
#include <limits>
#include <vector>

#include "vmcl/geometry/atomic_file.h"
#include "vmcl/study/confidence_interval.h"

namespace vmcl {
namespace {

/// Value below which the share of the sample lies; 0 for an empty sample.
double quantile(std::vector<double> sample, double share) {
  if (sample.empty()) return 0;
  const auto rank = sample.begin() + std::lround(share * static_cast<double>(sample.size() - 1));
  std::nth_element(sample.begin(), rank, sample.end());
  return *rank;
}

bool isWithin(const std::optional<PoseError>& error, double distance) {
  return error && error->position <= distance && error->heading <= 5 * degree;
}

constexpr std::array<double, 3> limits{0.25, 0.5, 1.0};  // m

/// Images within each limit.
using Successes = std::array<int, limits.size()>;

void printSuccesses(const std::string& name, const Successes& successes, const Successes& most, int images) {
  std::cout << std::left << std::setw(14) << name << std::right << std::setprecision(1);
  for (const int count : successes) {
    const Interval interval = wilsonInterval(count, images);
    std::cout << std::setw(8) << 100.0 * count / images << " (" << std::setw(4) << 100 * interval.low << " to "
              << std::setw(5) << 100 * interval.high << ')';
  }
  for (std::size_t i = 0; i < limits.size(); ++i)
    std::cout << std::setw(7) << (most[i] == 0 ? 0 : 100.0 * successes[i] / most[i]);
  std::cout << '\n';
}

/// Successes of all methods, and of the best of all for each image, which is what the paper divides by.
void printPeers(std::span<const ImageResult> results, int compared) {
  if (results.front().peers.empty()) return;
  std::vector<std::string> names{"vmcl"};
  for (const auto& [name, error] : results.front().peers) names.push_back(name);
  std::vector<Successes> successes(names.size());
  Successes most{};
  for (const ImageResult& image : results)
    for (std::size_t i = 0; i < limits.size(); ++i) {
      bool any = false;
      for (std::size_t method = 0; method < names.size(); ++method) {
        const bool is_within = isWithin(method == 0 ? image.error : image.peers[method - 1].second, limits[i]);
        successes[method][i] += is_within;
        any |= is_within;
      }
      most[i] += any;
    }
  std::cout << "\n%, 5 deg and     0.25 m (95 %)         0.5 m (95 %)           1 m (95 %)           % of the bound\n";
  for (std::size_t method = 0; method < names.size(); ++method)
    printSuccesses(names[method], successes[method], most, compared);
  printSuccesses("upper bound", most, most, compared);
  std::cout << '\n';
}

void printAccuracy(std::span<const ImageResult> results) {
  const auto compared =
      std::count_if(results.begin(), results.end(), [](const auto& image) { return image.has_truth; });
  if (compared == 0) return;
  std::cout << "with ground truth " << std::setw(10) << compared << '\n';
  for (const double limit : limits) {
    const auto within = std::count_if(results.begin(), results.end(),
                                      [&](const ImageResult& image) { return isWithin(image.error, limit); });
    std::cout << "in " << std::setprecision(2) << limit << " m, 5 deg    " << std::setprecision(1) << std::setw(10)
              << 100 * static_cast<double>(within) / static_cast<double>(compared) << " %\n";
  }
  std::vector<double> positions, headings;
  for (const ImageResult& image : results)
    if (image.error) {
      positions.push_back(image.error->position);
      headings.push_back(image.error->heading / degree);
    }
  std::cout << "median error      " << std::setprecision(3) << std::setw(10) << quantile(positions, 0.5) << " m "
            << std::setw(10) << quantile(headings, 0.5) << " deg\n";
}

void printLatency(std::span<const ImageResult> results) {
  std::cout << "latency, ms           median       p95\n";
  const auto line = [&](const char* step, auto secondsOf) {
    std::vector<double> sample;
    for (const ImageResult& image : results) sample.push_back(1e3 * secondsOf(image.times));
    std::cout << "  " << std::left << std::setw(16) << step << std::right << std::setprecision(1) << std::setw(10)
              << quantile(sample, 0.5) << std::setw(10) << quantile(sample, 0.95) << '\n';
  };
  using Times = RelocalizationTimes;
  line("features", [](const Times& t) { return t.features; });
  line("retrieval", [](const Times& t) { return t.retrieval; });
  line("matching", [](const Times& t) { return t.matching; });
  line("estimation", [](const Times& t) { return t.estimation; });
  line("all", [](const Times& t) { return t.features + t.retrieval + t.matching + t.estimation; });
}

void writeMode(std::ostream& out, const PoseMode& mode) {
  const PlanarPose& pose = mode.robot_in_map;
  const Eigen::Matrix3d& cov = mode.covariance;
  for (const double value :
       {pose.x, pose.y, pose.phi, cov(0, 0), cov(0, 1), cov(0, 2), cov(1, 1), cov(1, 2), cov(2, 2)})
    out << value << ',';
}

}  // namespace

void printTable(std::span<const ImageResult> results) {
  const auto found =
      std::count_if(results.begin(), results.end(), [](const auto& image) { return image.estimate.found(); });
  std::cout << std::fixed << "images            " << std::setw(10) << results.size() << "\nfound             "
            << std::setw(10) << found << '\n';
  printAccuracy(results);
  const auto compared = std::ranges::count_if(results, &ImageResult::has_truth);
  if (compared > 0) printPeers(results, static_cast<int>(compared));
  printLatency(results);
}

void writeResults(const std::filesystem::path& file, std::span<const ImageResult> results) {
  AtomicFile output(file);
  std::ostream& out = output.stream();
  out << "time,camera,status,x,y,phi,cov_xx,cov_xy,cov_xphi,cov_yy,cov_yphi,cov_phiphi,modes,inliers,matches,"
         "position_error,heading_error,references\n"
      << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (const ImageResult& image : results) {
    const auto& modes = image.estimate.modes;
    out << image.time << ',' << image.label << ',' << (modes.empty() ? "no_pose," : "found,");
    if (modes.empty())
      out << ",,,,,,,,,";
    else
      writeMode(out, modes.front());
    out << modes.size() << ',' << (modes.empty() ? 0 : modes.front().inliers.size()) << ',' << image.matches << ',';
    if (image.error) out << image.error->position;
    out << ',';
    if (image.error) out << image.error->heading;
    out << ',';
    for (std::size_t i = 0; i < image.references.size(); ++i)
      out << (i == 0 ? "" : " ") << image.references[i].first << ':' << image.references[i].second;
    out << '\n';
  }
  output.commit();
}

void writePeers(const std::filesystem::path& file, std::span<const ImageResult> results) {
  AtomicFile output(file);
  std::ostream& out = output.stream();
  out << "time,camera,method,position_error,heading_error\n"
      << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (const ImageResult& image : results)
    for (const auto& [name, error] : image.peers) {
      out << image.time << ',' << image.label << ',' << name << ',';
      if (error)
        out << error->position << ',' << error->heading << '\n';
      else
        out << ",\n";
    }
  output.commit();
}

void writeTiming(const std::filesystem::path& file, std::span<const ImageResult> results) {
  AtomicFile output(file);
  output.stream() << "time,camera,features,retrieval,matching,estimation\n"
                  << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (const ImageResult& image : results)
    output.stream() << image.time << ',' << image.label << ',' << image.times.features << ',' << image.times.retrieval
                    << ',' << image.times.matching << ',' << image.times.estimation << '\n';
  output.commit();
}

}  // namespace vmcl
