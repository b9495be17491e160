// Linear functions within V_h, on its mesh and on coarser ones.
#include "unilateral/spaces/linear_subspaces.h"

#include "small_problem.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace unilateral;

namespace
{
  /// The product of the prolongations takes a linear function from the coarsest vertices to V_h where nothing is fixed nearby.
  template <int dim>
  void expect_linear_functions_to_be_prolonged(const std::string &text, const std::size_t n_spaces)
  {
    SCOPED_TRACE(text);
    const SmallProblem<dim>   p(text);
    const FunctionSpace<dim> &space = p.problem->space;
    const LinearSubspaces     subspaces = linear_subspaces(space);
    ASSERT_EQ(subspaces.prolongations.size(), n_spaces);

    std::vector<double> exact(space.dof_handler.n_dofs());
    for (const auto &node : space.nodal_values())
      exact[node.dof] = node.x[0] * (1 + node.component) + 2 * node.x[dim - 1]; // vanishes where the boundary is fixed: at the origin
    std::vector<double> values;
    for (const auto dof : subspaces.at_vertex.back())
      values.push_back(exact[dof]);
    for (auto P = subspaces.prolongations.rbegin(); P != subspaces.prolongations.rend(); ++P)
    {
      ASSERT_EQ(P->n_columns, values.size());
      std::vector<double> finer(P->size());
      for (std::size_t i = 0; i < P->size(); ++i)
        for (std::size_t k = P->row_start[i]; k < P->row_start[i + 1]; ++k)
          finer[i] += P->values[k] * values[P->columns[k]];
      values = std::move(finer);
    }
    ASSERT_EQ(values.size(), exact.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_NEAR(values[i], space.dirichlet.is_constrained(i) && !space.hanging_nodes.is_constrained(i) ? 0 : exact[i], 1e-13)
        << "unknown " << i;
  }

  std::string body(const std::string &mesh, const std::string &element, const std::string &box = "[[0, 0, 0], [1, 1, 1]]")
  {
    return "[mesh]\nbox = " + box + "\ncells = 2\n" + mesh + "\n[model]\nkind = \"elasticity\"\nelement = \"" + element +
           "\"\nyoung = 1\npoisson = 0.3\n[boundary]\nbottom = { spring = 1 }\n[constraint]\non = \"top\"\ngap = 1\n";
  }
} // namespace

TEST(LinearSubspaces, lower_the_degree)
{
  expect_linear_functions_to_be_prolonged<3>(body("", "P2"), 1);
#ifndef DEBUG // deal.II's FESystem asserts what does not hold for triangular faces with nodes
  expect_linear_functions_to_be_prolonged<3>(body("", "P3"), 1);
#endif
  expect_linear_functions_to_be_prolonged<3>(body("", "Q2"), 1);
  expect_linear_functions_to_be_prolonged<2>(body("", "Q3", "[[0, 0], [1, 1]]"), 1);
}

TEST(LinearSubspaces, go_back_through_the_meshes_of_simplices)
{
  expect_linear_functions_to_be_prolonged<3>(body("refine = 2", "P1"), 2);
  expect_linear_functions_to_be_prolonged<3>(body("refine = 1", "P2"), 2);
  expect_linear_functions_to_be_prolonged<2>(body("refine = 2", "P2", "[[0, 0], [1, 1]]"), 3);
}

TEST(LinearSubspaces, meet_homogeneous_conditions)
{
  const SmallProblem<2> p("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 4\nrefine = 1\n[model]\nkind = \"membrane\"\nelement = \"P2\"\n"
                          "[boundary]\nall = 1\n[constraint]\nupper = 1\n");
  const auto            subspaces = linear_subspaces(p.problem->space);
  for (const auto &P : subspaces.prolongations)
    for (const double value : P.values)
      EXPECT_GT(value, 0.4);
  const auto &last = subspaces.prolongations.back();
  for (const auto column : last.columns)
    EXPECT_FALSE(p.problem->space.dirichlet.is_constrained(subspaces.at_vertex.back()[column]));
}
