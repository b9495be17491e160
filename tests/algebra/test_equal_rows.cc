// Groups of rows that couple with the same others.
#include "unilateral/algebra/equal_rows.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace unilateral;

namespace
{
  /// Nodes in a row with three components each, every component coupled with all of the node and of its neighbours.
  class ChainOfNodes
  {
  public:
    explicit ChainOfNodes(const unsigned n_nodes)
    {
      dealii::DynamicSparsityPattern entries(3 * n_nodes, 3 * n_nodes);
      for (unsigned i = 0; i < 3 * n_nodes; ++i)
        for (unsigned j = 0; j < 3 * n_nodes; ++j)
          if (std::max(i / 3, j / 3) - std::min(i / 3, j / 3) <= 1)
            entries.add(i, j);
      pattern.copy_from(entries);
      matrix.reinit(pattern);
    }

    dealii::SparsityPattern      pattern;
    dealii::SparseMatrix<double> matrix;
  };

  std::vector<std::size_t> group(const EqualRows &groups, const unsigned g)
  {
    return {groups.rows.begin() + groups.starts[g], groups.rows.begin() + groups.starts[g + 1]};
  }

  std::vector<std::int64_t> neighbours(const EqualRows &groups, const unsigned g)
  {
    return {groups.columns.begin() + groups.column_starts[g], groups.columns.begin() + groups.column_starts[g + 1]};
  }

  using Rows = std::vector<std::size_t>;
  using Groups = std::vector<std::int64_t>;
} // namespace

TEST(EqualRows, ComponentsOfANodeMakeAGroupAndGroupsCoupleAsNodesDo)
{
  const ChainOfNodes chain(4);
  const EqualRows    groups(chain.matrix, std::vector<bool>(12, true), std::vector<bool>(12, false));
  ASSERT_EQ(groups.n(), 4u);
  EXPECT_EQ(group(groups, 0), (Rows{0, 1, 2}));
  EXPECT_EQ(group(groups, 3), (Rows{9, 10, 11}));
  EXPECT_EQ(neighbours(groups, 0), (Groups{0}));
  EXPECT_EQ(neighbours(groups, 2), (Groups{1, 2}));
}

TEST(EqualRows, RowsLeftOutOrDecoupledAreNoPartOfAGroupOfOthers)
{
  const ChainOfNodes chain(5);
  std::vector<bool>  kept(15, true), decoupled(15, false);
  kept[3] = kept[4] = kept[5] = false; // node 1: the others are those of two chains
  decoupled[7] = true;
  const EqualRows groups(chain.matrix, kept, decoupled);
  ASSERT_EQ(groups.n(), 5u);
  EXPECT_EQ(group(groups, 1), (Rows{6, 8}));
  EXPECT_EQ(group(groups, 2), (Rows{7}));
  EXPECT_EQ(neighbours(groups, 1), (Groups{1}));
  EXPECT_EQ(neighbours(groups, 2), (Groups{2}));
  EXPECT_EQ(neighbours(groups, 3), (Groups{1, 3}));
  EXPECT_EQ(neighbours(groups, 4), (Groups{3, 4}));
}
