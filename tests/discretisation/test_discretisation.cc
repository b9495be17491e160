// Which solver a run takes: by the unknowns of the finest level, and when an iterative one fails.
#include "small_problem.h"

#include "unilateral/case/problem_of_case.h"
#include "unilateral/discretisation/solver_choice.h"

#include <gtest/gtest.h>

using namespace unilateral;

namespace
{
  std::string membrane(const std::string &mesh, const std::string &element, const std::string &rest = "")
  {
    return "[mesh]\n" + mesh + "\n[model]\nkind = \"membrane\"\nelement = \"" + element + "\"\nload = -1\n[boundary]\nall = 0\n" +
           "[constraint]\nlower = -0.01\n" + rest;
  }

  /// As many unknowns on the finest level as may be factorised, and one too many.
  template <int dim>
  void expect_exact_count(const std::string &text)
  {
    SCOPED_TRACE(text);
    Diagnostics  diagnostics;
    const Case   request = case_of(text);
    Problem<dim> finest(problem_of(request), diagnostics);
    for (unsigned level = 0; level < request.mesh.n_refinements(); ++level)
    {
      std::vector<Vector> nothing;
      finest.refine(nothing);
    }
    const std::size_t  n = finest.space.dof_handler.n_dofs();
    const Problem<dim> coarse(problem_of(request), diagnostics);
    const auto         reason = [&](const std::size_t limit)
    { return Discretisation<dim>(coarse, {.direct_limit_2d = limit, .direct_limit_3d = limit}).reason(); };
    EXPECT_EQ(reason(n).find("a direct solver"), 0u) << reason(n);
    EXPECT_NE(reason(n - 1).find("multigrid"), std::string::npos) << reason(n - 1);
  }

  struct TwoLevels
  {
    explicit TwoLevels(const std::string &solver)
      : problem(
          problem_of(case_of(membrane("box = [[0, 0], [1, 1]]\ncells = 4\nrefine = 1", "Q1", "[method]\nsolver = \"" + solver + "\"\n"))),
          diagnostics),
        discretisation(problem, {.direct_limit_2d = 50, .affordable_2d = 81})
    {
    }

    std::unique_ptr<DiscreteProblem> on_level() { return discretisation.on_level(problem, problem.make_constraint_set()); }

    MultiplierResult failure() const
    {
      MultiplierResult outcome;
      outcome.reason = "no rest";
      return outcome;
    }

    Diagnostics       diagnostics;
    Progress          progress;
    Problem<2>        problem;
    Discretisation<2> discretisation;
  };
} // namespace

TEST(Discretisation, counts_the_unknowns_of_the_finest_level)
{
  const std::string square = "box = [[0, 0], [2, 1]]\ncells = [3, 2]\nrefine = 2",
                    cube = "box = [[0, 0, 0], [1, 1, 1]]\ncells = 2\nrefine = 2";
  for (const std::string element : {"Q1", "Q2", "Q3", "P1", "P2", "P3"})
    expect_exact_count<2>(membrane(square, element));
  for (const std::string element : {"Q1", "Q2", "Q3", "P1", "P2"})
    expect_exact_count<3>(membrane(cube, element));
  expect_exact_count<2>(membrane("ball = { center = [0, 0], radius = 1 }\nrefine = 2", "Q2"));
  expect_exact_count<3>("[mesh]\n" + cube + "\n[model]\nkind = \"elasticity\"\nyoung = 1\npoisson = 0.3\n[boundary]\ntop = [0, 0, 0]\n" +
                        "[constraint]\non = \"bottom\"\ngap = 1\n");
}

TEST(Discretisation, a_direct_solver_takes_over_where_another_fails)
{
  TwoLevels levels("auto");
  auto      discrete = levels.on_level();
  EXPECT_EQ(discrete->linear_solver_name(), "multigrid");
  MultiplierResult converged;
  converged.converged = true;
  EXPECT_FALSE(levels.discretisation.fall_back(levels.problem, *discrete, converged, levels.progress));
  ASSERT_TRUE(levels.discretisation.fall_back(levels.problem, *discrete, levels.failure(), levels.progress));
  EXPECT_NE(levels.discretisation.reason().find("no rest; from there on a direct solver"), std::string::npos);
  for (unsigned level = 0; level < 2; ++level)
  {
    discrete = levels.on_level();
    EXPECT_EQ(discrete->linear_solver_name(), "direct");
    EXPECT_FALSE(levels.discretisation.fall_back(levels.problem, *discrete, levels.failure(), levels.progress));
    std::vector<Vector> nothing;
    levels.problem.refine(nothing);
  }
}

TEST(Discretisation, no_other_solver_takes_over_where_it_cannot)
{
  for (const std::string solver : {"multigrid", "amg"}) // as asked
  {
    TwoLevels  levels(solver);
    const auto discrete = levels.on_level();
    EXPECT_FALSE(levels.discretisation.fall_back(levels.problem, *discrete, levels.failure(), levels.progress));
  }
  TwoLevels         levels("auto");
  Discretisation<2> expensive(levels.problem, {.direct_limit_2d = 50, .affordable_2d = 80}); // 81 on the finest level
  const auto        discrete = expensive.on_level(levels.problem, levels.problem.make_constraint_set());
  EXPECT_FALSE(expensive.fall_back(levels.problem, *discrete, levels.failure(), levels.progress));
  MultiplierResult not_finite = levels.failure();
  not_finite.equilibrium = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(levels.discretisation.fall_back(levels.problem, *discrete, not_finite, levels.progress));
}

TEST(Discretisation, counts_about_the_unknowns_that_local_refinements_make)
{
  const std::pair<std::string, double> elements[] = {{"Q1", 0.1}, {"P1", 0.2}}; // neighbours of triangles are cut as well
  for (const auto &[element, tolerance] : elements)
  {
    const Case          request = case_of(membrane("box = [[0, 0], [1, 1]]\ncells = 8\nrefine = 1\nlocal = [{ where = \"x < 0.5\" }, "
                                                            "{ where = \"hypot(x, y) < 0.4\", times = 3 }]",
                                                   element));
    Diagnostics         diagnostics;
    Problem<2>          problem(problem_of(request), diagnostics);
    const double        expected = problem.growth_in_places() * problem.space.mesh.triangulation->n_active_cells() * 4;
    std::vector<Vector> nothing;
    for (unsigned level = 0; level < request.mesh.n_refinements(); ++level)
      problem.refine(nothing);
    EXPECT_NEAR(problem.space.mesh.triangulation->n_active_cells() / expected, 1, tolerance) << element;
    EXPECT_EQ(problem.growth_in_places(), 1);
  }
}
