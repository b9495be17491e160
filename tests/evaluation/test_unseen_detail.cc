// Data with a feature between the points of a cell are found, and no others are suspected.
#include "solved_case.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

using namespace unilateral;

namespace
{
  std::string string_on(const unsigned cells, const std::string &more)
  {
    return fmt::format("mesh.box = [[0], [1]]\nmesh.cells = {}\nmodel.kind = \"membrane\"\nboundary.all = 0\n{}\n", cells, more);
  }

  std::string membrane_on(const unsigned cells, const std::string &more)
  {
    return fmt::format("mesh.box = [[0, 0], [1, 1]]\nmesh.cells = {}\nmodel.kind = \"membrane\"\nboundary.all = 0\n{}\n", cells, more);
  }

  double relative_estimate(const RunResult &result)
  {
    return result.estimate->total / result.energy_norm;
  }

  /// No bound, and a warning that says where.
  void expect_found(const RunResult &result, const std::string &what)
  {
    ASSERT_FALSE(result.unseen_details.empty()) << what;
    EXPECT_EQ(result.unseen_details[0].what, what);
    EXPECT_FALSE(result.estimate->guaranteed);
    EXPECT_NE(result.estimate->reason.find("what their points do not show"), std::string::npos) << result.estimate->reason;
    EXPECT_TRUE(std::any_of(result.warnings.begin(), result.warnings.end(),
                            [&](const Diagnostic &d) { return d.message.find("'" + what + "' is") != std::string::npos; }));
  }
} // namespace

TEST(UnseenDetail, a_weak_layer_thinner_than_a_cell)
{
  for (const std::string &element : {"P1", "P2", "P3"})
  {
    const RunResult result = result_of<1>(
      string_on(10, "model.load = -1\nmodel.element = \"" + element + "\"\nmodel.stiffness = \"if(x>0.371 && x<0.3715, 1e-5, 1)\""));
    expect_found(result, "stiffness");
    EXPECT_NEAR(result.unseen_details[0].x[0], 0.37125, 0.00026);
    EXPECT_EQ(result.unseen_details[0].value, 1e-5);
    EXPECT_EQ(result.unseen_details[0].least, 1);
  }
  expect_found(result_of<2>(membrane_on(8, "model.load = -1\nmodel.stiffness = \"if(abs(x + 0.3*y - 0.61) < 0.002, 1e-3, 1)\"")),
               "stiffness");
}

TEST(UnseenDetail, a_load_in_a_needle)
{
  expect_found(result_of<1>(string_on(10, "model.load = \"1 + 1000*exp(-((x - 0.33)/0.0005)^2)\"")), "load");
  expect_found(result_of<2>(membrane_on(8, "model.load = \"-1 - 1e4*exp(-((x - 0.33)^2 + (y - 0.61)^2)/0.004^2)\"")), "load");
}

TEST(UnseenDetail, a_load_in_a_strip_at_the_edge)
{
  // A hundredth of a cell wide: the corners of cells lie in it, and no point of their rules.
  for (const std::string element : {"Q1", "Q2", "P1"})
  {
    const auto result = result_of<2>("mesh.box = [[0, 0], [1, 1]]\nmesh.cells = 4\nmodel = { kind = \"membrane\", element = \"" + element +
                                     "\", load = \"if(x > 0.9975, -300, -1)\" }\nboundary.all = 0\nconstraint.lower = -10\n");
    EXPECT_FALSE(result.estimate->guaranteed) << element;
    EXPECT_FALSE(result.unseen_details.empty()) << element;
  }
}

TEST(UnseenDetail, a_flux_in_a_strip_between_the_points_of_a_face)
{
  const auto result =
    result_of<2>("mesh.box = [[0, 0], [1, 1]]\nmesh.cells = 2\nmodel = { kind = \"membrane\", load = -1 }\n"
                 "boundary = { left = 0, top = { flux = \"if(abs(x - 0.3) < 0.004, 80, 1)\" } }\nconstraint.lower = -10\n");
  EXPECT_FALSE(result.estimate->guaranteed);
  ASSERT_FALSE(result.unseen_details.empty());
  EXPECT_EQ(result.unseen_details[0].what, "data on top");
}

