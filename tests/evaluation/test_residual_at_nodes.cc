// The residual of a membrane from the forms on its cells, beside what the solver makes of it.
#include "small_problem.h"

#include "unilateral/evaluation/residual_at_nodes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace unilateral;

namespace
{
  const std::string membrane = "mesh.box = [[0, 0], [1, 1]]\nmesh.cells = 6\nboundary.all = \"0.1*x\"\nconstraint.lower = -0.1\n"
                               "[[mesh.local]]\nwhere = \"x < 0.4\"\n";

  struct Solved : SmallProblem<2>
  {
    explicit Solved(const std::string &text) : SmallProblem<2>(text)
    {
      u = zero_dofs();
      lambda = zero_points();
      Progress   quiet;
      const auto outcome = method_of_multipliers(*discrete, {}, {}, u, lambda, quiet);
      EXPECT_TRUE(outcome.converged) << outcome.reason;
      problem->space.dirichlet.distribute(u);
    }

    double residual() const { return residual_at_nodes(*problem, constraint_set, u, lambda); }

    std::vector<dealii::types::global_dof_index> free_nodes() const
    {
      std::vector<dealii::types::global_dof_index> nodes;
      for (dealii::types::global_dof_index dof = 0; dof < u.size(); ++dof)
        if (!problem->space.dirichlet.is_constrained(dof))
          nodes.push_back(dof);
      return nodes;
    }

    Vector u, lambda;
  };
} // namespace

TEST(ResidualAtNodes, is_zero_for_solutions)
{
  for (const std::string model : {"", "reaction = 3\nelement = \"Q2\"\n", "velocity = [3, 1]\n", "element = \"P2\"\n"})
  {
    const Solved solved(membrane + "[model]\nkind = \"membrane\"\nload = -4\n" + model);
    EXPECT_LT(solved.residual(), 1e-7) << model;
  }
}

TEST(ResidualAtNodes, is_the_energy_norm_of_a_change_at_a_node_or_less)
{
  Solved     solved(membrane + "[model]\nkind = \"membrane\"\nload = -4\n");
  const auto nodes = solved.free_nodes();
  ASSERT_FALSE(nodes.empty());
  for (const auto dof : nodes)
  {
    Vector change = solved.zero_dofs(), of_change(change);
    change(dof) = 1e-3;
    solved.discrete->apply_stiffness(of_change, change);
    const double norm = std::sqrt(solved.discrete->dot(change, of_change));
    const Vector before(solved.u);
    solved.u += change;
    solved.problem->space.dirichlet.distribute(solved.u);
    EXPECT_GE(solved.residual(), 0.9 * norm); // at the node alone it is as much
    EXPECT_LE(solved.residual(), 3 * norm);
    solved.u = before;
  }
}

TEST(ResidualAtNodes, is_large_where_a_pressure_is_missing)
{
  Solved solved(membrane + "[model]\nkind = \"membrane\"\nload = -4\n");
  solved.lambda *= 0.9;
  EXPECT_GT(solved.residual(), 5e-3);
}
