// y = A x cell by cell, and what else an operator tells of its cells, against sums over the cells that are written out.
#include "chain_of_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

namespace
{
  using namespace unilateral;
  using Chain = ChainOfCells;
  using Numbers = Chain::Numbers;

  /// As many unknowns to a cell as there are kernels of their own for, and others.
  class CellOperatorOf : public testing::TestWithParam<unsigned>
  {
  };
} // namespace

TEST_P(CellOperatorOf, n_unknowns_is_the_sum_over_its_cells)
{
  Chain   chain(GetParam());
  Numbers x(chain.n_dofs), y(chain.n_dofs, 99.);
  for (auto &entry : x)
    entry = chain.uniform(chain.generator);
  for (const auto dof : chain.fixed)
    x[dof] = 0;
  chain.op->vmult(y.data(), x.data());
  const Numbers expected = chain.product(x);
  for (unsigned i = 0; i < chain.n_dofs; ++i)
    ASSERT_NEAR(y[i], expected[i], 1e-13 * GetParam()) << i;
}

TEST_P(CellOperatorOf, n_unknowns_has_the_diagonal_of_its_matrix)
{
  const Chain             chain(GetParam());
  std::set<std::uint32_t> fixed(chain.fixed.begin(), chain.fixed.end());
  Numbers                 x(chain.n_dofs, 0.);
  for (unsigned i = 0; i < chain.n_dofs; i += 3)
  {
    x[i] = 1;
    ASSERT_NEAR(chain.op->diagonal()[i], fixed.contains(i) ? 1 : chain.product(x)[i], 1e-14) << i;
    x[i] = 0;
  }
}

TEST_P(CellOperatorOf, n_unknowns_returns_what_it_was_given)
{
  const unsigned             n = GetParam();
  const Chain                chain(n);
  std::vector<std::uint32_t> dofs(n);
  Numbers                    matrix(n * n);
  for (unsigned cell = 0; cell < chain.n_cells; ++cell)
  {
    chain.op->cell_dofs(cell, dofs.data());
    chain.op->cell_matrix(cell, matrix.data());
    EXPECT_EQ(dofs, chain.dofs[cell]);
    EXPECT_EQ(matrix, chain.matrix[cell]);
    EXPECT_EQ(chain.op->dependent(cell) != nullptr, chain.is_special(cell));
  }
  EXPECT_EQ(chain.op->further_blocks().size(), 3u);
}

TEST_P(CellOperatorOf, n_unknowns_hands_flags_to_cells)
{
  const Chain                chain(GetParam());
  std::vector<unsigned char> flags(chain.n_dofs), cell_flags(chain.n_cells);
  for (unsigned i = 0; i < chain.n_dofs; ++i)
    flags[i] = i % 11 == 0 ? 1 : i % 7 == 0 ? 4 : 0;
  chain.op->collect_flags(flags.data(), cell_flags.data());
  for (unsigned cell = 0; cell < chain.n_cells; ++cell)
  {
    unsigned char expected = 0;
    for (const auto dof : chain.dofs[cell])
      expected |= flags[dof];
    EXPECT_EQ(cell_flags[cell], expected) << cell;
  }
}

TEST(CellOperator, representative_cells_have_every_matrix)
{
  const Chain chain(4);
  const auto  cells = chain.op->representative_cells(1000);
  EXPECT_EQ(cells.size(), 1u + chain.n_cells - 32);
  EXPECT_EQ(cells.front(), 0u);
  const auto sample = chain.op->representative_cells(10);
  EXPECT_LE(sample.size(), 10u);
  EXPECT_TRUE(std::includes(cells.begin(), cells.end(), sample.begin(), sample.end()));
}

INSTANTIATE_TEST_SUITE_P(All, CellOperatorOf, testing::Values(4, 5, 8, 9, 24, 27, 30));
