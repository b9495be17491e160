// Parts of a body that are bonded to rigid platens.
#include "elastic_block.h"
#include "small_problem.h"

#include "unilateral/solve.h"

#include <fmt/format.h>

#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>

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
    EXPECT_LT(result.balance->residual, 1e-8) << text;
    return result;
  }

  std::string block_2d(const std::string &boundary, const double poisson = 0)
  {
    return fmt::format("[mesh]\nbox = [[0, 0], [2, 3]]\ncells = [2, 3]\nrefine = 1\n[model]\nkind = \"elasticity\"\nyoung = 100\n"
                       "poisson = {}\nassumption = \"plane stress\"\n[boundary]\n{}\n",
                       poisson, boundary);
  }

  std::string block_3d(const std::string &boundary, const std::string &element)
  {
    return "[mesh]\nbox = [[0, 0, 0], [2, 1, 1]]\ncells = [4, 2, 2]\n[model]\nkind = \"elasticity\"\nyoung = 100\npoisson = 0.3\nelement = "
           "\"" +
           element + "\"\n[boundary]\nleft = \"clamped\"\n" + boundary;
  }
} // namespace

// With nu = 0 every fibre is a bar: u = F H/(E A).
TEST(RigidParts, a_block_without_lateral_strain_is_a_bar)
{
  for (const std::string element : {"Q1", "Q2", "P1", "P2", "P3"})
    for (const std::string rigid : {"true", "\"translation\""})
    {
      const auto result = solve_text<2>(block_2d("bottom = \"clamped\"\ntop = { rigid = " + rigid + ", force = [0, -4] }"),
                                        {{"model.element", "\"" + element + "\""}});
      ASSERT_EQ(result.platens.size(), 1u);
      const auto &platen = result.platens[0];
      EXPECT_NEAR(platen.translation[1], -4. * 3 / (100 * 2), 1e-10) << element;
      EXPECT_NEAR(platen.translation[0], 0, 1e-10) << element;
      EXPECT_NEAR(platen.rotation[0], 0, 1e-10) << element;
      EXPECT_NEAR(platen.force[1], -4, 1e-9) << element;
      EXPECT_NEAR(result.balance->reaction[1], 4, 1e-9) << element;
    }
}

TEST(RigidParts, a_prescribed_motion_takes_the_force_of_a_bar)
{
  const auto result = solve_text<2>(block_2d("bottom = \"clamped\"\ntop = { rigid = \"translation\", y = \"-0.06\" }"));
  EXPECT_NEAR(result.platens[0].force[1], -4, 1e-9);
  EXPECT_NEAR(result.platens[0].force[0], 0, 1e-9);
  EXPECT_NEAR(result.balance->reaction[1], 0, 1e-9); // platen and floor
  ASSERT_EQ(result.balance->reactions.size(), 2u);
}

TEST(RigidParts, hanging_nodes_follow)
{
  const auto result = solve_text<2>(block_2d("bottom = \"clamped\"\ntop = { rigid = true, force = [0, -4] }") +
                                    "[[mesh.local]]\nwhere = \"x < 1\"\ntimes = 2\n");
  EXPECT_NEAR(result.platens[0].translation[1], -0.06, 1e-10);
}

// F H/(E pi R^2)
TEST(RigidParts, an_axisymmetric_platen_moves_along_the_axis)
{
  const auto result =
    solve_text<2>("[mesh]\nbox = [[0, 0], [2, 3]]\ncells = [2, 3]\nrefine = 1\n[model]\nkind = \"elasticity\"\nyoung = 100\n"
                  "poisson = 0\nassumption = \"axisymmetric\"\n[boundary]\nbottom = \"clamped\"\n"
                  "top = { rigid = true, force = [0, -4] }\n");
  EXPECT_NEAR(result.platens[0].translation[1], -4. * 3 / (100 * 4 * M_PI), 1e-10);
  EXPECT_NEAR(result.platens[0].force[1], -4, 1e-9);
  EXPECT_TRUE(result.platens[0].rotation.empty());
}

// The moment that a prescribed rotation takes makes this rotation; in three dimensions, where it couples to a lateral motion.
TEST(RigidParts, rotation_and_moment_belong_together)
{
  for (const std::string element : {"Q2", "P2", "P1"})
  {
    const auto turned =
      solve_text<3>(block_3d("right = { rigid = true, rotation = { y = 0.01, x = 0.02 }, force = [0, 1, 0] }\n", element));
    const auto &known = turned.platens[0];
    const auto  loaded = solve_text<3>(block_3d(
       fmt::format("right = {{ rigid = true, moment = [{:.16g}, {:.16g}, 0], force = [0, 1, 0] }}\n", known.moment[0], known.moment[1]),
       element));
    const auto &found = loaded.platens[0];
    EXPECT_NEAR(known.rotation[1], 0.01, 1e-12);
    for (unsigned c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(found.rotation[c], known.rotation[c], 1e-8) << element;
      EXPECT_NEAR(found.translation[c], known.translation[c], 1e-8) << element;
      EXPECT_NEAR(found.moment[c], known.moment[c], 1e-7) << element;
      EXPECT_NEAR(found.force[c], known.force[c], 1e-7) << element;
    }
    EXPECT_NEAR(found.force[1], 1, 1e-8) << element;
    EXPECT_NEAR(found.moment[2], 0, 1e-8) << element;
  }
}