TEST(UnseenDetail, a_peak_of_the_obstacle)
{
  expect_found(result_of<1>(string_on(8, "model.load = -1\nmodel.element = \"P2\"\n"
                                         "constraint.lower = \"max(-1, 0.5 - 200*abs(x - 0.36))\"")),
               "bound");
  // One that stays below u is none of its business.
  EXPECT_TRUE(
    result_of<1>(string_on(8, "model.load = 1\nconstraint.lower = \"max(-1, -0.5 - 200*abs(x - 0.36))\"")).unseen_details.empty());
}

TEST(UnseenDetail, an_obstacle_that_u_crosses_between_points)
{
  // Whatever its values elsewhere: u is -0.485 at the wedge, which points of the rule see far below. Exact energy: the membrane on it.
  const RunResult wedge =
    result_of<1>(string_on(4, "model.load = -4\nmodel.element = \"P2\"\nconstraint.lower = \"-0.1 - 50*abs(x - 0.4142)\""));
  expect_found(wedge, "bound");
  EXPECT_NEAR(wedge.unseen_details[0].x[0], 0.4142, 0.004);
  EXPECT_GT(relative_estimate(wedge), 0.5); // of 0.67
  // A paraboloid, which Q2 and P2 interpolate exactly, and a cone.
  const std::string parabola = "-0.1 - 1000*((x - 0.537)^2 + (y - 0.463)^2)", cone = "-0.1 - 200*hypot(x - 0.537, y - 0.463)";
  for (const auto &[element, bound] : {std::pair<std::string, std::string>("Q2", parabola), {"P2", parabola}, {"Q5", cone}})
  {
    const RunResult hill =
      result_of<2>(membrane_on(4, "model.load = -10\nmodel.element = \"" + element + "\"\nconstraint.lower = \"" + bound + "\""));
    expect_found(hill, "bound");
    EXPECT_GT(relative_estimate(hill), 0.3) << element;
  }
  // In space, on cells of both kinds, beside one that stays below u.
  for (const std::string &element : {"Q2", "P2"})
    for (const bool crosses : {true, false})
    {
      const RunResult spike = result_of<3>(
        fmt::format("mesh.box = [[0, 0, 0], [1, 1, 1]]\nmesh.cells = 3\nmodel.kind = \"membrane\"\nmodel.load = -10\nboundary.all = 0\n"
                    "model.element = \"{}\"\nconstraint.lower = \"{} - 400*((x - 0.43)^2 + (y - 0.53)^2 + (z - 0.47)^2)\"\n",
                    element, crosses ? "-0.05" : "-0.7"));
      EXPECT_EQ(spike.unseen_details.empty(), !crosses) << element;
    }
  // And on curved cells, where there is only an estimate.
  const RunResult disc = result_of<2>("mesh.ball = { center = [0, 0], radius = 1 }\nmesh.refine = 2\nmodel.kind = \"membrane\"\n"
                                      "model.element = \"P2\"\nmodel.load = -1\nboundary.all = 0\n"
                                      "constraint.lower = \"-0.1 - 100*((x - 0.111)^2 + (y - 0.077)^2)\"\n");
  EXPECT_FALSE(disc.unseen_details.empty());
  EXPECT_GT(relative_estimate(disc), 0.2);
}

TEST(UnseenDetail, refinement_finds_an_obstacle_that_u_crosses)
{
  const RunResult result = result_of<1>(string_on(4, "model.load = -4\nmodel.element = \"P2\"\nmesh.adapt = { tolerance = 0.02 }\n"
                                                     "constraint.lower = \"-0.1 - 50*abs(x - 0.4142)\""));
  EXPECT_TRUE(result.unseen_details.empty());
  // Two parabolas that meet in (0.4142, -0.1): energy 16 (a^3 + b^3)/12 + 0.01/(a b).
  const double a = 0.4142, b = 1 - a;
  EXPECT_NEAR(result.energy_norm, std::sqrt(4. / 3 * (a * a * a + b * b * b) + 0.01 / (a * b)), 0.02 * result.energy_norm);
}

