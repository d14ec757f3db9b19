// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/study/simulated_world.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace vmcl {
namespace {

const PinholeCamera camera{1280, 960, 800, 800, 640, 480};

/// Optical axes (x right, y down, z forward) in planar ones (x forward, y left, z up).
const Eigen::Matrix3d planar_from_optical = (Eigen::Matrix3d() << 0, 0, 1, -1, 0, 0, 0, -1, 0).finished();

Rigid3 cameraPose(const PlanarPose& parent_from_camera) {
  Rigid3 pose = toRigid3(parent_from_camera);
  pose.linear() *= planar_from_optical;
  return pose;
}

/// Where the k-th camera of the robot is and looks to.
PlanarPose mountOf(int k, int cameras) {
  if (cameras == 1) return {};
  constexpr double radius = 0.25, spacing = std::numbers::pi / 3;
  const double angle = spacing * (k - 0.5 * (cameras - 1));
  return {radius * std::cos(angle), radius * std::sin(angle), angle};
}

/// One point as both cameras see it.
struct Sighting {
  Eigen::Vector2d query_pixel;
  Eigen::Vector2d reference_pixel;
  Eigen::Vector3d point_in_reference;  ///< optical axes
  bool inlier;
};

class Generator {
 public:
  Generator(const WorldSettings& settings, Random& random) : settings_(settings), random_(random) {}

  /// Planar axes of either camera.
  PlanarPose queryFromReference() {
    if (settings_.world != World::authors) {
      const double heading = random_.uniform(-std::numbers::pi, std::numbers::pi);
      const double forward = random_.uniform(-2, 2);
      return {forward, random_.uniform(-2, 2), heading};
    }
    const double distance = random_.uniform(0.01, 1), bearing = random_.uniform(0, std::numbers::pi / 2);
    return {distance * std::cos(bearing), -distance * std::sin(bearing), -random_.uniform(0, std::numbers::pi / 2)};
  }

  /// Turns what the robot sees as its tilt does.
  Eigen::Matrix3d tilt() {
    if (settings_.tilt == 0) return Eigen::Matrix3d::Identity();
    const double axis = random_.uniform(-std::numbers::pi, std::numbers::pi);
    return Eigen::AngleAxisd(settings_.tilt, Eigen::Vector3d(std::cos(axis), std::sin(axis), 0)).toRotationMatrix();
  }

  /// What one camera sees, in random order; nothing where the two views share too little. For inliers
  /// `query_from_upright` says where the camera is, over where it would be if the robot stood upright.
  std::optional<std::vector<Sighting>> sightings(const PlanarPose& query_from_reference,
                                                 const Rigid3& query_from_upright) {
    constexpr int max_tries = 10000;
    const int count = settings_.matches_per_camera;
    const int inliers = count - static_cast<int>(std::lround(count * settings_.outlier_rate));
    std::vector<Sighting> result;
    for (int tries = 0; static_cast<int>(result.size()) < count; ++tries) {
      if (tries == max_tries) return std::nullopt;
      const bool inlier = static_cast<int>(result.size()) < inliers;
      const auto sighting =
          look(inlier ? std::optional(query_from_upright * toRigid3(query_from_reference)) : std::nullopt);
      if (!sighting) continue;
      result.push_back(*sighting);
      tries = 0;
    }
    shuffle(result);
    return result;
  }

  double normal() { return random_.normal(); }
  double uniform(double low, double high) { return random_.uniform(low, high); }

  template <class Sequence>
  void shuffle(Sequence& sequence) {
    for (std::size_t i = sequence.size(); i > 1; --i) {
      const std::size_t k = random_.below(static_cast<uint32_t>(i));
      std::swap(sequence[i - 1], sequence[k]);
    }
  }

 private:
  /// An outlier is seen from anywhere.
  std::optional<Sighting> look(const std::optional<Rigid3>& query_from_reference) {
    const Eigen::Vector3d point = randomPoint();
    const auto reference_pixel = seen(point);
    if (!reference_pixel) return std::nullopt;
    std::optional<Eigen::Vector2d> query_pixel;
    if (!query_from_reference && settings_.world == World::uniform) {
      const double u = random_.uniform(0, camera.width);
      query_pixel = Eigen::Vector2d(u, random_.uniform(0, camera.height));
    } else {
      const Rigid3 planar = query_from_reference ? *query_from_reference : toRigid3(queryFromReference());
      query_pixel = seen(planar_from_optical.transpose() * (planar * (planar_from_optical * point)));
    }
    if (!query_pixel) return std::nullopt;
    return Sighting{*query_pixel, *reference_pixel, point, query_from_reference.has_value()};
  }

