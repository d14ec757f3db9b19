// SPDX-License-Identifier: BSD-3-Clause
#include "sparse_inverse.h"

#include <algorithm>
#include <vector>

namespace vmcl {

// With A = L D L^T and L of unit diagonal, A^-1 = D^-1 L^-1 - (L^T - 1) A^-1: from the last column to the first, each
// entry follows from such later ones as lie where L is not zero.
SparseInverse::SparseInverse(const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>& factorization)
    : lower_(Eigen::SparseMatrix<double>(factorization.matrixL()).triangularView<Eigen::StrictlyLower>()),
      diagonal_(factorization.vectorD().cwiseInverse()),
      permuted_(factorization.permutationP().indices()) {
  const int size = static_cast<int>(diagonal_.size());
  std::vector<int> rows;
  Eigen::VectorXd factor;
  Eigen::MatrixXd inverse;
  for (int column = size - 1; column >= 0; --column) {
    rows.clear();
    for (Eigen::SparseMatrix<double>::InnerIterator it(lower_, column); it; ++it)
      rows.push_back(static_cast<int>(it.row()));
    const int count = static_cast<int>(rows.size());
    factor.resize(count);
    inverse.resize(count, count);
    const SparseInverse& known = *this;
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < i; ++j)
        inverse(i, j) = inverse(j, i) =
            known.entry(rows[static_cast<std::size_t>(i)], rows[static_cast<std::size_t>(j)]);
      inverse(i, i) = diagonal_[rows[static_cast<std::size_t>(i)]];
      factor[i] = known.entry(rows[static_cast<std::size_t>(i)], column);
    }
    const Eigen::VectorXd values = -inverse * factor;
    for (int i = 0; i < count; ++i) entry(rows[static_cast<std::size_t>(i)], column) = values[i];
    diagonal_[column] -= factor.dot(values);
  }
}

Eigen::Matrix3d SparseInverse::block(int row, int column) const {
  Eigen::Matrix3d block;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      const int a = permuted_[row + i], b = permuted_[column + j];
      block(i, j) = a == b ? diagonal_[a] : entry(std::max(a, b), std::min(a, b));
    }
  return block;
}

double SparseInverse::entry(int row, int column) const {
  const int* first = lower_.innerIndexPtr() + lower_.outerIndexPtr()[column];
  const int* last = lower_.innerIndexPtr() + lower_.outerIndexPtr()[column + 1];
  const int* found = std::lower_bound(first, last, row);
  return found != last && *found == row ? lower_.valuePtr()[found - lower_.innerIndexPtr()] : 0;
}

double& SparseInverse::entry(int row, int column) {
  const int* first = lower_.innerIndexPtr() + lower_.outerIndexPtr()[column];
  const int* last = lower_.innerIndexPtr() + lower_.outerIndexPtr()[column + 1];
  return lower_.valuePtr()[std::lower_bound(first, last, row) - lower_.innerIndexPtr()];
}

}  // namespace vmcl
