// Functionals: integrals known in closed form, sums over constraint points, and what is refused.
#include "small_problem.h"

#include "unilateral/case/problem_of_case.h"
#include "unilateral/evaluation/solution_quantities.h"
#include "unilateral/solve.h"
#include "unilateral/studies/preview.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

using namespace unilateral;

namespace
{
  std::string functional(const std::string &name, const std::string &integrand, const std::string &where = "")
  {
    return fmt::format("[[functional]]\nname = \"{}\"\nintegrand = \"{}\"\n{}\n", name, integrand, where);
  }

  template <int dim>
  Solution<dim> solution_of(const std::string &text)
  {
    Diagnostics   diagnostics;
    Progress      quiet;
    Solution<dim> solution = solve<dim>(problem_of(case_of(text)), diagnostics, quiet);
    EXPECT_TRUE(solution.result.converged) << solution.result.reason;
    return solution;
  }

  std::map<std::string, double> values_of(const RunResult &result)
  {
    std::map<std::string, double> values;
    for (const FunctionalResult &functional : result.functionals)
      values[functional.name] = functional.value;
    return values;
  }

  /// u = x^2 + 2 y, far from its bound.
  const std::string parabola = "[mesh]\nbox = [[0, 0], [2, 1]]\ncells = 3\n[model]\nkind = \"membrane\"\nelement = \"Q2\"\nstiffness = 3\n"
                               "load = -6\n[boundary]\nall = \"x^2 + 2*y\"\n[constraint]\nlower = -100\n";

  /// A column of height 2 and width 1, squeezed by 1e-3 between a plane and its loaded top; free to move sideways.
  const std::string column =
    "[mesh]\nbox = [[0, 0], [1, 2]]\ncells = [2, 4]\n[model]\nkind = \"elasticity\"\nyoung = 1000\npoisson = 0.25\n"
    "element = \"Q1\"\n[boundary]\nleft = \"symmetry\"\ntop = { pressure = 1 }\n[constraint]\non = \"bottom\"\ngap = 0\n";