  Eigen::Vector3d randomPoint() {
    const bool authors = settings_.world == World::authors;
    const double side = authors ? 3 : 8;
    const double x = random_.uniform(-side, side), y = random_.uniform(-side, side);
    return {x, y, authors ? random_.uniform(2, 8) : random_.uniform(-side, side)};
  }

  /// Noisy pixel of a point that is in view.
  std::optional<Eigen::Vector2d> seen(const Eigen::Vector3d& point_in_camera) {
    constexpr double min_depth = 0.1;
    if (point_in_camera.z() <= min_depth) return std::nullopt;
    Eigen::Vector2d pixel = camera.project(point_in_camera);
    pixel.x() += settings_.noise_px * random_.normal();
    pixel.y() += settings_.noise_px * random_.normal();
    const bool inside = pixel.x() > 0 && pixel.y() > 0 && pixel.x() < camera.width && pixel.y() < camera.height;
    return inside ? std::optional(pixel) : std::nullopt;
  }

  const WorldSettings& settings_;
  Random& random_;
};

struct SimulatedMatch {
  Match match;
  MatchTruth truth;
};

/// Adds the k-th camera of the robot, its reference and their matches; false where the views share too little.
bool addCamera(int k, const WorldSettings& settings, const Eigen::Matrix3d& tilt, Generator& generator,
               SimulatedProblem& simulated, std::vector<SimulatedMatch>& matches) {
  const PlanarPose query_from_reference = generator.queryFromReference();
  const PlanarPose mount = mountOf(k, settings.cameras);
  const Rigid3 robot_from_camera = toRigid3(mount);
  const auto sightings =
      generator.sightings(query_from_reference, robot_from_camera.inverse() * Rigid3(tilt) * robot_from_camera);
  if (!sightings) return false;
  const Rigid3 map_from_reference = cameraPose(simulated.map_from_robot * mount * query_from_reference);
  simulated.problem.query_cameras.push_back({camera, cameraPose(mount)});
  simulated.problem.reference_cameras.push_back({camera, map_from_reference});
  const double sigma = depthNoise(settings.world);
  const Eigen::Vector3d axis = map_from_reference.linear().col(2);
  const auto deep =
      static_cast<std::size_t>(std::max(1L, std::lround(settings.matches_per_camera * settings.depth_rate)));
  for (std::size_t i = 0; i < sightings->size(); ++i) {
    const Sighting& sighting = (*sightings)[i];
    SimulatedMatch& entry = matches.emplace_back();
    entry.match = {k, sighting.query_pixel, k, sighting.reference_pixel, {}};
    entry.truth = {sighting.inlier, map_from_reference * sighting.point_in_reference};
    if (i < deep)
      entry.match.point = MapPoint{entry.truth.point_in_map + sigma * generator.normal() * axis,
                                   sigma * sigma * axis * axis.transpose()};
  }
  return true;
}

}  // namespace

std::string_view nameOf(World world) {
  switch (world) {
    case World::paper:
      return "paper";
    case World::authors:
      return "authors";
    case World::uniform:
      return "uniform";
  }
  throw std::invalid_argument("no such world");
}

void WorldSettings::check() const {
  const auto require = [](bool good, const char* key, double value) {
    if (!good) throw std::invalid_argument(std::string(key) + " cannot be " + std::to_string(value));
  };
  require(cameras >= 1, "cameras", cameras);
  require(matches_per_camera >= 2, "matches_per_camera", matches_per_camera);
  require(outlier_rate >= 0 && outlier_rate <= 1, "outlier_rate", outlier_rate);
  require(depth_rate >= 0 && depth_rate <= 1, "depth_rate", depth_rate);
  require(tilt >= 0 && tilt <= 0.2, "tilt", tilt);
  require(noise_px >= 0 && noise_px <= 100, "noise_px", noise_px);
}

double depthNoise(World world) { return world == World::authors ? 0.1 : 0.05; }

SimulatedProblem simulateProblem(const WorldSettings& settings, Random& random) {
  settings.check();
  Generator generator(settings, random);
  while (true) {
    SimulatedProblem simulated;
    std::vector<SimulatedMatch> matches;
    simulated.map_from_robot.x = generator.uniform(-5, 5);
    simulated.map_from_robot.y = generator.uniform(-5, 5);
    simulated.map_from_robot.phi = generator.uniform(-std::numbers::pi, std::numbers::pi);
    const Eigen::Matrix3d tilt = generator.tilt();
    bool complete = true;
    for (int k = 0; k < settings.cameras && complete; ++k)
      complete = addCamera(k, settings, tilt, generator, simulated, matches);
    if (!complete) continue;
    generator.shuffle(matches);
    for (SimulatedMatch& entry : matches) {
      simulated.problem.matches.push_back(std::move(entry.match));
      simulated.truth.push_back(entry.truth);
    }
    return simulated;
  }
}

}  // namespace vmcl
