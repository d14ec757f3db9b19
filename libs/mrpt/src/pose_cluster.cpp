// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/pose_cluster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace vmcl {
namespace {

constexpr double radius = 1.0;                         // m
constexpr double max_turn = std::numbers::pi / 4;      // rad
constexpr double cell_position = 0.5;                  // m
constexpr double cell_heading = std::numbers::pi / 6;  // rad
constexpr int mean_shifts = 5;

long cellOf(double coordinate, double cell) {
  constexpr double last = 0x1p53;  // farther cells fit into no long
  return std::lround(std::clamp(coordinate / cell, -last, last));
}

struct WeightedPose {
  PlanarPose pose;
  double weight;
};

std::vector<WeightedPose> weightedPoses(const mrpt::poses::CPosePDFParticles& particles) {
  if (particles.m_particles.empty()) throw std::invalid_argument("no particles");
  std::vector<WeightedPose> poses;
  for (const auto& particle : particles.m_particles)
    poses.push_back({{particle.d.x, particle.d.y, wrapAngle(particle.d.phi)}, std::exp(particle.log_w)});
  return poses;
}

double totalWeight(const std::vector<WeightedPose>& poses) {
  double total = 0;
  for (const WeightedPose& pose : poses) total += pose.weight;
  return total;
}

PlanarPose heaviestCell(const std::vector<WeightedPose>& poses) {
  struct Cell {
    double weight = 0;
    PlanarPose first;
  };
  std::map<std::array<long, 3>, Cell> cells;
  const Cell* heaviest = nullptr;
  for (const auto& [pose, weight] : poses) {
    Cell& cell = cells[{cellOf(pose.x, cell_position), cellOf(pose.y, cell_position),
                        (cellOf(pose.phi, cell_heading) + 12) % 12}];
    if (cell.weight == 0) cell.first = pose;
    cell.weight += weight;
    if (!heaviest || cell.weight > heaviest->weight) heaviest = &cell;
  }
  return heaviest->first;
}

Eigen::Vector3d offsetFrom(const PlanarPose& centre, const PlanarPose& pose) {
  return {pose.x - centre.x, pose.y - centre.y, wrapAngle(pose.phi - centre.phi)};
}

bool isNear(const Eigen::Vector3d& offset) {
  return offset.head<2>().norm() <= radius && std::abs(offset.z()) <= max_turn;
}

/// Mean, covariance and share of `total` of the poses about a centre.
PoseCluster clusterAround(const PlanarPose& centre, const std::vector<WeightedPose>& poses, double total) {
  double weight = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const WeightedPose& pose : poses) {
    const Eigen::Vector3d offset = offsetFrom(centre, pose.pose);
    if (!isNear(offset)) continue;
    weight += pose.weight;
    sum += pose.weight * offset;
    squares += pose.weight * offset * offset.transpose();
  }
  const Eigen::Vector3d mean = sum / weight;
  return {{centre.x + mean.x(), centre.y + mean.y(), wrapAngle(centre.phi + mean.z())},
          squares / weight - mean * mean.transpose(),
          weight / total};
}

/// And the centre that its poses lie about.
std::pair<PoseCluster, PlanarPose> heaviestCluster(const std::vector<WeightedPose>& poses, double total) {
  PlanarPose centre = heaviestCell(poses);
  PoseCluster cluster = clusterAround(centre, poses, total);
  for (int i = 1; i < mean_shifts; ++i) cluster = clusterAround(centre = cluster.robot_in_map, poses, total);
  return {cluster, centre};
}

}  // namespace

PoseCluster dominantCluster(const mrpt::poses::CPosePDFParticles& particles) {
  const std::vector<WeightedPose> poses = weightedPoses(particles);
  return heaviestCluster(poses, totalWeight(poses)).first;
}

std::vector<PoseCluster> poseClusters(const mrpt::poses::CPosePDFParticles& particles, double min_share) {
  std::vector<WeightedPose> rest = weightedPoses(particles);
  const double total = totalWeight(rest);
  std::vector<PoseCluster> clusters;
  while (!rest.empty() && (clusters.empty() || totalWeight(rest) >= min_share * total)) {
    const auto [cluster, centre] = heaviestCluster(rest, total);
    if (!clusters.empty() && cluster.share < min_share) break;
    clusters.push_back(cluster);
    std::erase_if(rest, [&](const WeightedPose& pose) { return isNear(offsetFrom(centre, pose.pose)); });
  }
  std::stable_sort(clusters.begin() + 1, clusters.end(),
                   [](const PoseCluster& a, const PoseCluster& b) { return a.share > b.share; });
  return clusters;
}

}  // namespace vmcl
