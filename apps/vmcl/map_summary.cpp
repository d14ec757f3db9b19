// SPDX-License-Identifier: BSD-3-Clause
#include "map_summary.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <map>
#include <set>

namespace vmcl {
namespace {

struct SessionSpan {
  double first = 0;  // s
  double last = 0;
  int keyframes = 0;
};

std::map<int, SessionSpan> sessionSpans(const KeyframeMap& map) {
  std::map<int, SessionSpan> spans;
  for (const Keyframe& keyframe : map.keyframes) {
    SessionSpan& span = spans.try_emplace(keyframe.session, SessionSpan{keyframe.time, keyframe.time}).first->second;
    span.first = std::min(span.first, keyframe.time);
    span.last = std::max(span.last, keyframe.time);
    ++span.keyframes;
  }
  return spans;
}

/// Of the image's area.
double maskedShare(const MapCamera& camera) {
  const int width = camera.calibration.pinhole.width, height = camera.calibration.pinhole.height;
  int masked = std::min(camera.mask_rows_from_top, height) * width;
  for (std::size_t i = static_cast<std::size_t>(masked); i < camera.mask.pixels.size(); ++i)
    masked += camera.mask.pixels[i] >= 128;
  return static_cast<double>(masked) / (static_cast<double>(width) * height);
}

const char* nameOf(DepthSource source) {
  switch (source) {
    case DepthSource::range:
      return "range images";
    case DepthSource::stereo:
      return "stereo";
    default:
      return "motion alone";
  }
}

/// Largest standard deviation of each landmark (m), sorted.
std::vector<double> landmarkSigmas(const KeyframeMap& map) {
  std::vector<double> sigmas;
  for (const Landmark& landmark : map.landmarks) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(landmark.covariance, Eigen::EigenvaluesOnly);
    sigmas.push_back(std::sqrt(std::max(0.0, eigen.eigenvalues()[2])));
  }
  std::ranges::sort(sigmas);
  return sigmas;
}

void printCamera(const MapCamera& camera) {
  const PinholeCamera& pinhole = camera.calibration.pinhole;
  std::cout << "camera '" << camera.label << "': " << pinhole.width << "x" << pinhole.height << std::setprecision(2)
            << ", fx " << pinhole.fx << ", fy " << pinhole.fy << ", cx " << pinhole.cx << ", cy " << pinhole.cy
            << ", distortion " << std::setprecision(4)
            << Eigen::Map<const Eigen::RowVector<double, 5>>(camera.calibration.distortion.data()) << ", mounted at "
            << camera.robot_from_camera.translation().transpose() << " m, " << std::setprecision(0)
            << 100 * maskedShare(camera) << " % masked, depth from " << nameOf(camera.depth) << '\n';
}

}  // namespace

void printSummary(const MapBuildReport& report, const KeyframeMap& map) {
  const TrackCounts& tracks = report.tracks;
  std::cout << std::fixed << std::setprecision(2) << report.landmarks << " landmarks, ";
  if (tracks.seen_once > 0) std::cout << tracks.seen_once << " of them placed by depth in one view, the others ";
  std::cout << "seen " << report.mean_observations << " times each\n"
            << tracks.seen << " tracks over keyframes, thrown away: " << tracks.reprojection
            << " without enough observations that agree, " << tracks.parallax << " without parallax, " << tracks.behind
            << " behind a camera, " << tracks.covariance << " too uncertain\n"
            << "noise as estimated: " << report.sigma_px << " px";
  if (report.sigma_depth > 0) std::cout << ", depth " << 1000 * report.sigma_depth << " mm at 1 m";
  std::cout << "; median reprojection error " << report.median_reprojection_px << " px\n";
  constexpr double beyond_chance = 1.5;
  if (report.shared_error > beyond_chance)
    std::cout << "images and given poses contradict each other: measurements count as " << report.shared_error
              << " times as noisy beside the poses\n";
  for (std::size_t i = 0; i < map.cameras.size(); ++i) {
    const Eigen::Vector3d turn_deg = report.mount_correction[i] / degree;
    const Eigen::Vector3d& shift = report.mount_shift[i];
    std::cout << "camera '" << map.cameras[i].label << "': mount turned by roll " << turn_deg.x() << ", pitch "
              << turn_deg.y() << ", yaw " << turn_deg.z() << " deg, shifted by x " << std::setprecision(3) << shift.x()
              << ", y " << shift.y() << " m, focal length times " << report.focal_scale[i] << std::setprecision(2)
              << '\n';
  }
}

void printInfo(const std::filesystem::path& file, const KeyframeMap& map) {
  const auto bytes = std::filesystem::file_size(file);
  std::cout << file.string() << ": " << map.keyframes.size() << " keyframes, " << map.landmarks.size() << " landmarks, "
            << vmcl::nameOf(map.feature_options.kind) << " features, places described by "
            << (map.place_network.file.empty() ? std::to_string(map.vocabulary.words().rows()) + " words"
                                               : map.place_network.file)
            << (map.isDense() ? ", dense" : ", not dense: for setting scsd alone") << '\n'
            << bytes << " bytes, " << bytes / std::max<std::size_t>(1, map.keyframes.size()) << " a keyframe\n"
            << std::fixed << std::setprecision(2);
  Eigen::AlignedBox2d area;
  for (const Keyframe& keyframe : map.keyframes)
    area.extend(Eigen::Vector2d(keyframe.map_from_robot.translation().head<2>()));
  if (!area.isEmpty())
    std::cout << "keyframes in x " << area.min().x() << " to " << area.max().x() << ", y " << area.min().y() << " to "
              << area.max().y() << " m\n";
  for (const auto& [session, span] : sessionSpans(map))
    std::cout << "session " << session << ": " << span.keyframes << " keyframes, time " << span.first << " to "
              << span.last << " s\n";
  if (const std::vector<double> sigmas = landmarkSigmas(map); !sigmas.empty()) {
    const auto quantile = [&](std::size_t percent) { return sigmas[(sigmas.size() - 1) * percent / 100]; };
    std::cout << std::setprecision(3) << "standard deviation of landmarks, largest axis: 10 % " << quantile(10)
              << ", median " << quantile(50) << ", 90 % " << quantile(90) << " m\n";
  }
  for (const MapCamera& camera : map.cameras) printCamera(camera);
}

std::vector<int> sessionsApart(const KeyframeMap& map) {
  std::vector<std::set<int>> sessions_of(map.landmarks.size());
  std::set<int> apart;
  for (const Keyframe& keyframe : map.keyframes) {
    apart.insert(keyframe.session);
    for (int landmark : keyframe.landmark_of_feature)
      if (landmark >= 0) sessions_of[static_cast<std::size_t>(landmark)].insert(keyframe.session);
  }
  if (apart.size() < 2) return {};
  for (const std::set<int>& sessions : sessions_of)
    if (sessions.size() > 1)
      for (int session : sessions) apart.erase(session);
  return {apart.begin(), apart.end()};
}

}  // namespace vmcl