// Where a plane of symmetry meets the platen it stops its rotation and what goes across.
TEST(RigidParts, half_a_block_moves_as_the_whole)
{
  const auto text = [](const double left, const unsigned cells, const std::string &boundary)
  {
    return fmt::format("[mesh]\nbox = [[{}, 0], [2, 3]]\ncells = [{}, 6]\n[model]\nkind = \"elasticity\"\nyoung = 100\npoisson = 0.4\n"
                       "[boundary]\nbottom = \"clamped\"\n{}",
                       left, cells, boundary);
  };
  const auto whole = solve_text<2>(text(-2, 8, "top = { rigid = true, force = [0, -4] }\n")),
             half = solve_text<2>(text(0, 4, "top = { rigid = true, force = [0, -2] }\nleft = \"symmetry\"\n"));
  EXPECT_NEAR(half.platens[0].translation[1], whole.platens[0].translation[1], 1e-10);
  EXPECT_NEAR(half.platens[0].rotation[0], 0, 1e-12);
  EXPECT_NEAR(half.platens[0].force[1], -2, 1e-9);
  EXPECT_LT(whole.platens[0].translation[1], -0.01);
}

TEST(RigidParts, solvers_agree)
{
  const std::string text =
    block_2d("bottom = \"clamped\"\ntop = { rigid = true, force = [1, -4], moment = 0.5 }\nright = { pressure = 1 }", 0.3);
  const auto direct = solve_text<2>(text, {{"method.solver", "\"direct\""}});
  for (const std::string element : {"Q1", "P1", "Q2"})
  {
    const auto one = solve_text<2>(text, {{"method.solver", "\"direct\""}, {"model.element", "\"" + element + "\""}}),
               other = solve_text<2>(
                 text, {{"method.solver", "\"amg\""}, {"model.element", "\"" + element + "\""}, {"method.tolerance", "1e-10"}});
    for (unsigned c = 0; c < 2; ++c)
      EXPECT_NEAR(one.platens[0].translation[c], other.platens[0].translation[c], 1e-8) << element;
    EXPECT_NEAR(one.platens[0].rotation[0], other.platens[0].rotation[0], 1e-8) << element;
  }
  EXPECT_THROW(solve_text<2>(text, {{"method.solver", "\"multigrid\""}}), InputError);
}

// Only contact holds it: a round foot that a platen presses on a plane, and that may tilt.
TEST(RigidParts, a_body_held_by_contact_alone)
{
  const std::string text =
    "[mesh]\nbox = [[-1, 0], [1, 1]]\ncells = [8, 4]\nrefine = 1\n[model]\nkind = \"elasticity\"\nyoung = 100\npoisson = 0.3\n"
    "[boundary]\ntop = { rigid = true, force = [0, -4], about = [0.1, 1] }\n[constraint]\non = \"bottom\"\ngap = "
    "\"0.05*x^2\"\n";
  const auto result = solve_text<2>(text);
  EXPECT_NEAR(result.constraints[0].contact_force[1], 4, 1e-8);
  EXPECT_NEAR(result.constraints[0].contact_moment[0], 0.4, 1e-7); // the centre of pressure lies below the force
  EXPECT_LT(result.platens[0].rotation[0], -1e-4);                 // down on the right
  EXPECT_NEAR(result.platens[0].moment[0], 0, 1e-8);
  // A prescribed motion makes the same contact as its force.
  const auto moved =
    solve_text<2>(text, {{"boundary.top", fmt::format("{{ rigid = true, y = {:.15g}, x = 0, rotation = {:.15g}, about = [0.1, 1] }}",
                                                      result.platens[0].translation[1], result.platens[0].rotation[0])}});
  EXPECT_NEAR(moved.constraints[0].contact_force[1], 4, 1e-6);
  EXPECT_NEAR(moved.platens[0].force[1], -4, 1e-6);
}

TEST(RigidParts, an_upward_force_is_refused_where_only_contact_holds)
{
  EXPECT_THROW(solve_text<2>(block_2d("top = { rigid = true, force = [0, 4] }\n[constraint]\non = \"bottom\"\ngap = 0\n")), InputError);
}

TEST(RigidParts, those_that_meet_are_refused)
{
  EXPECT_THROW(solve_text<2>(block_2d("bottom = \"clamped\"\ntop = { rigid = true }\nright = { rigid = true }")), InputError);
}
