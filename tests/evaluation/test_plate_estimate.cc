// The estimate of the error of beams and plates against exact solutions.
#include "small_problem.h"

#include "unilateral/solve.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

using namespace unilateral;

namespace
{
  /// A clamped unit square with u = x^2 (1 - x)^2 y^2 (1 - y)^2, D = 1; its corners moved by @p more.
  RunResult clamped_square(const std::string &element, const unsigned cells, const std::string &more = "")
  {
    const auto  text = fmt::format("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = {}\n{}[model]\nkind = \"plate\"\nelement = \"{}\"\n"
                                    "load = \"24*y^2*(1-y)^2 + 24*x^2*(1-x)^2 + 2*(12*x^2-12*x+2)*(12*y^2-12*y+2)\"\n"
                                    "[boundary]\nall = \"clamped\"\n[constraint]\nlower = -1\n[exact]\nu = \"x^2*(1-x)^2*y^2*(1-y)^2\"\n",
                                   cells, more, element);
    Diagnostics diagnostics;
    Progress    quiet;
    return solve<2>(problem_of(case_of(text)), diagnostics, quiet).result;
  }
} // namespace

TEST(PlateEstimate, is_of_the_size_of_the_error)
{
  for (const char *const element : {"c0ip2", "c0ip3", "c0ip2-triangles", "c0ip3-triangles", "hermite"})
    for (const unsigned cells : {8, 16})
    {
      const auto   result = clamped_square(element, cells);
      const double ratio = result.estimate->total / result.errors->H2_semi.value();
      EXPECT_GT(ratio, 0.5) << element << " " << cells;
      EXPECT_LT(ratio, 1.5) << element << " " << cells;
    }
}

TEST(PlateEstimate, of_beams_with_forces_and_moments_inside_cells)
{
  // The square of the energy norm of a simply supported beam of length 1: F u = a^2 b^2/3 with a force at a, M u' = (1 - 3 a b)/3 with a
  // moment.
  for (const double a : {0.3, 0.47})
    for (const bool moment : {false, true})
    {
      const auto text =
        fmt::format("[mesh]\nbox = [[0], [1]]\ncells = 5\n[model]\nkind = \"beam\"\n[boundary]\nall = \"simply supported\"\n"
                    "[constraint]\nlower = -10\n[[point_load]]\nat = [{}]\n{} = 1\n",
                    a, moment ? "moment" : "force");
      Diagnostics  diagnostics;
      Progress     quiet;
      const auto   result = solve<1>(problem_of(case_of(text)), diagnostics, quiet).result;
      const double b = 1 - a, exact_square = moment ? (1 - 3 * a * b) / 3 : a * a * b * b / 3;
      const double error = std::sqrt(exact_square - result.energy_norm * result.energy_norm);
      EXPECT_GT(result.estimate->total / error, 0.9) << a << moment;
      EXPECT_LT(result.estimate->total / error, 2) << a << moment;
    }
}

/// A simply supported square: the square of the error is F (u - u_h) at the force, by the series of Navier.
TEST(PlateEstimate, of_plates_with_forces_at_nodes)
{
  for (const unsigned cells : {10, 20})
  {
    const double x = 0.3, y = 0.4;
    double       u = 0;
    for (unsigned m = 1; m <= 2000; ++m)
      for (unsigned n = 1; n <= 2000; ++n)
        u += 4 * std::pow(std::sin(m * std::numbers::pi * x) * std::sin(n * std::numbers::pi * y), 2) /
             std::pow(std::numbers::pi * std::numbers::pi * (double(m) * m + double(n) * n), 2);
    const auto  text = fmt::format("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = {}\n[model]\nkind = \"plate\"\n[boundary]\n"
                                    "all = \"simply supported\"\n[constraint]\nlower = -1\n[[point_load]]\nat = [{}, {}]\nforce = 1\n",
                                   cells, x, y);
    Diagnostics diagnostics;
    Progress    quiet;
    const auto  result = solve<2>(problem_of(case_of(text)), diagnostics, quiet).result;
    EXPECT_NEAR(result.estimate->total / std::sqrt(u - result.energy_norm * result.energy_norm), 1, 0.1) << cells;
  }
}

/// A clamped disc that presses against a level bound up to r = 0.4, without lateral contraction: the energy norm is that of H^2.
TEST(PlateEstimate, where_contact_ends_between_nodes)
{
  for (const auto &[element, refine] :
       {std::pair("c0ip2", 2), std::pair("c0ip2", 3), std::pair("c0ip3", 2), std::pair("c0ip3", 3), std::pair("c0ip4", 2)})
  {
    const auto text = fmt::format(
      "[mesh]\nball = {{ center = [0, 0], radius = 1 }}\nrefine = {}\n[model]\nkind = \"plate\"\nelement = \"{}\"\nload = 64\npoisson = "
      "0\n"
      "[boundary]\nall = \"clamped\"\n[constraint]\nupper = 0.1031789456312521\n[parameters]\nr = \"hypot(x, y)\"\n[exact]\n"
      "u = \"if(r < 0.4, 0.1031789456312521, r^4 - 0.5980268491678117 - 0.3525591308049136*log(max(r, 0.01)) - 0.4019731508321883*r^2 - "
      "2.84349456753071*r^2*log(max(r, 0.01)))\"\n",
      refine, element);
    Diagnostics  diagnostics;
    Progress     quiet;
    const auto   result = solve<2>(problem_of(case_of(text)), diagnostics, quiet).result;
    const double ratio = result.estimate->total / result.errors->H2_semi.value();
    EXPECT_GT(ratio, 0.6) << element << ' ' << refine;
    EXPECT_LT(ratio, 1.6) << element << ' ' << refine;
  }
}

TEST(PlateEstimate, with_hanging_nodes)
{
  for (const char *const element : {"c0ip2", "c0ip3"})
  {
    const auto   result = clamped_square(element, 8, "[[mesh.local]]\nwhere = \"x < 0.5 && y < 0.5\"\n");
    const double ratio = result.estimate->total / result.errors->H2_semi.value();
    EXPECT_GT(ratio, 0.5) << element;
    EXPECT_LT(ratio, 1.5) << element;
  }
}

TEST(PlateEstimate, vanishes_where_the_element_has_the_solution)
{
  const auto result = clamped_square("c0ip4", 4);
  EXPECT_LT(result.estimate->total, 1e-5 * result.energy_norm);
}

TEST(PlateEstimate, does_not_grow_by_rounding)
{
  // Slopes are subtracted before the jump is squared: a quadratic form of the values at the nodes would lose twice as many digits.
  const auto result = clamped_square("c0ip4", 32);
  EXPECT_LT(result.estimate->total, 1e-6 * result.energy_norm);
}
