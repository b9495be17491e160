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

TEST(SymmetricBlockMatrix, of_nothing_is_empty)
{
  EXPECT_EQ(SymmetricBlockMatrix().m(), 0u);
}