  std::string complaint(const std::string &text)
  {
    Diagnostics diagnostics;
    Progress    quiet;
    try
    {
      solve<2>(problem_of(case_of(text)), diagnostics, quiet);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }
} // namespace

TEST(Functionals, integrals_of_a_membrane)
{
  const auto f =
    values_of(solution_of<2>("[parameters]\na = \"x + 1\"\n" + parabola + functional("u", "u") + functional("au", "a * u") +
                             functional("slope", "du_dx^2 + du_dy^2") + functional("area", "1") +
                             functional("edge", "u", "on = \"right\"") + functional("flow", "flux_x*nx + flux_y*ny", "on = \"right\"") +
                             functional("normal", "nx*x + ny*y", "on = \"top\"") + functional("region", "u", "region = \"domain\""))
                .result);
  EXPECT_NEAR(f.at("u"), 8. / 3 + 2, 1e-7);
  EXPECT_NEAR(f.at("au"), 4 + 8. / 3 + 2 + 2, 1e-7); // int x^3 + 2xy + x^2 + 2y
  EXPECT_NEAR(f.at("slope"), 32. / 3 + 8, 1e-6);
  EXPECT_NEAR(f.at("area"), 2, 1e-12);
  EXPECT_NEAR(f.at("edge"), 4 + 1, 1e-7);
  EXPECT_NEAR(f.at("flow"), 3 * 4, 1e-6);
  EXPECT_NEAR(f.at("normal"), 2, 1e-12);
  EXPECT_EQ(f.at("region"), f.at("u"));
}

TEST(Functionals, sums_over_constraint_points_are_those_of_the_results)
{
  const std::string text = "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 8\n[model]\nkind = \"membrane\"\nload = -8\n[boundary]\nall = 0\n"
                           "[constraint]\nlower = -0.2\nquadrature = \"gauss(2)\"\n";
  const auto        result = solution_of<2>(text + functional("force", "pressure") + functional("touch", "pressure > 0") +
                                     functional("gap", "gap") + functional("from_u", "if(pressure >= 0, u + 0.2, 0)"))
                        .result;
  const auto f = values_of(result);
  EXPECT_GT(f.at("force"), 1);
  EXPECT_NEAR(f.at("force"), result.constraints[0].total_contact_force, 1e-12);
  EXPECT_NEAR(f.at("touch"), result.constraints[0].contact_measure, 1e-12);
  EXPECT_NEAR(f.at("gap"), f.at("from_u"), 1e-14);
}

TEST(Functionals, a_column_under_pressure)
{
  for (const char *const element : {"Q1", "P2"})
  {
    std::string text = column;
    text.replace(text.find("\"Q1\""), 4, fmt::format("\"{}\"", element));
    const auto f = values_of(
      solution_of<2>(text + functional("stress", "stress_yy") + functional("von_mises", "von_mises", "on = \"top\"") +
                     functional("strain", "duy_dy") + functional("top", "uy", "on = \"top\"") +
                     functional("force", "pressure * ny", "on = \"bottom\"") + functional("moment", "x * pressure", "on = \"bottom\""))
        .result);
    SCOPED_TRACE(element);
    EXPECT_NEAR(f.at("stress"), -2, 1e-6);
    EXPECT_NEAR(f.at("strain"), 2 * -0.9375e-3, 1e-8); // plane strain: (1 - nu^2)/E
    EXPECT_NEAR(f.at("top"), -2 * 0.9375e-3, 1e-8);
    EXPECT_NEAR(f.at("force"), -1, 1e-8);
    EXPECT_NEAR(f.at("moment"), 0.5, 1e-6);
    EXPECT_NEAR(f.at("von_mises"), std::sqrt(0.8125), 1e-6); // of stresses 0, -1, -nu
  }
}

TEST(Functionals, of_bodies_in_space)
{
  std::vector<std::string> elements = {"P1", "P2", "Q2"};
#ifndef DEBUG // deal.II's FESystem asserts what does not hold for triangular faces with nodes
  elements.emplace_back("P3");
#endif
  for (const std::string &element : elements)
  {
    SCOPED_TRACE(element);
    const auto f = values_of(
      solution_of<3>(
        fmt::format("[mesh]\nbox = [[0, 0, 0], [1, 1, 1]]\ncells = 1\n[model]\nkind = \"elasticity\"\nyoung = 1000\npoisson = 0\n"
                    "element = \"{}\"\n[boundary]\nleft = \"symmetry\"\nbottom = \"symmetry\"\nback = {{ pressure = 2 }}\n"
                    "[constraint]\non = \"front\"\ngap = 0\n",
                    element) +
        functional("stress", "stress_zz") + functional("side", "z * uz", "on = \"right\"") + functional("normal", "nz", "on = \"back\""))
        .result);
    EXPECT_NEAR(f.at("stress"), -2, 1e-5);
    EXPECT_NEAR(f.at("side"), -2e-3 / 3, 1e-8);
    EXPECT_NEAR(f.at("normal"), 1, 1e-12);
  }
}

TEST(Functionals, curvature_of_a_beam_and_a_plate)
{
  const auto beam =
    values_of(solution_of<1>("[mesh]\nbox = [[0], [1]]\ncells = 8\n[model]\nkind = \"beam\"\nload = 24\n[boundary]\n"
                             "left = { value = 0, slope = 0 }\nright = { value = 0, slope = 0 }\n[constraint]\nupper = 1\n" +
                             functional("u", "u") + functional("bending", "d2u_dx2") + functional("end", "d2u_dx2", "on = \"left\""))
                .result);                               // x^2 (1 - x)^2
  EXPECT_NEAR(beam.at("u"), 1. / 30, 1.01 / 30 / 4096); // h^4/30 is what cubics leave out
  EXPECT_NEAR(beam.at("bending"), 0, 1e-8);
  EXPECT_NEAR(beam.at("end"), 2, 0.05);
  const auto plate = values_of(solution_of<2>("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 4\n[model]\nkind = \"plate\"\nload = 1\n[boundary]\n"
                                              "all = { value = 0 }\n[constraint]\nupper = 1\n" +
                                              functional("twist", "d2u_dxdy") + functional("slope", "du_dx", "on = \"left\""))
                                 .result);
  EXPECT_NEAR(plate.at("twist"), 0, 1e-8);
  EXPECT_GT(plate.at("slope"), 1e-3);
}

TEST(Functionals, go_round_the_full_circle_where_axisymmetric)
{
  std::string text = column;
  text.replace(text.find("\"elasticity\""), 12, "\"elasticity\"\nassumption = \"axisymmetric\"");
  text.replace(text.find("left = \"symmetry\"\n"), 18, "");
  const auto f = values_of(solution_of<2>(text + functional("volume", "1") + functional("force", "pressure", "on = \"bottom\"")).result);
  EXPECT_NEAR(f.at("volume"), 2 * std::numbers::pi, 1e-10);
  EXPECT_NEAR(f.at("force"), std::numbers::pi, 1e-6);
}

TEST(Functionals, say_what_they_cannot_be)
{
  const auto says = [](const std::string &text, const std::string &part)
  { EXPECT_NE(complaint(text).find(part), std::string::npos) << complaint(text); };
  says(parabola + functional("a", "u", "on = \"lid\""), "no part 'lid'");
  says(parabola + functional("a", "u", "region = \"core\""), "no region 'core'");
  says(parabola + functional("a", "u", "on = \"left\"\nregion = \"domain\""), "give one of them");
  says(parabola + functional("a", "nx"), "needs a part of the boundary");
  says(parabola + functional("a", "pressure", "on = \"left\""), "no constraint acts there");
  says(parabola + functional("a", "pressure * du_dx"), "not known at the points of a constraint");
  says(parabola + functional("a", "ux"), "unknown name 'ux'");
  says("[parameters]\ngap = 2\n" + parabola + functional("a", "gap"), "is a parameter and a quantity");
  says(column + functional("a", "pressure"), "name the part of the boundary");
  says(parabola + functional("a", "u") + functional("a", "1"), "exists already");
  says(parabola + functional("a b", "u"), "letters, digits");
  says(parabola + "[[functional]]\nname = \"a\"\n", "'integrand' is missing");
}

TEST(Functionals, are_checked_without_a_solution)
{
  Diagnostics diagnostics;
  Progress    quiet;
  EXPECT_THROW(check<2>(problem_of(case_of(parabola + functional("stress", "stress_xx"))), diagnostics, quiet), InputError);
  EXPECT_NO_THROW(check<2>(problem_of(case_of(parabola + functional("slope", "du_dx"))), diagnostics, quiet));
}

TEST(SolutionQuantities, have_names_of_their_own)
{
  for (unsigned dim = 1; dim <= 3; ++dim)
    for (const unsigned n_components : {1u, dim})
      for (unsigned order = 0; order <= 2; ++order)
      {
        auto names = names_of(solution_quantities(n_components, order, dim));
        std::sort(names.begin(), names.end());
        EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
      }
}
