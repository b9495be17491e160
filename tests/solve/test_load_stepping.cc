// Steps of a load history are what each of them would be alone, at less cost.
#include "small_problem.h"

#include "unilateral/case/load_steps.h"
#include "unilateral/case/problem_of_case.h"
#include "unilateral/case/solve_history.h"
#include "unilateral/solve.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

using namespace unilateral;

namespace
{
  template <int dim>
  RunResult alone(const Case &request, const std::size_t k, Vector &u)
  {
    Diagnostics   diagnostics;
    Progress      silent;
    Solution<dim> solution = solve<dim>(problem_of(case_of_step(request, k)), diagnostics, silent);
    u = solution.displacement;
    return solution.result;
  }

  /// Every step against a solve of its own; returns on how many levels each was solved.
  template <int dim>
  std::vector<std::size_t> compare_with_single_solves(const std::string &text)
  {
    const Case               request = case_of(text);
    Progress                 silent;
    LoadStepping<dim>        stepping(silent);
    std::vector<std::size_t> n_levels;
    solve_history<dim>(request, stepping,
                       [&](const SolvedStep<dim> &step, const auto &)
                       {
                         const RunResult &result = step.solution.result;
                         Vector           expected;
                         const RunResult  single = alone<dim>(request, step.k, expected);
                         EXPECT_TRUE(result.converged) << result.reason;
                         n_levels.push_back(result.levels.size());
                         Vector difference(step.solution.displacement);
                         EXPECT_EQ(difference.size(), expected.size());
                         difference -= expected;
                         EXPECT_LT(difference.linfty_norm(), 1e-5 * std::max(expected.linfty_norm(), 1e-10)) << "step " << step.k + 1;
                         EXPECT_NEAR(result.energy, single.energy, 1e-5 * std::abs(single.energy) + 1e-14);
                         for (std::size_t c = 0; c < result.constraints.size(); ++c)
                           EXPECT_NEAR(result.constraints[c].total_contact_force, single.constraints[c].total_contact_force,
                                       1e-5 * std::abs(single.constraints[c].total_contact_force) + 1e-10);
                       });
    EXPECT_EQ(n_levels.size(), request.steps.size());
    return n_levels;
  }

  using Levels = std::vector<std::size_t>;
  const std::string fixed_epsilon = "[method]\nepsilon = 1e-8\ntolerance = 1e-10\n";
} // namespace

TEST(LoadStepping, loads_bounds_and_prescribed_values_change_on_one_mesh)
{
  EXPECT_EQ((compare_with_single_solves<2>("parameters = { f = 1, g = 0 }\n[steps]\nf = [1, 3, 2]\ng = [0, 0.01, 0.005]\n"
                                           "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 4\nrefine = 2\n[model]\nkind = \"membrane\"\n"
                                           "load = \"f*(1 + x)\"\n[boundary]\nall = \"g*y\"\n[constraint]\nupper = \"0.03 + g\"\n" +
                                           fixed_epsilon)),
            (Levels{3, 1, 1}));
}

TEST(LoadStepping, a_body_is_pressed_and_let_go)
{
  EXPECT_EQ((compare_with_single_solves<2>("parameters = { d = 0 }\n[steps]\nd = [0.01, 0.03, 0.02]\n"
                                           "[mesh]\nbox = [[-1, 0], [1, 1]]\ncells = [8, 4]\nrefine = 1\n[model]\nkind = \"elasticity\"\n"
                                           "young = 1\npoisson = 0.3\n[boundary]\ntop = [0, \"-d\"]\n"
                                           "[constraint]\non = \"bottom\"\ngap = \"x^2/4\"\n" +
                                           fixed_epsilon)),
            (Levels{2, 1, 1}));
}

TEST(LoadStepping, a_load_may_vanish_and_come_back)
{
  for (const std::string element : {"Q1", "P2"})
    for (const std::string bound : {"-0.01", "-0.001 - x"})
      compare_with_single_solves<2>("[parameters]\nd = 0\n[mesh]\nbox = [[0, 0], [2, 1]]\ncells = [8, 4]\nrefine = 1\n"
                                    "[model]\nkind = \"membrane\"\nelement = \"" +
                                    element + "\"\nload = \"-d\"\n[boundary]\nall = 0\n[constraint]\nlower = \"" + bound + "\"\n" +
                                    fixed_epsilon + "[[step]]\nd = 2\n[[step]]\nd = 0\n[[step]]\nd = 1e-9\n[[step]]\nd = 1\n");
}

TEST(LoadStepping, only_contact_holds_the_body)
{
  compare_with_single_solves<2>("parameters = { f = 1 }\n[steps]\nf = [1, 2, 0.5]\n"
                                "[mesh]\nbox = [[-1, 0], [1, 1]]\ncells = [8, 4]\nrefine = 1\n[model]\nkind = \"elasticity\"\n"
                                "young = 100\npoisson = 0.3\n[boundary]\nleft = \"free\"\ntop = { traction = [0, \"-f\"] }\n"
                                "[constraint]\non = \"bottom\"\ngap = 0\n" +
                                fixed_epsilon);
}

