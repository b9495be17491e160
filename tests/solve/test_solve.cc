// The main path from a case to its result, in corners that examples do not reach.
#include "small_problem.h"

#include "unilateral/case/problem_of_case.h"
#include "unilateral/solve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace unilateral;

namespace
{
  const std::string square = "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 4\nrefine = 1\n[model]\nkind = \"membrane\"\nload = 1\n";

  RunResult solve_text(const std::string &text)
  {
    Diagnostics diagnostics;
    Progress    silent;
    return solve<2>(problem_of(case_of(text)), diagnostics, silent).result;
  }
} // namespace

TEST(Solve, without_a_constraint_it_is_the_linear_problem)
{
  const RunResult result = solve_text(square + "[boundary]\nall = 0\n");
  EXPECT_TRUE(result.converged) << result.reason;
  EXPECT_TRUE(result.constraints.empty());
  // The torsion constant of a square: integral of u = 0.0351443 = -2 J.
  EXPECT_NEAR(-2 * result.energy, 0.0351443, 0.0015);
}

TEST(Solve, a_form_that_is_not_coercive_does_not_count_as_solved)
{
  const RunResult reaction = solve_text(square + "reaction = \"-60\"\n[boundary]\nall = 0\n[constraint]\nupper = 0.1\n");
  EXPECT_FALSE(reaction.converged);
  for (const char *const stiffness : {"x - 0.5", "if(x > 0.5, 1, 0)"})
    EXPECT_THROW(solve_text(square + "stiffness = \"" + stiffness + "\"\n[boundary]\nall = 0\n[constraint]\nupper = 0.1\n"), InputError);
}

TEST(Solve, iterations_end_where_the_first_step_has_nothing_to_do)
{
  // No load: at u = 0 without contact the residual is zero, and the tolerance of the steps after it must not be.
  Diagnostics     diagnostics;
  Progress        silent;
  const RunResult result =
    solve<3>(problem_of(case_of("mesh.box = [[0, 0, 0], [1, 1, 1]]\nmesh.cells = 3\nmodel.kind = \"elasticity\"\nmodel.element = \"P2\"\n"
                                "model.young = 1000\nmodel.poisson = 0.3\nboundary.front = \"clamped\"\nconstraint.on = \"back\"\n"
                                "constraint.gap = \"2*((x - 0.4)^2 + (y - 0.45)^2) - 0.02\"\nmethod.solver = \"amg\"\n")),
             diagnostics, silent)
      .result;
  EXPECT_TRUE(result.converged) << result.reason;
  EXPECT_GT(result.constraints[0].total_contact_force, 0);
  EXPECT_LT(result.levels.back().linear_iterations, 100u);
}

TEST(Solve, bodies_that_iterations_solve_are_in_balance)
{
  // Nearly incompressible cells at an axis, where the energy norm of the residual says little of the forces.
  const RunResult result =
    solve_text("mesh.box = [[0, 0], [1, 1]]\nmesh.cells = 8\nmesh.refine = 4\nmodel.kind = \"elasticity\"\nmodel.young = 100\n"
               "model.poisson = 0.48\nmodel.assumption = \"axisymmetric\"\nboundary.top = { y = -0.02 }\nconstraint.on = \"bottom\"\n"
               "constraint.gap = \"0.03*x^2\"\nmethod.solver = \"amg\"\n");
  EXPECT_TRUE(result.converged) << result.reason;
  EXPECT_LT(result.balance->residual, 1e-6);
}

