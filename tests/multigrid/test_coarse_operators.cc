// Truncated Galerkin products: A_H = P'(T (A + soft penalties) T) P, with P and A written out as matrices.
#include "both_ways.h"

#include "unilateral/multigrid/coarse_operators.h"

#include <Eigen/Dense>

#include <gtest/gtest.h>

namespace
{
  using namespace unilateral;
  using Eigen::MatrixXd;

  /// The functions of level l in terms of those of the next one.
  MatrixXd prolongation(const LevelHierarchy &hierarchy, const unsigned l)
  {
    const CellOperator        &coarse = *hierarchy.levels[l].stiffness, &fine = *hierarchy.levels[l + 1].stiffness;
    const unsigned             n = coarse.n_cell_dofs();
    std::vector<std::uint32_t> rows(n), columns(n);
    MatrixXd                   P = MatrixXd::Zero(fine.n_dofs(), coarse.n_dofs());
    for (std::size_t parent = 0; parent < coarse.n_cells(); ++parent)
    {
      const auto [first, end] = hierarchy.children(l + 1, parent);
      coarse.cell_dofs(parent, columns.data());
      for (std::size_t child = first; child < end; ++child)
      {
        fine.cell_dofs(child, rows.data());
        for (unsigned i = 0; i < n; ++i)
          for (unsigned j = 0; j < n; ++j)
            P(rows[i], columns[j]) = hierarchy.to_child[child - first][i * n + j];
      }
    }
    return P;
  }

  MatrixXd without_fixed(const CellOperator &op, MatrixXd A)
  {
    for (const auto dof : op.fixed())
    {
      A.row(dof).setZero();
      A.col(dof).setZero();
    }
    return A;
  }

  /// The sum over the cells of what each adds now.
  MatrixXd matrix_of(const MultigridLevel &level)
  {
    const unsigned             n = level.stiffness->n_cell_dofs();
    std::vector<std::uint32_t> dofs(n);
    std::vector<double>        own(n * n);
    MatrixXd                   A = MatrixXd::Zero(level.stiffness->n_dofs(), level.stiffness->n_dofs());
    for (std::size_t cell = 0; cell < level.stiffness->n_cells(); ++cell)
    {
      const auto change = level.change.empty() ? MultigridLevel::unchanged : level.change[cell];
      if (change == MultigridLevel::vanished)
        continue;
      level.stiffness->cell_dofs(cell, dofs.data());
      level.stiffness->cell_matrix(cell, own.data());
      const double *const matrix = change == MultigridLevel::unchanged ? own.data() : level.changed_matrices.data() + change * n * n;
      for (unsigned i = 0; i < n; ++i)
        for (unsigned j = 0; j < n; ++j)
          A(dofs[i], dofs[j]) += matrix[i * n + j];
    }
    return without_fixed(*level.stiffness, A);
  }

  /// Three levels of a square.
  struct SmallHierarchy
  {
    explicit SmallHierarchy(const std::string &element)
      : both("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 2\nrefine = 2\n[model]\nkind = \"membrane\"\nelement = \"" + element +
             "\"\nload = 1\n[boundary]\nleft = 0\nbottom = 0\n[constraint]\nupper = 1\n"),
        hierarchy(both.hierarchy), penalty(hierarchy, 10), operators(hierarchy)
    {
      for (const auto &level : hierarchy->levels)
        levels.emplace_back(*level.stiffness, *level.sweep, level.shared);
    }

    BothWays<2>                           both;
    std::shared_ptr<const LevelHierarchy> hierarchy;
    TangentPenalty                        penalty;
    CoarseOperators                       operators;
    std::vector<MultigridLevel>           levels;
  };

  class CoarseOperatorsOf : public testing::TestWithParam<const char *>
  {
  };
} // namespace

TEST_P(CoarseOperatorsOf, an_element_are_truncated_Galerkin_products)
{
  SmallHierarchy      small(GetParam());
  const CellOperator &finest = small.hierarchy->finest();
  MatrixXd            A = matrix_of(small.levels[2]);

  // Without a penalty each level has its own A, which on nested spaces is the Galerkin product.
  const MatrixXd P1 = prolongation(*small.hierarchy, 1), P0 = prolongation(*small.hierarchy, 0);
  small.operators.compute(small.penalty, small.levels);
  EXPECT_TRUE(small.levels[0].change.empty());
  const auto difference = [&](const unsigned l, const MatrixXd &expected)
  {
    const MultigridLevel &level = small.levels[l];
    return (matrix_of(level) - without_fixed(*level.stiffness, expected)).cwiseAbs().maxCoeff();
  };
  EXPECT_LT(difference(1, P1.transpose() * A * P1), 1e-12);

  // Near one corner all is stiff, next to it some unknowns have a soft penalty.
  std::vector<double> diagonal(finest.n_dofs(), 0.);
  const auto          nodes = small.both.assembled.problem->space.nodal_values();
  unsigned            n_stiff = 0, n_soft = 0;
  for (const auto &node : nodes)
    if (node.x[0] > 0.49 && node.x[1] > 0.49)
    {
      const bool stiff = node.x[0] + node.x[1] > 1.3;
      diagonal[node.dof] = finest.diagonal()[node.dof] * (stiff ? 1e6 : 0.5);
      ++(stiff ? n_stiff : n_soft);
    }
  ASSERT_GT(n_stiff, 5u);
  ASSERT_GT(n_soft, 5u);
  small.penalty.set(diagonal, {}, {});
  small.operators.compute(small.penalty, small.levels);
  for (std::size_t i = 0; i < diagonal.size(); ++i)
    if (small.penalty.truncates(i))
    {
      A.row(i).setZero();
      A.col(i).setZero();
    }
    else
      A(i, i) += diagonal[i];
  const MatrixXd expected = P1.transpose() * without_fixed(finest, A) * P1;
  EXPECT_LT(difference(1, expected), 1e-12);
  EXPECT_LT(difference(0, P0.transpose() * expected * P0), 1e-12);
  // Cells that are stiff all over add nothing, those far away what they did.
  const auto &change = small.levels[1].change;
  EXPECT_GT(std::count(change.begin(), change.end(), MultigridLevel::vanished), 0);
  EXPECT_GT(std::count(change.begin(), change.end(), MultigridLevel::unchanged), 4);

  // The next penalty starts from the level's own A.
  small.penalty.set(std::vector<double>(finest.n_dofs(), 0.), {}, {});
  small.operators.compute(small.penalty, small.levels);
  EXPECT_TRUE(small.levels[1].change.empty());
}

INSTANTIATE_TEST_SUITE_P(All,
                         CoarseOperatorsOf,
                         testing::Values("Q1", "Q2", "Q3", "P1", "P2", "P3"),
                         [](const auto &info) { return std::string(info.param); });

TEST(LevelHierarchy, knows_how_many_successive_cells_have_one_ancestor)
{
  LevelHierarchy hierarchy;
  hierarchy.levels.resize(5);
  EXPECT_EQ(hierarchy.refinements_of_all_cells(), 4u);
  // Levels 0 to 2 are of the whole mesh, level 3 is the own part of level 2, level 4 its refinement: two cells of the part that lie side by
  // side in the list may have different parents on level 2.
  hierarchy.cuts.emplace_back().level = 3;
  EXPECT_EQ(hierarchy.refinements_of_all_cells(), 1u);
  hierarchy.cuts.clear();
  hierarchy.places.resize(7);
  EXPECT_EQ(hierarchy.refinements_of_all_cells(), 0u);
}