/// Points lie on a plateau of the obstacle, or beside it, and none between.
TEST(UnseenDetail, a_plateau_whose_slopes_no_point_sees)
{
  const std::string in_the_plane = "constraint.lower = \"0.3 - 1.3*clamp(max(abs(x - 0.516) - 3e-3, abs(y - 0.51) - 0.3)/5e-3, 0, 1)\"";
  for (const std::string load : {"0", "1"})
  {
    const RunResult result = result_of<2>(membrane_on(32, "model.load = " + load + "\n" + in_the_plane));
    expect_found(result, "bound");
    EXPECT_GT(result.estimate->total, 0.15); // on 0.6 of all lines u rises by 0.3 and falls again: the error is 0.46 at least
  }
  expect_found(
    result_of<2>(membrane_on(
      400, "constraint.lower = \"0.3 - 1.3*clamp((abs(x - 0.50128) - 0.00024)/0.0004, 0, 1) - 40*max(0, abs(y - 0.51) - 0.3)\"")),
    "bound");
  expect_found(result_of<1>(string_on(
                 64, "model.element = \"P3\"\n"
                     "constraint.lower = \"0.3 - 0.5*clamp((abs(x - 0.273368143574) - 0.00164111773163)/0.00107542957347, 0, 1)\"")),
               "bound");
  expect_found(result_of<1>(string_on(100, "constraint.lower = \"if(abs(x - 0.51234) < 1e-3, 0.3, -1)\"")), "bound");
}

TEST(UnseenDetail, refinement_finds_a_plateau_between_nodes)
{
  // Seen by points, which alone changes nothing where u is zero. In one dimension: slopes of 0.3 over the distance from both ends.
  const auto of_string =
    result_of<1>("mesh.box = [[0], [1]]\nmesh.cells = 4\nmesh.adapt = { tolerance = 0.01 }\nmodel.kind = \"membrane\"\n"
                 "boundary.all = 0\nconstraint.lower = \"0.3 - 0.5*clamp((abs(x - 0.3427) - 0.05)/0.0083, 0, 1)\"\n");
  EXPECT_TRUE(of_string.estimate->guaranteed);
  EXPECT_NEAR(of_string.constraints[0].total_contact_force, 0.3 / (0.3427 - 0.05) + 0.3 / (1 - 0.3427 - 0.05), 1e-3);

  // A cone that an adapted mesh does not see any more, after contact on the one before.
  const auto of_membrane =
    result_of<2>("mesh.box = [[0, 0], [1, 1]]\nmesh.cells = 32\nmesh.adapt = { tolerance = 0.1, max_unknowns = 50000 }\n"
                 "model = { kind = \"membrane\", element = \"P2\" }\nboundary.all = 0\n"
                 "constraint.lower = \"max(-1, 0.3 - 100*hypot(x - 0.516, y - 0.516))\"\n");
  EXPECT_TRUE(of_membrane.converged) << of_membrane.reason;
  EXPECT_NEAR(of_membrane.constraints[0].total_contact_force, 0.227, 0.004);
}