TEST(Solve, layers_of_a_strong_reaction_are_in_the_estimate)
{
  // u = exp(-x (c/k)^1/2), which ends within the first cell; a velocity, next to none, leaves the estimate without a bound.
  for (const std::string element : {"Q1", "Q2", "P1", "P2"})
  {
    const RunResult result =
      solve_text("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 8\n[model]\nkind = \"membrane\"\nelement = \"" + element +
                 "\"\nstiffness = 0.001\nreaction = 50\nvelocity = [1e-9, 0]\n[boundary]\nleft = 1\nright = 0\n[constraint]\n"
                 "lower = -1\n[exact]\nu = \"exp(-x*sqrt(50/0.001))\"\n");
    EXPECT_FALSE(result.estimate->guaranteed) << element;
    EXPECT_GT(result.estimate->total, 0.5 * *result.errors->energy) << element;
    EXPECT_LT(result.estimate->total, 2 * *result.errors->energy) << element;
  }
}

TEST(Solve, a_flux_that_is_zero_but_for_rounding_ends)
{
  // Cutting a face where values differ by more than a part of the largest would never end here.
  const RunResult result = solve_text("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 4\n[model]\nkind = \"membrane\"\nload = -1\n[boundary]\n"
                                      "left = 0\nright = { flux = \"sin(7*y)^2 + cos(7*y)^2 - 1\" }\n[constraint]\nlower = -1\n");
  EXPECT_TRUE(result.converged) << result.reason;
}

TEST(Solve, without_rest_the_rule_is_named_that_may_be_why)
{
  const auto reason = [](const std::string &rule)
  {
    const RunResult result =
      solve_text("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 8\n[model]\nkind = \"membrane\"\nelement = \"Q1\"\nload = 1\n"
                 "[boundary]\nall = 0\n[constraint]\nupper = 0.02\nquadrature = \"" +
                 rule + "\"\n[method]\nmax_iterations = 1\n");
    EXPECT_FALSE(result.converged) << rule;
    return result.reason;
  };
  EXPECT_NE(reason("gauss(2)").find("the rule gauss(2) has 256 points on the domain, and Q1 has 49 unknowns there"), std::string::npos)
    << reason("gauss(2)");
  EXPECT_NE(reason("gauss(2)").find("study quadrature"), std::string::npos);
  EXPECT_NE(reason("midpoint").find("infsup"), std::string::npos) << reason("midpoint");
  EXPECT_EQ(reason("nodal").find("infsup"), std::string::npos) << reason("nodal");
}

TEST(Solve, a_probe_outside_the_mesh_is_an_error_before_anything_is_solved)
{
  Diagnostics diagnostics;
  Progress    silent;
  const Case  request = case_of(square + "[boundary]\nall = 0\n[output]\nprobes = [[2, 0.5]]\n");
  EXPECT_THROW(Problem<2>(problem_of(request), diagnostics), InputError);
}

TEST(Solve, held_by_contact_alone)
{
  const RunResult result = solve_text(square + "[constraint]\nupper = \"1 + x\"\n");
  EXPECT_TRUE(result.converged) << result.reason;
  EXPECT_NEAR(result.constraints[0].total_contact_force, 1, 1e-6); // the whole load
}

TEST(Solve, a_load_that_nothing_holds_is_an_error)
{
  EXPECT_THROW(solve_text(square + "[constraint]\nlower = 0\n"), InputError);
}

TEST(Solve, automatic_epsilon_does_not_know_units)
{
  const auto digits = [](const double metre, const double pascal)
  {
    const RunResult result =
      solve_text(fmt::format("[mesh]\nbox = [[0, 0], [{0}, {0}]]\ncells = 4\nrefine = 2\n[model]\nkind = \"membrane\"\nstiffness = {1}\n"
                             "load = {2}\n[boundary]\nall = 0\n[constraint]\nupper = {3}\n",
                             metre, pascal, 10 * pascal / metre, 0.05 * metre));
    // Lengths, and pressures times areas, of the problem in metres and pascals.
    return std::vector<double>{result.max / metre, result.constraints[0].total_contact_force / (pascal * metre),
                               result.certificate->penalty_error_bound / (metre * std::sqrt(pascal)),
                               result.discretisation_indicator / (metre * std::sqrt(pascal))};
  };
  const auto in_metres = digits(1, 1), in_millimetres = digits(1e3, 1e-6);
  for (std::size_t i = 0; i < in_metres.size(); ++i)
    EXPECT_NEAR(in_millimetres[i], in_metres[i], 1e-7 * in_metres[i]);
}

