// SPDX-License-Identifier: BSD-3-Clause
#include "relocalization_report.h"

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <limits>
#include <vector>

#include "vmcl/geometry/atomic_file.h"

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

/// The same shares for the methods beside ours.
void printPeers(std::span<const ImageResult> results) {
  if (results.empty()) return;
  for (std::size_t peer = 0; peer < results.front().peers.size(); ++peer) {
    std::cout << "by " << std::left << std::setw(15) << results.front().peers[peer].first << std::right;
    const auto compared =
        std::count_if(results.begin(), results.end(), [](const auto& image) { return image.has_truth; });
    for (const double limit : {0.25, 0.5, 1.0}) {
      const auto within = std::count_if(results.begin(), results.end(), [&](const ImageResult& image) {
        return isWithin(image.peers[peer].second, limit);
      });
      std::cout << std::setprecision(1) << std::setw(10)
                << 100 * static_cast<double>(within) / static_cast<double>(std::max(compared, std::ptrdiff_t{1}))
                << " %";
    }
    std::cout << '\n';
  }
}

void printAccuracy(std::span<const ImageResult> results) {
  const auto compared =
      std::count_if(results.begin(), results.end(), [](const auto& image) { return image.has_truth; });
  if (compared == 0) return;
  std::cout << "with ground truth " << std::setw(10) << compared << '\n';
  for (const double limit : {0.25, 0.5, 1.0}) {
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
  printPeers(results);
  printLatency(results);
}

void writeResults(const std::filesystem::path& file, std::span<const ImageResult> results) {
  AtomicFile output(file);
  std::ostream& out = output.stream();
  out << "time,camera,status,x,y,phi,cov_xx,cov_xy,cov_xphi,cov_yy,cov_yphi,cov_phiphi,modes,inliers,matches,"
         "position_error,heading_error\n"
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
    out << '\n';
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
