// The contact pressure as a function of V_h.
#include "small_problem.h"

#include "unilateral/evaluation/nodal_pressure.h"
#include "unilateral/solve.h"

#include <gtest/gtest.h>

using namespace unilateral;

/// Flat contact under a load of 1: the pressure is 1 everywhere, though no point of the rule is a vertex.
TEST(NodalPressure, reaches_the_vertices_of_quadratic_simplices)
{
  const std::string rest =
    "cells = 6\n[model]\nkind = \"membrane\"\nelement = \"P2\"\nload = -1\n[boundary]\nall = 0\n[constraint]\nlower = 0\n";
  Diagnostics  diagnostics;
  Progress     silent;
  const auto   solution = solve<2>(problem_of(case_of("[mesh]\nbox = [[0, 0], [1, 1]]\n" + rest)), diagnostics, silent);
  const auto  &problem = *solution.problem;
  const Vector pressure = nodal_pressure(problem, solution.constraint_set, solution.constraint_set.blocks[0], solution.contact_pressure);
  unsigned     n = 0;
  for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
    for (const unsigned v : cell->vertex_indices())
      if (const auto dof = cell->vertex_dof_index(v, 0); !problem.space.dirichlet.is_constrained(dof))
      {
        EXPECT_NEAR(pressure(dof), 1, 1e-9);
        ++n;
      }
  EXPECT_GT(n, 100u);
}