TEST(Solve, the_certificate_is_measured_against_the_tolerance_that_is_asked)
{
  const std::string text = square + "[boundary]\nall = 0\n[constraint]\nupper = 0.03\n[method]\n";
  EXPECT_FALSE(solve_text(text + "epsilon = 1\npenalty_tolerance = 1e-6\n").certificate_holds);
  EXPECT_TRUE(solve_text(text + "penalty_tolerance = 1e-6\n").certificate_holds);
}

TEST(Solve, what_moves_as_a_whole_has_no_relative_error)
{
  const std::string body =
    "[mesh]\nbox = [[0, 0], [2, 1]]\ncells = [4, 2]\nrefine = 2\n[model]\nkind = \"elasticity\"\nyoung = 100\npoisson = 0.3\n"
    "[constraint]\non = \"bottom\"\ngap = { plane = { point = [0, -1], normal = [0, 1] } }\n";
  for (const std::string &text : {square + "[boundary]\nall = 0\n", square + "[boundary]\nall = 0.1\n", body + "[boundary]\ntop = [0, 0]\n",
                                  body + "[boundary]\ntop = [0, 0.1]\n", body + "[boundary]\ntop = [0, 0.1]\n[method]\nsolver = \"amg\"\n",
                                  body + "[boundary]\ntop = [\"0.1*(1 - y)\", \"0.1*x\"]\n",
                                  body + "[boundary]\nleft = \"symmetry\"\ntop = { spring = 10, y = 0.1 }\n"})
  {
    std::string without_load = text;
    if (const auto load = without_load.find("load = 1\n"); load != std::string::npos)
      without_load.erase(load, 9);
    for (const char *const adapt : {"", "adapt = { tolerance = 0.01, max_unknowns = 5000 }\n"})
    {
      std::string     refined = without_load;
      const RunResult result = solve_text(refined.insert(refined.find("[model]"), adapt));
      EXPECT_TRUE(result.converged) << refined << result.reason;
      EXPECT_TRUE(result.nothing_deforms()) << refined << result.energy_norm << " " << result.estimate->total;
      EXPECT_EQ(result.reference_norm(), 0) << refined;
      EXPECT_TRUE(result.estimate->guaranteed) << refined << result.estimate->reason;
      EXPECT_TRUE(result.estimate->tolerance_met) << refined;
      EXPECT_LT(result.estimate->cycles.size(), 2u) << refined;
      EXPECT_LE(result.estimate->penalty + result.estimate->algebraic, (1 + 1e-12) * result.estimate->total) << refined;
    }
  }
}

TEST(Solve, what_a_mesh_is_too_coarse_to_show_deforms_nevertheless)
{
  const std::string text =
    "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 2\n[model]\nkind = \"membrane\"\nload = \"sin(2*pi*x)*sin(2*pi*y)\"\n[boundary]\nall = 0\n";
  const RunResult coarse = solve_text(text);
  EXPECT_LT(coarse.energy_norm, 1e-12);
  EXPECT_FALSE(coarse.nothing_deforms());
  EXPECT_GT(coarse.estimate->total, 0.01);
  std::string     refined = text;
  const RunResult fine = solve_text(refined.insert(refined.find("[model]"), "adapt = { tolerance = 0.2 }\n"));
  EXPECT_TRUE(fine.estimate->tolerance_met);
  EXPECT_GT(fine.estimate->cycles.size(), 1u);
  EXPECT_NEAR(-2 * fine.energy, 1 / (32 * std::numbers::pi * std::numbers::pi),
              0.05 / (32 * std::numbers::pi * std::numbers::pi)); // a(u, u) of u = f / (8 pi^2)
}
