// Half of a matrix is all of it.
#include "unilateral/algebra/symmetric_block_matrix.h"

#include "algebra/five_point_grid.h"
#include "algebra/random_symmetric_matrix.h"

#include <gtest/gtest.h>

using namespace unilateral;

TEST(SymmetricBlockMatrix, products_are_those_of_the_whole_matrix)
{
  for (const unsigned block_size : {1u, 2u, 3u, 6u})
  {
    const RandomSymmetricMatrix random(20, block_size);
    const SymmetricBlockMatrix  A(random.matrix, block_size);
    ASSERT_EQ(A.m(), random.matrix.m());
    Vector x(A.m()), y(A.m()), expected(A.m());
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      x(i) = std::cos(i);
      y(i) = 17; // whatever was there
    }
    A.vmult(y, x);
    random.matrix.vmult(expected, x);
    y -= expected;
    EXPECT_LT(y.linfty_norm(), 1e-13 * expected.linfty_norm()) << block_size;
  }
}

TEST(SymmetricBlockMatrix, rows_and_the_whole_come_back)
{
  for (const unsigned block_size : {1u, 3u})
  {
    const RandomSymmetricMatrix random(20, block_size);
    const SymmetricBlockMatrix  A(random.matrix, block_size);
    const Eigen::MatrixXd       expected = dense(random.matrix);
    Eigen::MatrixXd             of_rows = Eigen::MatrixXd::Zero(A.m(), A.m());
    for (std::size_t row = 0; row < A.m(); ++row)
    {
      std::size_t next = 0;
      A.for_each_in_row(row,
                        [&](const std::size_t column, const double value)
                        {
                          EXPECT_GE(column, next);
                          next = column + 1;
                          of_rows(row, column) = value;
                        });
      EXPECT_EQ(A.diagonal_entry(row), expected(row, row));
    }
    EXPECT_EQ(of_rows, expected);

    dealii::SparsityPattern      pattern;
    dealii::SparseMatrix<double> whole;
    A.copy_to(pattern, whole);
    EXPECT_EQ(dense(whole), expected);
    A.copy_to(pattern, whole); // over what is there
    EXPECT_EQ(dense(whole), expected);
  }
}

TEST(SymmetricBlockMatrix, sums_of_small_matrices_are_those_of_the_whole)
{
  for (const unsigned b : {1u, 3u})
  {
    // Two cells with a node in common, one with a single unknown of a node, and a node that no cell has.
    const std::vector<std::vector<std::uint32_t>> nodes = {{3, 0, 4}, {1, 3}, {5, 1}};
    std::vector<std::size_t>                      start = {0};
    std::vector<std::uint32_t>                    groups;
    for (const auto &group : nodes)
    {
      groups.insert(groups.end(), group.begin(), group.end());
      start.push_back(groups.size());
    }
    SymmetricBlockMatrix A(b, 7, start, groups);
    EXPECT_EQ(A.n_lower_blocks(), 5u);
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(7 * b, 7 * b);
    for (std::size_t g = 0; g < nodes.size(); ++g)
    {
      std::vector<std::uint32_t> unknowns;
      for (const auto node : nodes[g])
        for (unsigned c = 0; c < (g == 2 && node == 5 ? 1 : b); ++c)
          unknowns.push_back(node * b + c);
      const Eigen::Index  n = unknowns.size();
      std::vector<double> M(n * n);
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
        {
          M[i * n + j] = std::cos(double(g + (i + 1) * (j + 1)));
          expected(unknowns[i], unknowns[j]) += M[i * n + j];
        }
      A.add(unknowns, M.data());
    }
    A.add_to_diagonal(6 * b, 2);
    expected(6 * b, 6 * b) += 2;
    dealii::SparsityPattern      pattern;
    dealii::SparseMatrix<double> whole;
    A.copy_to(pattern, whole);
    EXPECT_EQ(dense(whole), expected);
    EXPECT_EQ(A.n_nonzero_elements(), (2 * 5 + 7) * b * b);
  }
}

TEST(SymmetricBlockMatrix, of_nothing_is_empty)
{
  EXPECT_EQ(SymmetricBlockMatrix().m(), 0u);
}
