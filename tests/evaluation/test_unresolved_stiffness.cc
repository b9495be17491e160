// What two rules see of a coefficient that varies within a cell.
#include "small_problem.h"

#include "unilateral/evaluation/unresolved_stiffness.h"
#include "unilateral/solve.h"

#include <fmt/format.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace unilateral;

namespace
{
  using Values = std::vector<double>;

  struct Solved
  {
    double                  total, true_error;
    bool                    guaranteed;
    std::string             reason;
    std::vector<Diagnostic> messages;
  };

  /// -(k u')' = -1 on (0, 1), u = 0 at both ends, k = @p left to the left of @p jump and 1 beyond; P1 or P2 on @p n cells. With the flux
  /// k u' = x + C the error in the energy norm is known.
  Solved solve_with_jump(const double left, const double jump, const unsigned n, const unsigned degree = 1)
  {
    const auto k = [&](const double x) { return x < jump ? left : 1.; };
    const auto integral = [&](const auto &f, const double a, const double b)
    {
      const auto simpson = [&](const double from, const double to)
      {
        const double middle = (from + to) / 2, tiny = 1e-12; // values beside the jump
        return (to - from) / 6 * (f(from + tiny) + 4 * f(middle) + f(to - tiny));
      };
      return jump > a && jump < b ? simpson(a, jump) + simpson(jump, b) : simpson(a, b);
    };
    const double C = -integral([&](const double x) { return x / k(x); }, 0, 1) / integral([&](const double x) { return 1 / k(x); }, 0, 1);
    Diagnostics  diagnostics;
    Progress     silent;
    const auto   request =
      case_of("mesh.box = [[0], [1]]\nmesh.cells = " + std::to_string(n) +
              "\nmodel.kind = \"membrane\"\nmodel.load = -1\nmodel.stiffness = \"if(x < " + std::to_string(jump) + ", " +
              fmt::format("{}", left) + ", 1)\"\nmodel.element = \"P" + std::to_string(degree) + "\"\nboundary.all = 0\n");
    const auto solution = solve<1>(problem_of(request), diagnostics, silent);
    double     square = 0;
    for (const auto &cell : solution.problem->space.dof_handler.active_cell_iterators())
    {
      const double a = cell->vertex(0)[0], b = cell->vertex(1)[0];
      const double u_a = solution.displacement(cell->vertex_dof_index(0, 0)), u_b = solution.displacement(cell->vertex_dof_index(1, 0)),
                   slope = (u_b - u_a) / (b - a),
                   bend = degree == 1 ? 0 : 4 / (b - a) * (u_a - 2 * solution.displacement(cell->dof_index(0)) + u_b);
      square +=
        integral([&](const double x) { return std::pow((x + C) / k(x) - slope - bend * ((x - a) / (b - a) - 0.5), 2) * k(x); }, a, b);
    }
    return {solution.result.estimate->total, std::sqrt(square), solution.result.estimate->guaranteed, solution.result.estimate->reason,
            diagnostics.all()};
  }
} // namespace

TEST(UnresolvedStiffness, RulesThatAgreeMissNothing)
{
  const Values weights(3, 1. / 3), fine_weights(6, 1. / 6);
  EXPECT_NEAR(unseen_share({1, 2, 3}, weights, {1, 1, 2, 2, 3, 3}, fine_weights, {0.5, 3.5}), 0, 1e-14);
}

TEST(UnresolvedStiffness, AJumpBesideAllPointsCountsByItsSize)
{
  const Values weights(3, 1. / 3), fine_weights(6, 1. / 6);
  EXPECT_NEAR(unseen_share({1, 1, 1}, weights, {1, 1, 1, 1, 1, 1}, fine_weights, {101, 1}), 5, 1e-12);
  EXPECT_NEAR(unseen_share({1, 1, 1}, weights, {1, 1, 1, 1, 1, 1}, fine_weights, {0.01, 1}), 0.05 * 99, 1e-12);
  // A jump by 100 that the finer rule sees in one of its six points.
  EXPECT_NEAR(unseen_share({1, 1, 1}, weights, {101, 1, 1, 1, 1, 1}, fine_weights, {1, 1}), 100. / 6, 1e-12);
}

TEST(UnresolvedStiffness, TheErrorOfAJumpInsideACellIsNotCalledGuaranteed)
{
  for (const double left : {100., 0.01})
    for (const double jump : {0.51, 0.57, 0.6, 0.7499})
      for (const unsigned n : {4U, 16U, 128U})
      {
        SCOPED_TRACE(std::to_string(left) + " to " + std::to_string(jump) + ", " + std::to_string(n) + " cells");
        const Solved s = solve_with_jump(left, jump, n);
        EXPECT_FALSE(s.guaranteed);
        EXPECT_NE(s.reason.find("the stiffness varies within cells"), std::string::npos) << s.reason;
        EXPECT_GT(s.total, 0.3 * s.true_error);
      }
}

TEST(UnresolvedStiffness, NoBoundIsFalseWhateverTheContrast)
{
  // Where cells are stiff but for a part of them, u hardly varies on them. With 28 cells and P2 both rules give the cell with the jump at
  // 0.233333 to each side by halves.
  for (const double left : {1e-6, 1e-4, 30., 1e3, 3e4, 1e6, 1e12})
    for (const double jump : {0.31, 0.3333, 0.52, 0.233333})
      for (const unsigned degree : {1u, 2u})
      {
        SCOPED_TRACE(fmt::format("{} to {}, degree {}", left, jump, degree));
        const Solved s = solve_with_jump(left, jump, 28, degree);
        EXPECT_TRUE(!s.guaranteed || s.total >= s.true_error) << s.total << " " << s.true_error;
        EXPECT_GT(s.total, 0.3 * s.true_error);
      }
}

TEST(UnresolvedStiffness, AJumpBetweenCellsIsNone)
{
  const Solved s = solve_with_jump(100, 0.5, 8);
  EXPECT_TRUE(s.guaranteed) << s.reason;
  EXPECT_GE(s.total, s.true_error * (1 - 1e-9));
  EXPECT_LT(s.total, 1.1 * s.true_error);
  EXPECT_TRUE(s.messages.empty());
}