/// The estimate beside the closed form, at any place of the node next to the end of contact.
TEST(UnseenDetail, beams_that_touch_between_two_nodes)
{
  const auto effectivity = [](const std::string &text)
  {
    const RunResult result = result_of<1>(text);
    return result.estimate->total / *result.errors->H2_semi; // EI = 1
  };
  const std::string end = "model.kind = \"beam\"\n",
                    ends_of_contact = "boundary.all = \"simply supported\"\nmodel.load = 1\n"
                                      "constraint.upper = 3.375e-4\n[parameters]\nt = \"min(x, 1 - x)\"\ns = \"max(0.3 - t, 0)\"\n"
                                      "[exact]\nu = \"3.375e-4 - 0.3*s^3/12 + s^4/24\"\n";
  const std::string one_point = "boundary.all = \"clamped\"\nmodel.load = -384\nconstraint.lower = -0.5\n[parameters]\n"
                                "t = \"min(x, 1 - x)\"\n[exact]\nu = \"-16*t^4 + 24*t^3 - 10*t^2\"\n";
  for (const unsigned cells : {16, 33, 64, 128})
  {
    const double of_ends = effectivity(fmt::format("mesh.box = [[0], [1]]\nmesh.cells = {}\n{}{}", cells, end, ends_of_contact));
    EXPECT_GT(of_ends, 0.9) << cells;
    EXPECT_LT(of_ends, 2) << cells;
  }
  for (const unsigned cells : {17, 65, 257})
  {
    const double of_point = effectivity(fmt::format("mesh.box = [[0], [1]]\nmesh.cells = {}\n{}{}", cells, end, one_point));
    EXPECT_GT(of_point, 0.9) << cells;
    EXPECT_LT(of_point, 1.2) << cells;
  }
}

TEST(UnseenDetail, beams_between_their_nodes)
{
  const auto beam = [](const unsigned cells, const std::string &bound)
  {
    return fmt::format("mesh.box = [[0], [1]]\nmesh.cells = {}\nmodel.kind = \"beam\"\nmodel.load = -1\n"
                       "boundary.all = \"simply supported\"\nconstraint.lower = \"{}\"\n",
                       cells, bound);
  };
  // On a wedge in the middle of a cell nearly nothing of the contact force 0.4375 is there, and 65 % of the energy norm are wrong.
  const RunResult wedge = result_of<1>(beam(65, "-0.00390625 - abs(x - 0.5)"));
  EXPECT_FALSE(wedge.unseen_details.empty());
  EXPECT_GT(relative_estimate(wedge), 0.5);
  // A parabola: 1.4 %; and on a node nothing.
  const RunResult parabola = result_of<1>(beam(65, "-0.00390625 - (x - 0.5)^2"));
  EXPECT_TRUE(parabola.unseen_details.empty());
  EXPECT_GT(relative_estimate(parabola), 0.014);
  EXPECT_LT(relative_estimate(parabola), 0.1);
  EXPECT_LT(relative_estimate(result_of<1>(beam(64, "-0.00390625 - abs(x - 0.5)"))), 0.001);
}

TEST(UnseenDetail, a_load_counts_by_its_extent)
{
  // Six times the load elsewhere, in a hundredth of a cell: 6.6 % of the energy norm.
  const RunResult peak =
    result_of<1>(string_on(2, "model.load = \"-1 - 5*exp(-((x - 0.44)/0.005)^2)\"\nmodel.element = \"P3\"\nconstraint.lower = -10"));
  expect_found(peak, "load");
  EXPECT_GT(relative_estimate(peak), 0.05);
  // Far less than the error, which is 0.2 there.
  EXPECT_TRUE(
    result_of<1>(string_on(2, "model.load = \"-1 - 2*exp(-((x - 0.44)/0.0005)^2)\"\nconstraint.lower = -10")).unseen_details.empty());
}

TEST(UnseenDetail, a_tooth_of_the_gap)
{
  const std::string body =
    "mesh.box = [[0, 0], [1, 1]]\nmesh.cells = 8\nmodel.kind = \"elasticity\"\nmodel.young = 1\nmodel.poisson = 0.3\n"
    "boundary.top = [0, -0.01]\nconstraint.on = \"bottom\"\n";
  expect_found(result_of<2>(body + "constraint.gap = \"0.02 - max(0, 0.018 - 5*abs(x - 0.42))\"\n"), "gap");
  EXPECT_TRUE(result_of<2>(body + "constraint.gap = \"0.02 - max(0, 0.005 - 5*abs(x - 0.42))\"\n").unseen_details.empty());
  // A body that slides beside it; and one that the rule has a point on.
  const std::string sliding = "mesh.box = [[0, 0], [1, 1]]\nmesh.cells = 8\nmodel.kind = \"elasticity\"\nmodel.young = 1\n"
                              "model.poisson = 0.3\nboundary.top = [0.5, 0]\nconstraint.on = \"bottom\"\n";
  EXPECT_TRUE(result_of<2>(sliding + "constraint.gap = \"0.3 - max(0, 0.1 - 5*abs(x - 0.42))\"\n").unseen_details.empty());
  EXPECT_TRUE(
    result_of<2>(body + "model.element = \"Q2\"\nconstraint.gap = \"0.02 - 0.018*exp(-((x - 0.0625)/0.01)^2)\"\n").unseen_details.empty());
}