TEST(LoadStepping, multigrid_serves_on)
{
  const std::string text = "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 4\nrefine = 3\n[model]\nkind = \"membrane\"\nload = \"f\"\n"
                           "stiffness = \"k\"\n[boundary]\nall = \"g\"\n[constraint]\nupper = 0.03\n[method]\nepsilon = 1e-8\ntolerance = "
                           "1e-10\nsolver = \"multigrid\"\n";
  EXPECT_EQ((compare_with_single_solves<2>("parameters = { f = 1, k = 1, g = 0 }\n[steps]\nf = [1, 3, 2]\ng = [0, 0.01, -0.01]\n" + text)),
            (Levels{4, 1, 1}));
  // Another matrix takes other levels.
  EXPECT_EQ((compare_with_single_solves<2>("parameters = { f = 1, k = 1, g = 0 }\n[steps]\nk = [1, 1, 2]\nf = [1, 2, 2]\n" + text)),
            (Levels{4, 1, 4}));
}

TEST(LoadStepping, matrices_and_conditions_may_change_where_they_are_assembled)
{
  EXPECT_EQ((compare_with_single_solves<2>("parameters = { k = 1 }\n[[step]]\nk = 1\n[[step]]\nk = 3\n[[step]]\n"
                                           "set = { \"boundary.left\" = { flux = 0.1 } }\n[[step]]\nset = { \"constraint.upper\" = 0.01 }\n"
                                           "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 4\nrefine = 1\n[model]\nkind = \"membrane\"\n"
                                           "stiffness = \"k\"\nload = 2\n[boundary]\nleft = 0\nright = 0\n[constraint]\nupper = 0.03\n" +
                                           fixed_epsilon)),
            (Levels{2, 1, 1, 1}));
}

TEST(LoadStepping, the_step_before_is_a_field_for_every_element)
{
  // u_1 = L, u_k = L + u_{k-1}: exact for whatever the element can represent.
  for (const std::string element : {"Q1", "Q2", "Q3"})
  {
    const Case      request = case_of("[parameters]\nold = { previous = \"u\" }\n[steps]\ncount = 3\n[mesh]\nball = { center = [0, 0], "
                                           "radius = 1 }\nrefine = 2\n[model]\nkind = \"membrane\"\nelement = \"" +
                                      element + "\"\nstiffness = 1e-12\nreaction = 1\nload = \"old + x + 2*y\"\n[constraint]\nupper = 100\n");
    Progress        silent;
    LoadStepping<2> stepping(silent);
    solve_history<2>(request, stepping, {});
    const auto &solution = stepping.solution();
    for (const auto &node : solution.problem->space.nodal_values())
      EXPECT_NEAR(solution.displacement(node.dof), 3 * (node.x[0] + 2 * node.x[1]), 1e-6) << element;
  }
}

TEST(LoadStepping, adaptive_refinement_goes_on)
{
  const Case request =
    case_of("parameters = { f = 1 }\n[steps]\nf = [1, 4]\n[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 4\nadapt = { tolerance "
            "= 0.1 }\n[model]\nkind = \"membrane\"\nload = \"f\"\n[boundary]\nall = 0\n[constraint]\nupper = 0.02\n");
  Progress        silent;
  LoadStepping<2> stepping(silent);
  std::size_t     n_before = 0;
  solve_history<2>(request, stepping,
                   [&](const SolvedStep<2> &step, const auto &)
                   {
                     EXPECT_TRUE(step.solution.result.estimate->tolerance_met);
                     EXPECT_GE(step.solution.result.n_dofs, n_before);
                     n_before = step.solution.result.n_dofs;
                   });
}

TEST(LoadStepping, fine_cells_stay_where_contact_is)
{
  // A bump moves from one side to the other: with the cells of all steps the last mesh would be seven times as large as the first one.
  const Case      request = case_of("parameters = { c = 0 }\n[steps]\nc = \"-1:1:9\"\n[mesh]\nbox = [[-2, -1], [2, 1]]\ncells = [8, 4]\n"
                                         "adapt = { tolerance = 0.02 }\n[model]\nkind = \"membrane\"\nelement = \"Q2\"\n[boundary]\nall = 0\n"
                                         "[constraint]\nlower = \"0.3 - 4*((x-c)^2 + y^2)\"\n");
  Progress        silent;
  LoadStepping<2> stepping(silent);
  std::size_t     n_first = 0;
  const auto      steps = solve_history<2>(request, stepping,
                                      [&](const SolvedStep<2> &step, const auto &)
                                      {
                                        const auto &result = step.solution.result;
                                        EXPECT_TRUE(result.estimate->tolerance_met);
                                        if (n_first == 0)
                                          n_first = result.n_dofs;
                                        EXPECT_LT(result.n_dofs, 3 * n_first);
                                      });
  ASSERT_EQ(steps.size(), 9u);
  const auto force = [&](const unsigned step) -> double { return steps[step]["constraint"][0]["total_contact_force"]; };
  EXPECT_NEAR(force(8), force(0), 1e-3 * force(0)); // the same problem, reflected
}

TEST(LoadStepping, a_step_that_does_not_converge_is_the_last)
{
  Progress        silent;
  LoadStepping<2> stepping(silent);
  const auto      steps = solve_history<2>(
    case_of("[[step]]\n[[step]]\nset = { \"method.max_iterations\" = 1, \"constraint.upper\" = 0.001, \"model.load\" = 50 }\n[[step]]\n"
                      "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 16\n[model]\nkind = \"membrane\"\nload = 1\n[boundary]\nall = 0\n[constraint]\nupper "
                      "= 0.05\n"),
    stepping, {});
  EXPECT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[0]["status"], "converged");
  EXPECT_EQ(steps[1]["status"], "not_converged");
}
