// SPDX-License-Identifier: BSD-3-Clause
#include "landmark_covariance.h"

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <array>
#include <map>
#include <stdexcept>

#include "reprojection_residual.h"

// With V the information of a point given the poses, W_b the coupling of pose or camera block b to it, and S the
// information of all blocks with the points eliminated (Schur complement),
//   covariance = V^-1 + sum over blocks a, b of (V^-1 W_a^T) S^-1_ab (V^-1 W_b^T)^T.

namespace vmcl {
namespace {

using Block = Eigen::Matrix3d;

/// A point's part of the normal equations.
struct PointEquations {
  Block information = Block::Zero();
  std::map<int, Block> coupling;  // pose or camera block by point
};

/// The lower triangle of a symmetric matrix of 3x3 blocks.
class BlockMatrix {
 public:
  explicit BlockMatrix(int blocks) : blocks_(blocks) {}

  void add(int row, int column, const Block& block) {
    if (row < column) return;
    const auto [entry, is_new] = entries_.try_emplace({column, row}, block);
    if (!is_new) entry->second += block;
  }

  Eigen::SparseMatrix<double> toSparse() const {
    std::vector<Eigen::Triplet<double>> triplets;
    for (const auto& [place, block] : entries_)
      for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
          triplets.emplace_back(3 * place.second + row, 3 * place.first + column, block(row, column));
    Eigen::SparseMatrix<double> matrix(3 * blocks_, 3 * blocks_);
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    return matrix;
  }

 private:
  int blocks_;
  std::map<std::pair<int, int>, Block> entries_;
};

/// Numbers of the blocks that an observation depends on: keyframes, then for each camera its corrections.
std::array<int, 5> blocksOf(const Reconstruction& scene, int keyframe) {
  const int camera = scene.keyframes[static_cast<std::size_t>(keyframe)].camera;
  const int rotation = static_cast<int>(scene.keyframes.size()) + 4 * camera;
  return {keyframe, rotation, rotation + 1, rotation + 2, rotation + 3};
}

PointEquations linearize(const Reconstruction& scene, const AdjustmentNoise& noise, const ScenePoint& point,
                         BlockMatrix& pose_information) {
  PointEquations equations;
  for (const Observation& seen : point.track) {
    const auto k = static_cast<std::size_t>(seen.keyframe);
    const auto camera = static_cast<std::size_t>(scene.keyframes[k].camera);
    const ReprojectionCost cost(
        new ReprojectionResidual{&scene.cameras[camera], scene.distortedPixel(seen), noise.pixel});
    const PlanarPose& pose = scene.map_from_robot[k];
    const double pose_values[] = {pose.x, pose.y, pose.phi};
    const CameraCorrection& correction = scene.corrections[camera];
    const double* values[] = {pose_values,
                              correction.rotation.data(),
                              correction.shift.data(),
                              correction.lens.data(),
                              correction.radial.data(),
                              point.point_in_map.data()};
    Eigen::Vector2d residual;
    std::array<Eigen::Matrix<double, 2, 3, Eigen::RowMajor>, 6> J;
    double* jacobians[] = {J[0].data(), J[1].data(), J[2].data(), J[3].data(), J[4].data(), J[5].data()};
    cost.Evaluate(values, residual.data(), jacobians);
    equations.information += J[5].transpose() * J[5];
    const std::array<int, 5> blocks = blocksOf(scene, seen.keyframe);
    for (std::size_t a = 0; a < 5; ++a) {
      equations.coupling.try_emplace(blocks[a], Block::Zero()).first->second += J[a].transpose() * J[5];
      for (std::size_t b = 0; b <= a; ++b) pose_information.add(blocks[a], blocks[b], J[a].transpose() * J[b]);
    }
  }
  return equations;
}

/// Replaces each coupling W_b by V^-1 W_b^T, the point's answer to the block, having taken W_a V^-1 W_b^T out of the
/// poses' information. Returns V^-1.
Block eliminate(PointEquations& equations, BlockMatrix& pose_information) {
  const Block inverse = equations.information.ldlt().solve(Block::Identity());
  for (const auto& [a, W_a] : equations.coupling)
    for (const auto& [b, W_b] : equations.coupling)
      if (a >= b) pose_information.add(a, b, -W_a * inverse * W_b.transpose());
  for (auto& [block, coupling] : equations.coupling) coupling = (inverse * coupling.transpose()).eval();
  return inverse;
}

}  // namespace

std::vector<Eigen::Matrix3d> pointCovariances(const Reconstruction& scene, const AdjustmentNoise& noise) {
  const int keyframes = static_cast<int>(scene.keyframes.size());
  const int blocks = keyframes + 4 * static_cast<int>(scene.cameras.size());
  BlockMatrix pose_information(blocks);
  const auto squared = [](const Eigen::Vector3d& weights) { return Block(weights.cwiseAbs2().asDiagonal()); };
  for (int i = 0; i < keyframes; ++i) pose_information.add(i, i, squared(noise.poseWeights()));
  for (int i = keyframes; i < blocks; i += 4) {
    pose_information.add(i, i, squared(noise.mountRotationWeights()));
    pose_information.add(i + 1, i + 1, squared(noise.mountShiftWeights()));
    pose_information.add(i + 2, i + 2, squared(noise.lensWeights()));
    pose_information.add(i + 3, i + 3, squared(noise.radialWeights()));
  }

  std::vector<Block> covariances;
  std::vector<PointEquations> equations;
  std::vector<std::vector<std::size_t>> points_of_block(static_cast<std::size_t>(blocks));
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    equations.push_back(linearize(scene, noise, scene.points[i], pose_information));
    covariances.push_back(eliminate(equations.back(), pose_information));
    for (const auto& entry : equations.back().coupling)
      points_of_block[static_cast<std::size_t>(entry.first)].push_back(i);
  }

  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> pose_solver(pose_information.toSparse());
  if (pose_solver.info() != Eigen::Success || !(pose_solver.vectorD().minCoeff() > 0))
    throw std::runtime_error(
        "the map's covariance cannot be computed: the poses' information is not positive definite");
  for (int b = 0; b < blocks; ++b) {
    Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(3 * blocks, 3);
    unit.middleRows<3>(3 * b).setIdentity();
    const Eigen::MatrixXd pose_covariance = pose_solver.solve(unit);
    for (std::size_t i : points_of_block[static_cast<std::size_t>(b)])
      for (const auto& [a, answer] : equations[i].coupling)
        covariances[i] += answer * pose_covariance.middleRows<3>(3 * a) * equations[i].coupling.at(b).transpose();
  }
  for (Block& covariance : covariances) covariance = (covariance + covariance.transpose()).eval() / 2;
  return covariances;
}

}  // namespace vmcl
