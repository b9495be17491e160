// The estimate of the mesh's error where there is no bound: against exact solutions, and better with finer meshes.
#include "small_problem.h"

#include "unilateral/mesh/cell_list.h"
#include "unilateral/solve.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
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
    const double ratio = effectivity_with_velocity(element, element == std::string("Q3") ? 32 : 16); // 1.25 with 16
    EXPECT_GT(ratio, 0.8) << element;
    EXPECT_LT(ratio, 1.2) << element;
  }
  EXPECT_GT(effectivity_with_velocity("Q4", 8), 0.9);
  EXPECT_LT(effectivity_with_velocity("Q4", 8), 8);
}

TEST(EstimateWithoutBound, is_not_below_the_error_of_cubic_elements_at_singularities)
{
  // The energy is that of Q3 on meshes refined four and five times, extrapolated; a second constraint on the part takes the bound away.
  constexpr double energy = -0.0709868007;
  for (const char *const element : {"Q3", "P3"})
  {
    Diagnostics diagnostics;
    Progress    quiet;
    const auto  text =
      fmt::format("[mesh]\nbox = [[0, 0], [2, 1]]\ncells = [4, 2]\nrefine = 1\n[model]\nkind = \"elasticity\"\nelement = \"{}\"\n"
                  "young = 1000\npoisson = 0.3\nload = [0, \"-3*x\"]\n[boundary]\nleft = {{ x = 0 }}\n"
                  "right = {{ spring = [30, 10], traction = [\"2*y\", 0] }}\ntop = {{ pressure = \"if(x > 1.5, 6, 1)\" }}\n"
                  "[[constraint]]\non = \"bottom\"\ngap = \"0.002 + 0.004*(x - 0.7)^2\"\n"
                  "[[constraint]]\non = \"bottom\"\ngap = {{ plane = {{ point = [0, -0.0035], normal = [0.05, 1] }} }}\n",
                  element);
    const auto   result = solve<2>(problem_of(case_of(text)), diagnostics, quiet).result;
    const double error = std::sqrt(2 * (result.energy - energy));
    EXPECT_FALSE(result.estimate->guaranteed);
    EXPECT_GT(result.estimate->total, 0.9 * error) << element;
    EXPECT_LT(result.estimate->total, 3 * error) << element;
  }
}

TEST(EstimateWithoutBound, lets_the_moment_of_a_beam_jump_where_something_bears_it)
{
  // u is a function of the finite elements: nothing is wrong with it.
  const std::string beam = "[mesh]\nbox = [[0], [2]]\ncells = 4\n[model]\nkind = \"beam\"\n[boundary]\nall = \"simply supported\"\n"
                           "[constraint]\nlower = -10\n";
  for (const std::string more : {"[[point_load]]\nat = 1\nmoment = 1\n", "[[support]]\nat = 1\nslope = 0.01\n"})
  {
    Diagnostics diagnostics;
    Progress    quiet;
    const auto  result = solve<1>(problem_of(case_of(beam + more)), diagnostics, quiet).result;
    EXPECT_TRUE(result.converged) << result.reason;
    EXPECT_LT(result.estimate->discretisation, 1e-9 * result.energy_norm) << more;
  }
}

TEST(EstimateWithoutBound, does_not_grow_on_hexahedra_that_are_hardly_warped)
{
  // Two layers of cells, their inner vertices moved a little out of their planes: powers across a layer are hardly determined by samples in
  // it.
  const auto with_vertices_moved = [](const double distance)
  {
    auto           list = std::make_shared<CellList>();
    const unsigned n[3] = {4, 4, 2};
    const auto     number = [&](const unsigned i, const unsigned j, const unsigned k) { return (k * (n[1] + 1) + j) * (n[0] + 1) + i; };
    list->kind = CellKind::hexahedron;
    list->region_names = {"body"};
    for (unsigned k = 0; k <= n[2]; ++k)
      for (unsigned j = 0; j <= n[1]; ++j)
        for (unsigned i = 0; i <= n[0]; ++i)
        {
          std::array<double, 3> x = {0.25 * i, 0.25 * j, 0.25 * k};
          if (i % n[0] > 0 && j % n[1] > 0 && k % n[2] > 0)
            for (unsigned d = 0; d < 3; ++d)
              x[d] += distance * std::sin(7. * i + 5. * j + 3. * k + 2. * d);
          list->vertices.push_back(x);
        }
    for (unsigned k = 0; k < n[2]; ++k)
      for (unsigned j = 0; j < n[1]; ++j)
        for (unsigned i = 0; i < n[0]; ++i)
        {
          auto &cell = list->cells.emplace_back();
          for (unsigned v = 0; v < 8; ++v)
            cell.push_back(number(i + v % 2, j + v / 2 % 2, k + v / 4));
          list->cell_region.push_back(0);
        }
    return std::shared_ptr<const CellList>(list);
  };
  const auto estimate = [&](const double distance)
  {
    auto problem =
      problem_of(case_of("[mesh]\nbox = [[0, 0, 0], [1, 1, 1]]\nrefine = 1\n[model]\nkind = \"membrane\"\nelement = \"Q2\"\nload = -1\n"
                         "[boundary]\nall = 0\n[constraint]\nlower = -1\n"));
    static_cast<MeshDescription &>(problem.mesh) = mesh_of(with_vertices_moved(distance));
    Diagnostics diagnostics;
    Progress    quiet;
    return solve<3>(problem, diagnostics, quiet).result.discretisation_indicator;
  };
  const double straight = estimate(0);
  for (const double distance : {1e-3, 5e-3, 2e-2})
  {
    EXPECT_GT(estimate(distance), 0.8 * straight) << distance;
    EXPECT_LT(estimate(distance), 1.3 * straight) << distance;
  }
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
