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

constexpr std::size_t blocks_seen_from = 5;  // of three values, that an observation depends on beside its point

/// Their numbers: for each keyframe the two of its stand, then for each camera the three of its correction.
std::array<int, blocks_seen_from> blocksOf(const Reconstruction& scene, int keyframe) {
  const int camera = scene.keyframes[static_cast<std::size_t>(keyframe)].camera;
  const int rotation = 2 * static_cast<int>(scene.keyframes.size()) + 3 * camera;
  return {2 * keyframe, 2 * keyframe + 1, rotation, rotation + 1, rotation + 2};
}

/// Derivatives of what an observation says, pixel and depth, in standard deviations: by its blocks and last by the
/// point. Weighted as the robust loss weighs them.
Eigen::Matrix<double, 3, 18> derivatives(const Reconstruction& scene, const MeasurementNoise& noise,
                                         const Observation& seen, const Eigen::Vector3d& point_in_map) {
  const auto k = static_cast<std::size_t>(seen.keyframe);
  const auto camera = static_cast<std::size_t>(scene.keyframes[k].camera);
  const Stand stand = standOf(scene, k);
  const CorrectionVector correction = correctionVector(scene.corrections[camera]);
  const MeasuringCamera from{&scene.cameras[camera], &scene.level_from_robot[k]};
  Eigen::Matrix<double, 3, 18> all;
  const Linearized<2> pixel =
      PixelMeasurement{from, scene.distortedPixel(seen), noise.pixel}.linearize(stand, correction, point_in_map);
  all.topRows<2>() << pixel.by_stand, pixel.by_correction, pixel.by_point;
  all.topRows<2>() *= huberWeight(pixel.error.norm());
  all.row(2).setZero();
  if (const double depth = scene.depth(seen); depth > 0) {
    const Linearized<1> measured =
        DepthMeasurement{from, depth, noise.inverse_depth}.linearize(stand, correction, point_in_map);
    all.row(2) << measured.by_stand, measured.by_correction, measured.by_point;
    all.row(2) *= huberWeight(std::abs(measured.error[0]));
  }
  return all;
}

PointEquations linearize(const Reconstruction& scene, const MeasurementNoise& noise, const ScenePoint& point) {
  PointEquations equations;
  for (const Observation& seen : point.track) {
    const Eigen::Matrix<double, 3, 18> J = derivatives(scene, noise, seen, point.point_in_map);
    const Eigen::Matrix<double, 18, 18> information = J.transpose() * J;
    equations.information += information.bottomRightCorner<3, 3>();
    const auto blocks = blocksOf(scene, seen.keyframe);
    for (std::size_t a = 0; a < blocks.size(); ++a) {
      const auto row = static_cast<Eigen::Index>(3 * a);
      equations.coupling.try_emplace(blocks[a], Block::Zero()).first->second += information.block<3, 3>(row, 15);
      for (std::size_t b = 0; b <= a; ++b)
        equations.of_the_poses.try_emplace({blocks[a], blocks[b]}, Block::Zero()).first->second +=
            information.block<3, 3>(row, static_cast<Eigen::Index>(3 * b));
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
  const int blocks = of_keyframes + 3 * static_cast<int>(scene.cameras.size());
  BlockMatrix pose_information(blocks);
  const auto addPrior = [&](int first, const auto& weights) {
    for (int i = 0; i < weights.size() / 3; ++i)
      pose_information.add(first + i, first + i, weights.template segment<3>(3 * i).cwiseAbs2().asDiagonal());
  };
  for (int first = 0; first < of_keyframes; first += 2) addPrior(first, noise.standWeights());
  for (int first = of_keyframes; first < blocks; first += 3) addPrior(first, noise.correctionWeights());

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
      for (const auto& [b, other_answer] : equations[i].coupling) {
        if (b > a) break;
        const Block part = answer * pose_covariance.block(3 * a, 3 * b) * other_answer.transpose();
        covariances[i] += a == b ? part : Block(part + part.transpose());
      }
  for (Block& covariance : covariances) covariance = (covariance + covariance.transpose()).eval() / 2;
  return covariances;
}

}  // namespace vmcl
