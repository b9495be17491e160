// Factors of a matrix that several processes have in parts, where contact is on the boundary: mpirun starts this test on two of them.
#include "small_problem.h"

#include "unilateral/case/problem_of_case.h"
#include "unilateral/level_solve.h"

#include <gtest/gtest.h>

#include <string>

using namespace unilateral;

namespace
{
  struct Numbers
  {
    double energy = 0, force = 0, pressure_square = 0;
    bool   shared = false, converged = false;
  };

  template <int dim>
  Numbers numbers_of(const std::string &text, const Processes &processes)
  {
    Diagnostics   diagnostics;
    Progress      progress;
    Stopwatch     watch;
    StartingGuess nothing;
    Solution<dim> solution;
    auto         &u = solution.displacement, &lambda = solution.contact_pressure;
    const Case    request = case_of(text);
    solution.problem = std::make_unique<Problem<dim>>(problem_of(request), diagnostics);
    auto               &problem = *solution.problem;
    Discretisation<dim> discretisation(problem, {.cells_to_share = 20, .factorised_by_one_2d = 0, .factorised_by_one_3d = 0});
    PenaltyParameter    penalty(problem.statement.method, problem.statement.constrains_boundary());
    discretisation.share_coarse_mesh(problem, processes, progress);
    solution.constraint_set = problem.make_constraint_set();
    auto discrete = discretisation.on_level(problem, solution.constraint_set);
    penalty.start_level(*discrete);
    start_from(nothing, *discrete, problem, solution.constraint_set, u, lambda);
    const auto outcome = solve_on_level(solution, discrete, discretisation, penalty, nothing, {.finest = false}, watch, progress);
    Vector     Au;
    discrete->initialize_dof_vector(Au);
    discrete->apply_stiffness(Au, u);
    const Vector &w = discrete->weights();
    return {.energy = discrete->dot(Au, u) / 2,
            .force = discrete->sum_over_points([&](const std::size_t i) { return w(i) * lambda(i); }),
            .pressure_square = discrete->sum_over_points([&](const std::size_t i) { return w(i) * lambda(i) * lambda(i); }),
            .shared = bool(problem.space.subdomain),
            .converged = outcome.converged && discrete->linear_solver_name() == "direct"};
  }

  template <int dim>
  void expect_numbers_of_one(const std::string &text)
  {
    SCOPED_TRACE(text);
    ASSERT_EQ(Processes::all().size(), 2u);
    const Numbers one = numbers_of<dim>(text, {}), two = numbers_of<dim>(text, Processes::all());
    EXPECT_FALSE(one.shared);
    EXPECT_TRUE(two.shared);
    EXPECT_TRUE(one.converged && two.converged);
    EXPECT_GT(one.force, 0);
    EXPECT_NEAR(two.energy, one.energy, 1e-9 * one.energy);
    EXPECT_NEAR(two.force, one.force, 1e-9 * one.force);
    EXPECT_NEAR(two.pressure_square, one.pressure_square, 1e-8 * one.pressure_square);
  }

  const std::string direct = "[method]\nsolver = \"direct\"\n";
} // namespace

TEST(SharedFactors, HeldBodyOnAParaboloid)
{
  expect_numbers_of_one<3>("[mesh]\nbox = [[-1, -1, 0], [1, 1, 1]]\ncells = [6, 6, 3]\n[model]\nkind = \"elasticity\"\nelement = \"Q2\"\n"
                           "young = 100\npoisson = 0.3\n[boundary]\n\"z+\" = [0, 0, -0.1]\n[constraint]\non = \"z-\"\n"
                           "gap = \"0.1*(x^2 + 2*y^2)\"\n" +
                           direct);
}

TEST(SharedFactors, TetrahedraThatOnlyContactHolds)
{
  expect_numbers_of_one<3>(
    "[mesh]\nbox = [[-1, -1, 0], [1, 1, 1]]\ncells = [6, 6, 3]\n[model]\nkind = \"elasticity\"\nelement = \"P2\"\n"
    "young = 100\npoisson = 0.3\n[boundary]\n\"z+\" = { traction = [0, 0, \"-1 - 0.3*x\"] }\n[constraint]\non = \"z-\"\n"
    "gap = \"0.01*(x^2 + 2*y^2)\"\n" +
    direct);
}

TEST(SharedFactors, BodyInThePlaneThatOnlyContactHolds)
{
  expect_numbers_of_one<2>("[mesh]\nbox = [[-2, 0], [2, 1]]\ncells = [24, 6]\n[model]\nkind = \"elasticity\"\nelement = \"Q2\"\n"
                           "young = 100\npoisson = 0.3\n[boundary]\ntop.pressure = \"1 + 0.2*x\"\n[constraint]\non = \"bottom\"\n"
                           "gap = \"0.001*x^2\"\n" +
                           direct);
}

TEST(SharedFactors, MembraneOverASupportAtItsEdge)
{
  expect_numbers_of_one<2>("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 16\n[model]\nkind = \"membrane\"\nelement = \"Q2\"\nload = -1\n"
                           "[boundary]\ntop = 0\n[constraint]\non = \"bottom\"\nlower = \"-0.2 - 0.1*x\"\n" +
                           direct);
}
