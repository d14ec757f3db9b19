// SPDX-License-Identifier: BSD-3-Clause
#include "landmark_covariance.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "measurement_residuals.h"
#include "sparse_inverse.h"

// With V the information of a point given the poses, W_b the coupling of pose or camera block b to it, and S the
// information of all blocks with the points eliminated (Schur complement),
//   covariance = V^-1 + sum over blocks a, b of (V^-1 W_a^T) S^-1_ab (V^-1 W_b^T)^T.

namespace vmcl {
namespace {

using Block = Eigen::Matrix3d;

/// Square root of the weight of a residual of so many standard deviations in the normal equations.
double huberWeight(double deviations) { return std::sqrt(std::min(1.0, huber_threshold / deviations)); }

/// A point's part of the normal equations.
struct PointEquations {
  Block information = Block::Zero();
  std::map<int, Block> coupling;                      // pose or camera block by point
  std::map<std::pair<int, int>, Block> of_the_poses;  // poses and cameras by themselves

  /// Whether the observations fix the point, given the poses. One that the adjustment drove far off or behind a camera
  /// is not, and its equations are noise.
  bool isPointFixed() const {
    constexpr double least = 1e-10;  // of the information's smallest eigenvalue over the largest
    if (!information.allFinite()) return false;
    const Eigen::SelfAdjointEigenSolver<Block> eigen(information, Eigen::EigenvaluesOnly);
    return eigen.eigenvalues()[0] > least * eigen.eigenvalues()[2];
  }
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

/// Numbers of the blocks that an observation depends on: for each keyframe its pose and stance, then for each camera
/// its corrections.
std::array<int, 6> blocksOf(const Reconstruction& scene, int keyframe) {
  const int camera = scene.keyframes[static_cast<std::size_t>(keyframe)].camera;
  const int rotation = 2 * static_cast<int>(scene.keyframes.size()) + 4 * camera;
  return {2 * keyframe, 2 * keyframe + 1, rotation, rotation + 1, rotation + 2, rotation + 3};
}

/// Derivatives of what an observation says, pixel and depth, in standard deviations: by its blocks and last by the
/// point. Weighted as the robust loss weighs them.
std::array<Block, 7> derivatives(const Reconstruction& scene, const MeasurementNoise& noise, const Observation& seen,
                                 const Eigen::Vector3d& point_in_map) {
  const auto k = static_cast<std::size_t>(seen.keyframe);
  const auto camera = static_cast<std::size_t>(scene.keyframes[k].camera);
  const PlanarPose& pose = scene.map_from_robot[k];
  const double pose_values[] = {pose.x, pose.y, pose.phi};
  const CameraCorrection& given = scene.corrections[camera];
  const MeasuringCamera from{&scene.cameras[camera], &scene.level_from_robot[k]};
  const double* values[] = {pose_values,       scene.stance[k].data(), given.rotation.data(), given.shift.data(),
                            given.lens.data(), given.radial.data(),    point_in_map.data()};
  const ReprojectionCost reprojection(new ReprojectionResidual{from, scene.distortedPixel(seen), noise.pixel});
  Eigen::Vector2d pixel_error;
  std::array<Eigen::Matrix<double, 2, 3, Eigen::RowMajor>, 7> pixel_by;
  std::array<double*, 7> pixel_jacobians;
  for (std::size_t i = 0; i < 7; ++i) pixel_jacobians[i] = pixel_by[i].data();
  reprojection.Evaluate(values, pixel_error.data(), pixel_jacobians.data());
  std::array<Block, 7> all;
  for (std::size_t i = 0; i < 7; ++i)
    all[i] << huberWeight(pixel_error.norm()) * pixel_by[i], Eigen::RowVector3d::Zero();

  if (const double depth = scene.depth(seen); depth > 0) {
    const DepthCost cost(new DepthResidual{from, depth, noise.inverse_depth});
    const std::array<std::size_t, 5> depends_on = {0, 1, 2, 3, 6};
    const double* depth_values[] = {values[0], values[1], values[2], values[3], values[6]};
    double error = 0;
    std::array<Eigen::RowVector3d, 5> depth_by;
    double* depth_jacobians[] = {depth_by[0].data(), depth_by[1].data(), depth_by[2].data(), depth_by[3].data(),
                                 depth_by[4].data()};
    cost.Evaluate(depth_values, &error, depth_jacobians);
    for (std::size_t i = 0; i < 5; ++i) all[depends_on[i]].row(2) = huberWeight(std::abs(error)) * depth_by[i];
  }
  return all;
}

PointEquations linearize(const Reconstruction& scene, const MeasurementNoise& noise, const ScenePoint& point) {
  PointEquations equations;
  for (const Observation& seen : point.track) {
    const std::array<Block, 7> J = derivatives(scene, noise, seen, point.point_in_map);
    equations.information += J[6].transpose() * J[6];
    const std::array<int, 6> blocks = blocksOf(scene, seen.keyframe);
    for (std::size_t a = 0; a < 6; ++a) {
      equations.coupling.try_emplace(blocks[a], Block::Zero()).first->second += J[a].transpose() * J[6];
      for (std::size_t b = 0; b <= a; ++b)
        equations.of_the_poses.try_emplace({blocks[a], blocks[b]}, Block::Zero()).first->second +=
            J[a].transpose() * J[b];
    }
  }
  return equations;
}

/// Puts the point's part into the poses' information. Replaces each coupling W_b by V^-1 W_b^T, the point's answer to
/// the block, having taken W_a V^-1 W_b^T out of the poses' information. Returns V^-1.
Block eliminate(PointEquations& equations, BlockMatrix& pose_information) {
  for (const auto& [place, block] : equations.of_the_poses) pose_information.add(place.first, place.second, block);
  equations.of_the_poses.clear();
  const Block inverse = equations.information.ldlt().solve(Block::Identity());
  for (const auto& [a, W_a] : equations.coupling)
    for (const auto& [b, W_b] : equations.coupling)
      if (a >= b) pose_information.add(a, b, -W_a * inverse * W_b.transpose());
  for (auto& [block, coupling] : equations.coupling) coupling = (inverse * coupling.transpose()).eval();
  return inverse;
}

}  // namespace

std::vector<Eigen::Matrix3d> pointCovariances(const Reconstruction& scene, const AdjustmentNoise& noise) {
  const int of_keyframes = 2 * static_cast<int>(scene.keyframes.size());
  const int blocks = of_keyframes + 4 * static_cast<int>(scene.cameras.size());
  BlockMatrix pose_information(blocks);
  const auto squared = [](const Eigen::Vector3d& weights) { return Block(weights.cwiseAbs2().asDiagonal()); };
  for (int i = 0; i < of_keyframes; i += 2) {
    pose_information.add(i, i, squared(noise.poseWeights()));
    pose_information.add(i + 1, i + 1, squared(noise.stanceWeights()));
  }
  for (int i = of_keyframes; i < blocks; i += 4) {
    pose_information.add(i, i, squared(noise.mountRotationWeights()));
    pose_information.add(i + 1, i + 1, squared(noise.mountShiftWeights()));
    pose_information.add(i + 2, i + 2, squared(noise.lensWeights()));
    pose_information.add(i + 3, i + 3, squared(noise.radialWeights()));
  }

  std::vector<Block> covariances;
  std::vector<PointEquations> equations;
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    equations.push_back(linearize(scene, noise.measurement, scene.points[i]));
    if (equations.back().isPointFixed()) {
      covariances.push_back(eliminate(equations.back(), pose_information));
    } else {
      covariances.push_back(Block::Constant(std::numeric_limits<double>::infinity()));
      equations.back() = {};
    }
  }

  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> pose_solver(pose_information.toSparse());
  if (pose_solver.info() != Eigen::Success || !(pose_solver.vectorD().minCoeff() > 0))
    throw std::runtime_error(
        "the map's covariance cannot be computed: the poses' information is not positive definite");
  const SparseInverse pose_covariance(pose_solver);
  for (std::size_t i = 0; i < scene.points.size(); ++i)
    for (const auto& [a, answer] : equations[i].coupling)
      for (const auto& [b, other_answer] : equations[i].coupling)
        covariances[i] += answer * pose_covariance.block(3 * a, 3 * b) * other_answer.transpose();
  for (Block& covariance : covariances) covariance = (covariance + covariance.transpose()).eval() / 2;
  return covariances;
}

}  // namespace vmcl
