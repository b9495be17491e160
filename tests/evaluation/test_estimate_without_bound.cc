// The estimate of the mesh's error where there is no bound: against exact solutions, and better with finer meshes.
#include "small_problem.h"

#include "unilateral/solve.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <string>

using namespace unilateral;

namespace
{
  /// The estimate over the error in the energy norm. A velocity makes the form one without a bound.
  double effectivity_with_velocity(const std::string &element, const unsigned cells, const std::string &more = "")
  {
    Diagnostics diagnostics;
    Progress    quiet;
    const auto  text =
      fmt::format("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = {}\n{}[model]\nkind = \"membrane\"\nelement = \"{}\"\nvelocity = [3, 1]\n"
                  "load = \"2*pi^2*sin(pi*x)*sin(pi*y) + 3*pi*cos(pi*x)*sin(pi*y) + pi*sin(pi*x)*cos(pi*y)\"\n"
                  "[boundary]\nall = 0\n[constraint]\nupper = 2\n[exact]\nu = \"sin(pi*x)*sin(pi*y)\"\n",
                  cells, more, element);
    const auto result = solve<2>(problem_of(case_of(text)), diagnostics, quiet).result;
    EXPECT_FALSE(result.estimate->guaranteed);
    return result.estimate->total / result.errors->H1_semi.value();
  }

  /// Lame's tube under pressure inside: the estimate over the error in the H1 seminorm, which is close to the energy norm with E = 1.
  double effectivity_of_tube(const std::string &element, const unsigned cells)
  {
    Diagnostics diagnostics;
    Progress    quiet;
    const auto  text =
      fmt::format("[mesh]\nbox = [[1, 0], [2, 1]]\ncells = {}\n[model]\nkind = \"elasticity\"\nelement = \"{}\"\nyoung = 1\npoisson = 0.3\n"
                  "assumption = \"axisymmetric\"\n[boundary]\nleft = {{ pressure = 0.01 }}\ntop = \"symmetry\"\nbottom = \"symmetry\"\n"
                  "[constraint]\non = \"right\"\ngap = 1\n[exact]\nu = [\"1.3*0.01/3*(0.4*x + 4/x)\", \"0*x\"]\n",
                  cells, element);
    const auto result = solve<2>(problem_of(case_of(text)), diagnostics, quiet).result;
    return result.estimate->total / result.errors->H1_semi.value();
  }
} // namespace

TEST(EstimateWithoutBound, is_close_to_the_error_for_every_degree)
{
  for (const char *const element : {"Q1", "Q2", "Q3", "P1", "P2", "P3"})
  {
    const double ratio = effectivity_with_velocity(element, 16);
    EXPECT_GT(ratio, 0.8) << element;
    EXPECT_LT(ratio, 1.2) << element;
  }
  EXPECT_GT(effectivity_with_velocity("Q4", 8), 0.9);
  EXPECT_LT(effectivity_with_velocity("Q4", 8), 8);
}

TEST(EstimateWithoutBound, gets_better_on_finer_meshes)
{
  for (const char *const element : {"Q2", "P2", "Q4"})
    EXPECT_LE(std::abs(effectivity_with_velocity(element, 16) - 1), std::abs(effectivity_with_velocity(element, 8) - 1) + 0.02) << element;
}

TEST(EstimateWithoutBound, knows_hanging_nodes)
{
  for (const char *const element : {"Q1", "Q2"})
  {
    const double ratio = effectivity_with_velocity(element, 8, "[[mesh.local]]\nwhere = \"x < 0.5 && y < 0.5\"\n");
    EXPECT_GT(ratio, 0.8) << element;
    EXPECT_LT(ratio, 1.4) << element;
  }
}

TEST(EstimateWithoutBound, of_bodies_of_revolution)
{
  for (const char *const element : {"Q1", "Q2", "Q3", "P1", "P2", "P3"})
  {
    const double ratio = effectivity_of_tube(element, 8);
    EXPECT_GT(ratio, 0.7) << element;
    EXPECT_LT(ratio, 1.4) << element;
  }
}
