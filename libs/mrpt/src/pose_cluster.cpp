// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/pose_cluster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

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

PlanarPose heaviestCell(const mrpt::poses::CPosePDFParticles& particles) {
  struct Cell {
    double weight = 0;
    PlanarPose first;
  };
  std::map<std::array<long, 3>, Cell> cells;
  const Cell* heaviest = nullptr;
  for (const auto& particle : particles.m_particles) {
    const PlanarPose pose{particle.d.x, particle.d.y, wrapAngle(particle.d.phi)};
    Cell& cell = cells[{cellOf(pose.x, cell_position), cellOf(pose.y, cell_position),
                        (cellOf(pose.phi, cell_heading) + 12) % 12}];
    if (cell.weight == 0) cell.first = pose;
    cell.weight += std::exp(particle.log_w);
    if (!heaviest || cell.weight > heaviest->weight) heaviest = &cell;
  }
  return heaviest->first;
}

/// Mean, covariance and share of the particles about a centre.
PoseCluster clusterAround(const PlanarPose& centre, const mrpt::poses::CPosePDFParticles& particles) {
  double total = 0, weight = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const auto& particle : particles.m_particles) {
    const double w = std::exp(particle.log_w);
    total += w;
    const Eigen::Vector3d offset(particle.d.x - centre.x, particle.d.y - centre.y,
                                 wrapAngle(particle.d.phi - centre.phi));
    if (offset.head<2>().norm() > radius || std::abs(offset.z()) > max_turn) continue;
    weight += w;
    sum += w * offset;
    squares += w * offset * offset.transpose();
  }
  const Eigen::Vector3d mean = sum / weight;
  return {{centre.x + mean.x(), centre.y + mean.y(), wrapAngle(centre.phi + mean.z())},
          squares / weight - mean * mean.transpose(),
          weight / total};
}

}  // namespace

PoseCluster dominantCluster(const mrpt::poses::CPosePDFParticles& particles) {
  if (particles.m_particles.empty()) throw std::invalid_argument("no particles");
  PoseCluster cluster = clusterAround(heaviestCell(particles), particles);
  for (int i = 1; i < mean_shifts; ++i) cluster = clusterAround(cluster.robot_in_map, particles);
  return cluster;
}

}  // namespace vmcl