TEST(UnseenDetail, is_not_seen_where_there_is_none)
{
  // Jumps along sides of cells, slanted ones too, kinks, steep slopes that points see, oscillations, poles outside.
  for (const std::string &data :
       {"model.load = \"if(x < 0.5, 1, -3)*sin(9*y)\"", "model.stiffness = \"if(x < 0.25, 1, 100)\"\nmodel.load = 1",
        "model.load = \"sqrt(x^2 + y^2)\"", "model.load = \"1/(0.05 + hypot(x - 0.5, y - 0.5))\"", "model.load = \"exp(-30*x)*cos(20*y)\"",
        "model.load = \"-8\"\nconstraint.lower = \"-0.1 - abs(x - 0.4)*0.3 + 0.05*cos(5*x*y)\""})
    for (const std::string &element : {"Q1", "P1", "Q2"})
    {
      const RunResult result = result_of<2>(membrane_on(8, "model.element = \"" + element + "\"\n" + data));
      EXPECT_TRUE(result.unseen_details.empty())
        << data << ' ' << element << ": " << result.unseen_details[0].what << ' ' << result.unseen_details[0].x << ' '
        << result.unseen_details[0].value << " beside " << result.unseen_details[0].least << ' ' << result.unseen_details[0].most;
    }
  EXPECT_TRUE(
    result_of<2>(membrane_on(8, "model.element = \"P1\"\nmodel.load = 1\nmodel.stiffness = \"if(x < y, 1, 50)\"")).unseen_details.empty());
}

TEST(UnseenDetail, a_pole_is_not_refined_without_end)
{
  const RunResult adapted =
    result_of<2>(membrane_on(8, "model.load = \"-hypot(x - 0.33, y - 0.61)^(-0.5)\"\nmesh.adapt = { tolerance = 0.05 }"));
  EXPECT_TRUE(adapted.estimate->tolerance_met);
  EXPECT_LE(adapted.estimate->cycles.size(), 15u);
}

TEST(UnseenDetail, adaptive_refinement_goes_there_first)
{
  const RunResult result = result_of<1>(string_on(10, "model.load = -1\nmodel.element = \"P2\"\nmesh.adapt = { tolerance = 0.01 }\n"
                                                      "model.stiffness = \"if(x>0.371 && x<0.372, 1e-3, 1)\""));
  EXPECT_TRUE(result.unseen_details.empty());
  EXPECT_GT(result.estimate->cycles.size(), 2u);
  // The flux is -x - C, C = -int x/k / int 1/k.
  EXPECT_NEAR(result.energy_norm, 0.30263, 0.0031);
}

TEST(UnseenDetail, what_the_penalty_leaves_at_a_point_in_contact_is_no_crossing)
{
  // A free string that rests on its right end alone, where the bound is steep: u is below it there by the penalty, and near it as well.
  const auto result = result_of<1>("[mesh]\nbox = [[0], [1]]\ncells = 200\n[model]\nkind = \"membrane\"\nelement = \"P2\"\n"
                                   "load = \"-1 + 3*sin(6*x)\"\n[boundary]\nall = \"free\"\n[constraint]\nlower = \"(x - 0.3)^2\"\n");
  EXPECT_TRUE(result.converged) << result.reason;
  EXPECT_TRUE(result.sees_all_data);
  EXPECT_TRUE(result.unseen_details.empty());
}
