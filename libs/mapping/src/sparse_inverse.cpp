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
  std::vector<int> place(static_cast<std::size_t>(size), -1);  // among the rows of this column
  std::vector<int> rows;
  Eigen::MatrixXd inverse;
  for (int column = size - 1; column >= 0; --column) {
    const int first = lower_.outerIndexPtr()[column];
    rows.assign(lower_.innerIndexPtr() + first, lower_.innerIndexPtr() + lower_.outerIndexPtr()[column + 1]);
    const int count = static_cast<int>(rows.size());
    for (int i = 0; i < count; ++i) place[static_cast<std::size_t>(rows[static_cast<std::size_t>(i)])] = i;
    inverse.setZero(count, count);
    for (int j = 0; j < count; ++j) {
      const int later = rows[static_cast<std::size_t>(j)];
      inverse(j, j) = diagonal_[later];
      for (Eigen::SparseMatrix<double>::InnerIterator it(lower_, later); it; ++it)
        if (const int i = place[static_cast<std::size_t>(it.row())]; i >= 0) inverse(i, j) = it.value();
    }
    for (int row : rows) place[static_cast<std::size_t>(row)] = -1;
    Eigen::Map<Eigen::VectorXd> values(lower_.valuePtr() + first, count);  // still those of the factor
    const Eigen::VectorXd factor = values;
    values.noalias() = -(inverse.selfadjointView<Eigen::Lower>() * factor);
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

}  // namespace vmcl
