// The guess of elements of degree 1 for those of a higher degree.
#include "small_problem.h"

#include "unilateral/solve.h"
#include "unilateral/start_by_degree_1.h"

#include <gtest/gtest.h>

using namespace unilateral;

namespace
{
  std::string block(const std::string &element, const std::string &solver)
  {
    return "mesh.box = [[0, 0], [2, 1]]\nmesh.cells = [16, 8]\n[model]\nkind = \"elasticity\"\nelement = \"" + element +
           "\"\nyoung = \"if(x < 1, 1, 2)\"\npoisson = 0.3\n[boundary]\ntop = [0, \"-0.02*(1 + 0.3*x)\"]\n[constraint]\non = \"bottom\"\n"
           "gap = \"0.05*(x - 0.7)^2\"\n[output]\nprobes = [[0.5, 0.5]]\n[method]\nsolver = \"" +
           solver + "\"\n";
  }

  StartingGuess guess_of(const std::string &text, Problem<2> *&kept)
  {
    static std::unique_ptr<Problem<2>> problem;
    Diagnostics                        diagnostics;
    Progress                           silent;
    problem = std::make_unique<Problem<2>>(problem_of(case_of(text)), diagnostics);
    kept = problem.get();
    return start_by_degree_1(*problem, silent);
  }
} // namespace

TEST(StartByDegree1, is_close_to_the_solution)
{
  for (const std::string element : {"P2", "Q2", "P3"})
  {
    SCOPED_TRACE(element);
    Problem<2>  *problem = nullptr;
    const auto   guess = guess_of(block(element, "amg"), problem);
    Diagnostics  diagnostics;
    Progress     silent;
    const auto   solution = solve<2>(problem->statement, diagnostics, silent);
    const double size = solution.displacement.linfty_norm();
    ASSERT_EQ(guess.functions.size(), 2u);
    ASSERT_EQ(guess.functions[0].size(), solution.displacement.size());
    Vector difference(guess.functions[0]);
    difference -= solution.displacement;
    EXPECT_LT(difference.linfty_norm(), 0.1 * size);
    EXPECT_GT(guess.functions[1].linfty_norm(), 0);
    // Fewer Newton steps than from nothing: the first ones find the contact set.
    EXPECT_LT(solution.result.levels.back().newton_iterations, 14u);
  }
}

TEST(StartByDegree1, is_none_where_it_would_say_little)
{
  Problem<2> *problem = nullptr;
  EXPECT_TRUE(guess_of(block("Q1", "amg"), problem).functions.empty());
  const std::string rubber = "poisson = 0.499";
  std::string       text = block("Q2", "amg");
  EXPECT_TRUE(guess_of(text.replace(text.find("poisson = 0.3"), 13, rubber), problem).functions.empty());
}

TEST(StartByDegree1, interpolates_what_both_elements_hold_exactly)
{
  // A patch test: the displacement is linear, and contact has a constant pressure.
  const std::string text = "mesh.box = [[0, 0], [1, 1]]\nmesh.cells = 6\n[model]\nkind = \"elasticity\"\nelement = \"P2\"\nyoung = 1\n"
                           "poisson = 0\n[boundary]\ntop = [0, -0.1]\nleft = { x = 0 }\n[constraint]\non = \"bottom\"\ngap = 0\n"
                           "[method]\nsolver = \"amg\"\nepsilon = 1e-9\ntolerance = 1e-10\n";
  Problem<2>       *problem = nullptr;
  const auto        guess = guess_of(text, problem);
  ASSERT_EQ(guess.functions.size(), 2u);
  for (const auto &node : problem->space.nodal_values())
    EXPECT_NEAR(guess.functions[0](node.dof), node.component == 1 ? -0.1 * node.x[1] : 0., 1e-4);
}
