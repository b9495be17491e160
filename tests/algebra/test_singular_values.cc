// Singular values against the defining products.
#include "unilateral/algebra/singular_values.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

using namespace unilateral;
using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(SingularValues, of_matrices_of_any_shape)
{
  for (const auto &[m, n] : {std::pair(7, 4), std::pair(4, 7), std::pair(5, 5), std::pair(1, 3), std::pair(60, 41)})
  {
    MatrixXd M(m, n);
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < n; ++j)
        M(i, j) = std::sin(1 + 3 * i + 5 * i * j + j * j);
    const auto [values, V] = singular_values(M);
    const int k = std::min(m, n);
    ASSERT_EQ(values.size(), k);
    ASSERT_EQ(V.rows(), n);
    ASSERT_EQ(V.cols(), k);
    EXPECT_LT((V.transpose() * V - MatrixXd::Identity(k, k)).norm(), 1e-13);
    EXPECT_NEAR(values.squaredNorm(), M.squaredNorm(), 1e-12 * M.squaredNorm());
    const MatrixXd products = V.transpose() * M.transpose() * M * V;
    EXPECT_LT((products - MatrixXd(values.cwiseAbs2().asDiagonal())).norm(), 1e-12 * M.squaredNorm());
    for (int i = 0; i + 1 < k; ++i)
      EXPECT_GE(values(i), values(i + 1));
  }
}

TEST(SingularValues, of_a_matrix_without_full_rank)
{
  const VectorXd a = VectorXd::LinSpaced(6, 1, 2), b = VectorXd::LinSpaced(4, -1, 3);
  const auto     result = singular_values(a * b.transpose());
  EXPECT_NEAR(result.values(0), a.norm() * b.norm(), 1e-13);
  EXPECT_LT(result.values(1), 1e-14);
  EXPECT_NEAR(std::abs(result.right_vectors.col(0).dot(b)), b.norm(), 1e-13);
}

TEST(SingularValues, of_nothing_and_of_what_is_not_finite)
{
  EXPECT_EQ(singular_values(MatrixXd(0, 3)).values.size(), 0);
  EXPECT_EQ(singular_values(MatrixXd(3, 0)).right_vectors.size(), 0);
  MatrixXd M = MatrixXd::Ones(3, 3);
  M(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(singular_values(M), std::runtime_error);
}
