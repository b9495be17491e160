// What a linearised inequality adds to A: a diagonal, blocks at nodes and in cells; and the directions in which a node is truncated.
#include "multigrid/chain_of_cells.h"
#include "unilateral/multigrid/tangent_penalty.h"

#include <gtest/gtest.h>

#include <utility>

namespace
{
  using namespace unilateral;
  using Numbers = ChainOfCells::Numbers;

  std::shared_ptr<LevelHierarchy> only_level(ChainOfCells &chain)
  {
    auto hierarchy = std::make_shared<LevelHierarchy>();
    hierarchy->levels.emplace_back().stiffness = std::move(chain.op);
    return hierarchy;
  }
} // namespace

TEST(TangentPenalty, is_the_sum_of_its_parts)
{
  ChainOfCells   chain(4);
  TangentPenalty penalty(only_level(chain), 10);
  Numbers        x(chain.n_dofs), diagonal(chain.n_dofs, 0.);
  for (auto &entry : x)
    entry = chain.uniform(chain.generator);
  EXPECT_TRUE(penalty.empty());
  penalty.set(Numbers(chain.n_dofs, 9.), {}, {}); // forgotten with the next
  diagonal[3] = 2;
  const DenseBlock node{{20, 21}, {2, 1, 1, 3}};
  const auto       in_cells = chain.symmetric_matrix(), in_dependent = chain.symmetric_matrix();
  penalty.set(diagonal, {node}, {{40, in_dependent}, {6, in_cells}});
  EXPECT_FALSE(penalty.empty());
  EXPECT_EQ(penalty.unknowns(), std::vector<std::uint32_t>({3}));
  EXPECT_EQ(penalty.cells()[0].cell, 6u); // in ascending order

  Numbers y(chain.n_dofs, 1.), expected = y;
  penalty.add(y.data(), x.data(), 0.5);
  expected[3] += 0.5 * 2 * x[3];
  expected[20] += 0.5 * (2 * x[20] + x[21]);
  expected[21] += 0.5 * (x[20] + 3 * x[21]);
  for (unsigned i = 0; i < 4; ++i)
    for (unsigned j = 0; j < 4; ++j)
    {
      expected[chain.dofs[6][i]] += 0.5 * in_cells[4 * i + j] * x[chain.dofs[6][j]];
      // The last unknown of the other cell lies between its neighbour and one of the first cell.
      const auto  &dofs = chain.dofs[40];
      const double x_j = j < 3 ? x[dofs[j]] : 0.75 * x[dofs[2]] + 0.25 * x[chain.number[2]], term = 0.5 * in_dependent[4 * i + j] * x_j;
      expected[i < 3 ? dofs[i] : dofs[2]] += i < 3 ? term : 0.75 * term;
      expected[chain.number[2]] += i < 3 ? 0 : 0.25 * term;
    }
  for (unsigned i = 0; i < chain.n_dofs; ++i)
    EXPECT_NEAR(y[i], expected[i], 1e-13) << i;
}

TEST(TangentPenalty, truncates_what_is_much_stiffer)
{
  ChainOfCells   chain(4);
  const auto     hierarchy = only_level(chain);
  TangentPenalty penalty(hierarchy, 10);
  const auto    &a_ii = hierarchy->finest().diagonal();
  Numbers        diagonal(chain.n_dofs, 0.);
  for (unsigned i = 0; i < chain.n_dofs; ++i)
    diagonal[i] = a_ii[i] * (i % 2 ? 11 : 9);
  penalty.set(diagonal, {}, {});
  for (unsigned i = 0; i < chain.n_dofs; ++i)
    EXPECT_TRUE(a_ii[i] <= 0 || penalty.truncates(i) == (i % 2 == 1)) << i;
}

TEST(NodePenalty, leaves_the_directions_free_that_are_not_stiff)
{
  ChainOfCells chain(4);
  // Stiff along (3, 4)/5, a little along (-4, 3)/5.
  const double stiff = 1e6, soft = 0.5,
               P[] = {(9 * stiff + 16 * soft) / 25, (stiff - soft) * 12 / 25, (stiff - soft) * 12 / 25, (16 * stiff + 9 * soft) / 25};
  const auto                &a_ii = chain.op->diagonal();
  const auto                 positive = [&](const unsigned i) { return a_ii[i] > 0.1; };
  std::vector<std::uint32_t> dofs;
  for (unsigned i = 0; dofs.size() < 2; ++i)
    if (positive(i))
      dofs.push_back(i);
  NodePenalty nodes;
  nodes.set({{dofs, {P, P + 4}}}, *chain.op, {}, 100);
  EXPECT_EQ(nodes.of_dof(dofs[1]), 0);
  EXPECT_EQ(nodes.of_dof(chain.n_dofs - 1), -1);
  const auto  &node = nodes.all().at(0);
  const double free[] = {16. / 25, -12. / 25, -12. / 25, 9. / 25};
  for (unsigned i = 0; i < 2; ++i)
    for (unsigned j = 0; j < 2; ++j)
    {
      const unsigned k = 2 * i + j;
      EXPECT_NEAR(node.free[k], free[k], 1e-9);
      EXPECT_NEAR(node.soft[k], soft * free[k], 1e-6);
      EXPECT_NEAR(node.factor[2 * i] * node.factor[2 * j] + node.factor[2 * i + 1] * node.factor[2 * j + 1], P[k], 1e-13 * stiff);
    }
  // x along the stiff direction, and (P + diag(A))^-1 of a load across it.
  Numbers x(chain.n_dofs, 0.), y(chain.n_dofs, 0.);
  x[dofs[0]] = 3;
  x[dofs[1]] = 4;
  nodes.add(y.data(), x.data(), 2);
  EXPECT_NEAR(y[dofs[0]], 6 * stiff, 1e-9 * stiff);
  EXPECT_NEAR(y[dofs[1]], 8 * stiff, 1e-9 * stiff);
  const double across = soft + (16 * a_ii[dofs[0]] + 9 * a_ii[dofs[1]]) / 25;
  EXPECT_NEAR((-4 * node.inverse[0] + 3 * node.inverse[1]) / -4 * across, 1, 1e-4);
  nodes.set({}, *chain.op, {}, 100);
  EXPECT_TRUE(nodes.empty());
  EXPECT_EQ(nodes.of_dof(dofs[0]), -1);
}
