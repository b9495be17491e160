// Parts of the boundary of which one repeats the other.
#include "elastic_block.h"
#include "small_problem.h"

#include "unilateral/solve.h"

#include <fmt/format.h>

#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace unilateral;

namespace
{
  template <int dim>
  RunResult solve_text(const std::string &text, const std::vector<Override> &overrides = {})
  {
    Diagnostics diagnostics;
    Progress    silent;
    auto        result = solve<dim>(problem_of(case_of(text, overrides)), diagnostics, silent).result;
    EXPECT_TRUE(result.converged) << result.reason << "\n" << text;
    return result;
  }

  /// What it throws.
  template <int dim>
  std::string message_of(const std::string &text)
  {
    try
    {
      solve_text<dim>(text);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }

  const std::string sides = "[[periodic]]\nparts = [\"left\", \"right\"]\n";
} // namespace

// The film of a bearing without a groove, and a sink: where the circle is cut open changes nothing.
TEST(PeriodicParts, the_place_where_the_period_begins_does_not_matter)
{
  const auto solve_with = [](const std::string &element, const double shift)
  {
    return solve_text<1>("[parameters]\nh = \"1 + 0.5*cos(x + shift)\"\nshift = " + fmt::format("{:.16g}", shift) +
                         "\n[mesh]\nbox = [[0], [6.283185307179586]]\ncells = 16\nrefine = 3\n[model]\nkind = \"membrane\"\nelement = \"" +
                         element + "\"\nstiffness = \"h^3\"\nload = \"0.5*sin(x + shift) - 0.1\"\n" + sides +
                         "[constraint]\nlower = 0\n[method]\nformulation = \"mixed\"\n");
  };
  for (const std::string element : {"Q1", "Q2"})
  {
    const auto at_thickest = solve_with(element, 0);
    EXPECT_GT(at_thickest.constraints[0].n_active, 10u);
    EXPECT_EQ(at_thickest.constraints[0].n_points, element == "Q1" ? 128u : 256u); // the point on both parts counts once
    for (const double shift : {0.25 * M_PI, M_PI, 1.5 * M_PI})                     // shifts by whole cells
    {
      const auto elsewhere = solve_with(element, shift);
      EXPECT_NEAR(elsewhere.energy, at_thickest.energy, 1e-9) << element << shift;
      EXPECT_NEAR(elsewhere.max, at_thickest.max, 1e-8) << element << shift;
      EXPECT_NEAR(elsewhere.constraints[0].total_contact_force, at_thickest.constraints[0].total_contact_force, 1e-8) << element << shift;
      EXPECT_EQ(elsewhere.constraints[0].n_active, at_thickest.constraints[0].n_active) << element << shift;
    }
    EXPECT_FALSE(at_thickest.estimate->guaranteed);
    EXPECT_NE(at_thickest.estimate->reason.find("periodic"), std::string::npos);
  }
}

TEST(PeriodicParts, contact_in_the_corner_of_two_pairs_is_that_in_the_middle)
{
  const auto solve_with = [](const std::string &element, const double shift)
  {
    return solve_text<2>(
      fmt::format("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 8\nrefine = 1\n[model]\nkind = \"membrane\"\nelement = \"{}\"\n"
                  "load = -1\n[constraint]\nlower = \"-0.02*(sin(pi*(x - {})))^2 - 0.02*(sin(pi*(y - {})))^2\"\n"
                  "[[periodic]]\nparts = [\"left\", \"right\"]\n[[periodic]]\nparts = [\"bottom\", \"top\"]\n"
                  "[method]\nformulation = \"mixed\"\n",
                  element, shift, shift));
  };
  for (const std::string element : {"Q1", "Q2"})
  {
    const auto corner = solve_with(element, 0), middle = solve_with(element, 0.5);
    EXPECT_NEAR(corner.constraints[0].total_contact_force, 1, 1e-8) << element;
    EXPECT_NEAR(corner.energy, middle.energy, 1e-10) << element;
    EXPECT_EQ(corner.constraints[0].n_points, middle.constraints[0].n_points) << element;
    EXPECT_EQ(corner.constraints[0].n_active, middle.constraints[0].n_active) << element;
    EXPECT_NEAR(corner.constraints[0].max_contact_pressure, middle.constraints[0].max_contact_pressure, 1e-6) << element;
  }
}

// sigma_xx = E/(1 - nu^2) e, sigma_yy = nu sigma_xx in plane stress without lateral strain.
TEST(PeriodicParts, a_jump_is_mean_strain)
{
  for (const std::string element : {"Q1", "P1", "P2", "Q3"})
  {
    const auto result =
      solve_text<2>("[mesh]\nbox = [[0, 0], [2, 1]]\ncells = [4, 2]\n[model]\nkind = \"elasticity\"\nyoung = 91\npoisson = 0.3\n"
                    "assumption = \"plane stress\"\nelement = \"" +
                    element +
                    "\"\n[[periodic]]\nparts = [\"left\", \"right\"]\njump = [0.02, 0]\n"
                    "[[periodic]]\nparts = [\"bottom\", \"top\"]\n[output]\nprobes = [[0.3, 0.6]]\n");
    ASSERT_EQ(result.periodic.size(), 2u);
    EXPECT_NEAR(result.periodic[0].force[0], 1, 1e-8) << element; // 100 * 0.01 * height 1
    EXPECT_NEAR(result.periodic[0].force[1], 0, 1e-8) << element;
    EXPECT_NEAR(result.periodic[1].force[1], 0.6, 1e-8) << element; // over the length 2
    EXPECT_NEAR((*result.probes[0].stress)[0], 1, 1e-7) << element;
    EXPECT_LT(result.balance->residual, 1e-9);
  }
}

// k/L times the jump flows through a strip.
TEST(PeriodicParts, a_jump_drives_a_flow)
{
  const auto result = solve_text<2>("[mesh]\nbox = [[0, 0], [2, 1]]\ncells = [4, 2]\n[model]\nkind = \"membrane\"\nstiffness = 3\n"
                                    "[[periodic]]\nparts = [\"left\", \"right\"]\njump = 0.5\n[boundary]\nbottom = { spring = 0 }\n");
  EXPECT_NEAR(result.periodic[0].force[0], 0.75, 1e-9);
}

// A block under pressure on a smooth floor, held laterally by its neighbours: uniaxial strain.
TEST(PeriodicParts, a_laterally_periodic_block_on_a_floor)
{
  for (const std::string element : {"Q1", "P1", "P2"})
  {
    const auto result = solve_text<3>(
      "[mesh]\nbox = [[0, 0, 0], [1, 1, 1]]\ncells = 2\n[model]\nkind = \"elasticity\"\nyoung = 100\npoisson = 0.3\n"
      "[boundary]\nback = { pressure = 1 }\n[[periodic]]\nparts = [\"left\", \"right\"]\n[[periodic]]\nparts = [\"bottom\", "
      "\"top\"]\n[constraint]\non = \"front\"\ngap = 0\n[method]\nformulation = \"mixed\"\n[output]\nprobes = [[0.5, 0.5, 1]]\n",
      {{"model.element", "\"" + element + "\""}});
    const double M = 100 * 0.7 / (1.3 * 0.4);
    EXPECT_NEAR(result.probes[0].value[2], -1 / M, 1e-8) << element;
    EXPECT_NEAR(result.constraints[0].max_contact_pressure, 1, 1e-6) << element;
    EXPECT_NEAR(result.constraints[0].contact_measure, 1, 1e-9) << element;
    EXPECT_NEAR(result.periodic[0].force[0], -0.3 / 0.7, 1e-6) << element;
  }
}

// A wave in the surface of the body itself: normals on the repeated parts are those of both sides.
TEST(PeriodicParts, the_normal_on_repeated_parts_is_that_of_the_whole_surface)
{
  const std::string file = (std::filesystem::temp_directory_path() / fmt::format("wave-{}.msh", getpid())).string();
  // One row of cells, its lower side a zigzag whose slopes at the ends differ.
  std::ofstream(file)
    << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n1 1 \"left\"\n1 2 \"right\"\n1 3 \"bottom\"\n1 4 \"top\"\n"
       "2 5 \"body\"\n$EndPhysicalNames\n$Nodes\n6\n1 0 0 0\n2 1 0.1 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n$EndNodes\n"
       "$Elements\n8\n1 1 2 1 1 1 4\n2 1 2 2 2 3 6\n3 1 2 3 3 1 2\n4 1 2 3 3 2 3\n5 1 2 4 4 4 5\n6 1 2 4 4 5 6\n"
       "7 3 2 5 5 1 2 5 4\n8 3 2 5 5 2 3 6 5\n$EndElements\n";
  SmallProblem<2> small("[mesh]\nfile = \"" + file +
                        "\"\n[model]\nkind = \"elasticity\"\nyoung = 100\npoisson = 0.3\n[boundary]\ntop = { pressure = 1 }\n" + sides +
                        "[constraint]\non = \"bottom\"\ngap = 0\n");
  ASSERT_EQ(small.constraint_set.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
  {
    EXPECT_NEAR(small.constraint_set.directions[i][0], 0, 1e-12);
    EXPECT_NEAR(small.constraint_set.directions[i][1], -1, 1e-12);
    EXPECT_NEAR(small.constraint_set.points[i].weight, std::hypot(1, 0.1), 1e-12);
  }
  std::filesystem::remove(file);
}

TEST(PeriodicParts, meshes_that_differ_are_refused)
{
  const std::string square =
    "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 4\n[model]\nkind = \"membrane\"\nload = 1\n[boundary]\nall = 0\n" + sides;
  EXPECT_EQ(message_of<2>(square), "");
  EXPECT_NE(message_of<2>(square + "[[mesh.local]]\nwhere = \"x < 0.1\"\n").find("do not match"), std::string::npos);
  EXPECT_EQ(message_of<2>(square + "[[mesh.local]]\nwhere = \"x < 0.1 || x > 0.9\"\n"), "");
}

TEST(PeriodicParts, a_rigid_platen_may_cross_repeated_parts)
{
  const auto result =
    solve_text<2>("[mesh]\nbox = [[0, 0], [2, 3]]\ncells = [4, 6]\n[model]\nkind = \"elasticity\"\nyoung = 91\npoisson = 0.3\n"
                  "assumption = \"plane stress\"\n[boundary]\nbottom = \"symmetry\"\ntop = { rigid = true, force = [0, -2] }\n" +
                  sides);
  EXPECT_NEAR(result.platens[0].translation[1], -1. / 100 * 3, 1e-9); // no lateral strain: E/(1 - nu^2)
  EXPECT_NEAR(result.platens[0].rotation[0], 0, 1e-12);
}
