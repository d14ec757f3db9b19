// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>

namespace vmcl {

/// The entries of the inverse of a sparse symmetric matrix where its Cholesky factor is not zero, which holds all where
/// the matrix itself is not: the time is linear in the size of a matrix of bounded band (Takahashi, Fagan and Chin,
/// "Formation of a sparse bus impedance matrix and its application to short circuit study", 1973).
class SparseInverse {
 public:
  /// Of a positive definite factorization.
  explicit SparseInverse(const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>& factorization);

  /// The 3x3 block at these multiples of 3; where the factor is zero it counts as zero.
  Eigen::Matrix3d block(int row, int column) const;

 private:
  double entry(int row, int column) const;

  Eigen::SparseMatrix<double> lower_;  ///< of the permuted inverse, without its diagonal
  Eigen::VectorXd diagonal_;
  Eigen::VectorXi permuted_;  ///< place of each row
};

}  // namespace vmcl
