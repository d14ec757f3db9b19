// SPDX-License-Identifier: BSD-3-Clause
#include "sparse_inverse.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "vmcl/geometry/random.h"

namespace vmcl {
namespace {

// Random sparse matrices of 3x3 blocks: a chain, a few loops, and a last block that all depend on.
TEST(SparseInverse, HasTheBlocksOfTheDenseInverse) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const int blocks = 12;
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(3 * blocks, 3 * blocks);
    std::vector<std::pair<int, int>> places;
    const auto couple = [&](int a, int b) {
      const Eigen::MatrixXd J = Eigen::MatrixXd::NullaryExpr(4, 6, [&] { return random.normal(); });
      const Eigen::MatrixXd H = J.transpose() * J;
      A.block<3, 3>(3 * a, 3 * a) += H.topLeftCorner<3, 3>();
      A.block<3, 3>(3 * b, 3 * b) += H.bottomRightCorner<3, 3>();
      A.block<3, 3>(3 * a, 3 * b) += H.topRightCorner<3, 3>();
      A.block<3, 3>(3 * b, 3 * a) += H.bottomLeftCorner<3, 3>();
      places.insert(places.end(), {{a, b}, {b, a}, {a, a}, {b, b}});
    };
    for (int a = 0; a + 1 < blocks; ++a) couple(a, a + 1), couple(a, blocks - 1);
    couple(0, static_cast<int>(random.below(blocks - 2)) + 1);
    A.diagonal().array() += 0.1;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factorization(A.sparseView());
    const SparseInverse inverse(factorization);
    const Eigen::MatrixXd expected = A.inverse();
    for (const auto& [a, b] : places)
      EXPECT_TRUE(inverse.block(3 * a, 3 * b).isApprox(expected.block<3, 3>(3 * a, 3 * b), 1e-9)) << a << ' ' << b;
  }
}

}  // namespace
}  // namespace vmcl
