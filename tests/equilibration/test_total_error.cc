// The bound of the total error is never below the error, close to it, and not claimed where its hypotheses do not hold.
#include "solved_case.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace unilateral;

namespace
{
  /// u = w + (phi+)^2 over the obstacle w: any contact set {phi <= 0}, any pressure there.
  struct RandomProblem
  {
    std::string parameters, laplacian_u;
  };

  RandomProblem random_problem(std::mt19937 &random, const unsigned dim)
  {
    std::uniform_real_distribution<> any(-1, 1), positive(0.3, 2);
    const double      a = 2 * any(random), b = 3 * any(random), c = 2 * positive(random), d = 2 * positive(random), e = 0.5 * any(random);
    const std::string y = dim > 1 ? "y" : "0";
    RandomProblem     problem;
    // phi = e + sin(c x + a) + cos(d y + b), w = a x^2 + b x y + sin(y)
    problem.parameters = fmt::format("[parameters]\nphi = \"{0} + sin({1}*x + {2}) + cos({3}*{5} + {4})\"\n"
                                     "phix = \"{1}*cos({1}*x + {2})\"\nphiy = \"{6}*sin({3}*{5} + {4})\"\n"
                                     "lap = \"-{1}^2*sin({1}*x + {2}) - {7}*cos({3}*{5} + {4})\"\n"
                                     "w = \"{2}*x^2 + {4}*x*{5} + sin({5})\"\nlapw = \"2*{2} - sin({5})\"\n"
                                     "exact = \"w + max(phi, 0)^2\"\npressure = \"{8}*(1 + x^2)\"\n",
                                     e, c, a, d, b, y, dim > 1 ? -d : 0., dim > 1 ? d * d : 0., positive(random));
    if (dim == 1)
      problem.parameters.replace(problem.parameters.find("lapw = "), 7, "lapw_2 = "),
        problem.parameters += fmt::format("lapw = {}\n", 2 * a);
    problem.laplacian_u = "lapw + if(phi > 0, 2*(phix^2 + phiy^2) + 2*phi*lap, 0)";
    return problem;
  }
} // namespace

TEST(TotalError, is_never_below_the_error_of_random_membranes)
{
  std::mt19937        random(1980);
  std::vector<double> effectivities;
  for (unsigned trial = 0; trial < 60; ++trial)
  {
    const unsigned    dim = trial % 3 == 0 ? 1 : 2;
    const auto        problem = random_problem(random, dim);
    const char *const elements[] = {"Q1", "P1", "Q2", "Q1", "P2", "Q3"};
    const double      k = trial % 4 == 0 ? 7.5 : 1, reaction = trial % 5 == 0 ? 3 : 0;
    const std::string text =
      problem.parameters +
      fmt::format(
        "[mesh]\nbox = {}\ncells = {}\nrefine = 2\n[model]\nkind = \"membrane\"\nelement = \"{}\"\nstiffness = {}\nreaction = {}\n"
        "load = \"-{}*({}) + {}*exact - if(phi > 0, 0, pressure)\"\n[boundary]\nall = \"exact\"\n[constraint]\nlower = \"w\"\n{}"
        "[exact]\nu = \"exact\"\n",
        dim == 1 ? "[[-1], [1]]" : "[[-1, -1], [1, 1]]", dim == 1 ? 8 : 4, dim == 1 ? "P1" : elements[trial % 6], k, reaction, k,
        problem.laplacian_u, reaction, trial % 7 == 0 ? "[[mesh.local]]\nwhere = \"x < 0\"\n" : "");
    const RunResult result = dim == 1 ? result_of<1>(text) : result_of<2>(text);
    ASSERT_TRUE(result.converged) << text;
    ASSERT_TRUE(result.estimate->guaranteed) << result.estimate->reason << "\n" << text;
    EXPECT_GE(*result.estimate->effectivity, 1) << text;
    effectivities.push_back(*result.estimate->effectivity);
  }
  std::sort(effectivities.begin(), effectivities.end());
  EXPECT_LT(effectivities[effectivities.size() / 2], 2.5);
  EXPECT_LT(effectivities.back(), 12);
}

TEST(TotalError, tends_to_the_error_where_the_mesh_is_fine)
{
  const std::string text =
    "[parameters]\na = 0.7\nr2 = \"x^2 + y^2\"\n[mesh]\nbox = [[-1, -1], [1, 1]]\ncells = 8\nrefine = 3\n"
    "[model]\nkind = \"membrane\"\nelement = \"Q1\"\nload = \"if(r2 > a^2, -(8*(r2 - a^2) + 8*r2), -8*a^2*(1 - r2 + a^2))\"\n"
    "[boundary]\nall = \"max(r2 - a^2, 0)^2\"\n[constraint]\nlower = 0\n[exact]\nu = \"max(r2 - a^2, 0)^2\"\n";
  const auto result = result_of<2>(text);
  EXPECT_GE(*result.estimate->effectivity, 1);
  EXPECT_LT(*result.estimate->effectivity, 1.03);
}

TEST(TotalError, with_fluxes_in_space)
{
  // u = (z - 0.45)+^2 (1 + x), held at z = 0, by its flux elsewhere.
  for (const auto &[element, refine] : {std::pair("Q1", 1), std::pair("P1", 1), std::pair("Q2", 0)})
  {
    const auto result = result_of<3>(fmt::format(
      "[parameters]\nt = \"max(z - 0.45, 0)\"\n[mesh]\nbox = [[0, 0, 0], [1, 1, 1]]\ncells = 3\nrefine = {}\n[model]\nkind = "
      "\"membrane\"\nelement = \"{}\"\nload = \"if(z > 0.45, -2*(1 + x), -1)\"\n[boundary]\nfront = 0\nback = {{ flux = \"2*t*(1 + x)\" "
      "}}\n"
      "left = {{ flux = \"-t^2\" }}\nright = {{ flux = \"t^2\" }}\nall = \"free\"\n[constraint]\nlower = 0\n[exact]\nu = \"t^2*(1 + x)\"\n",
      refine, element));
    ASSERT_TRUE(result.estimate->guaranteed) << result.estimate->reason << element;
    EXPECT_GE(*result.estimate->effectivity, 1) << element;
    EXPECT_LT(*result.estimate->effectivity, 5) << element;
  }
}

TEST(TotalError, where_the_trace_is_bounded)
{
  // u = Re z^(3/2): contact for x < 0.
  for (const char *const element : {"Q1", "P1", "Q2"})
  {
    const auto result = result_of<2>(fmt::format(
      "[parameters]\nw = \"hypot(x, y)^1.5*cos(1.5*atan2(y, x))\"\n[mesh]\nbox = [[-1, 0], [1, 1]]\ncells = [8, 4]\nrefine = 2\n[model]\n"
      "kind = \"membrane\"\nelement = \"{}\"\n[boundary]\nbottom = \"free\"\nall = \"w\"\n[constraint]\non = \"bottom\"\nlower = 0\n"
      "[exact]\nu = \"w\"\n",
      element));
    ASSERT_TRUE(result.estimate->guaranteed) << result.estimate->reason;
    EXPECT_GE(*result.estimate->effectivity, 1) << element;
    // The nodal pressure of degree 2 is rough next to the end of the contact, where the exact one has a root.
    EXPECT_LT(*result.estimate->effectivity, element[1] == '1' ? 3 : 30) << element;
  }
}

TEST(TotalError, sees_what_a_bound_does_inside_cells)
{
  // The load presses the string onto the bound from end to end: u is the bound, whose waves are shorter than the cells.
  for (const unsigned waves : {32, 50, 64, 100})
  {
    const double k = 2 * std::numbers::pi * waves;
    Diagnostics  diagnostics;
    Progress     quiet;
    const auto   solution = solve<1>(problem_of(case_of(fmt::format("[mesh]\nbox = [[0], [1]]\ncells = 10\n[model]\nkind = \"membrane\"\n"
                                                                      "element = \"Q2\"\nload = -{0}\n[boundary]\nall = 0\n[constraint]\n"
                                                                      "lower = \"10*x*(1 - x) + sin({1}*x)/200\"\n",
                                                                    k * k, k))),
                                   diagnostics, quiet);
    std::map<double, double> u;
    for (const auto &node : solution.problem->space.nodal_values())
      u[node.x[0]] = solution.displacement(node.dof);
    ASSERT_EQ(u.size(), 21u);
    std::vector<double> nodal;
    for (const auto &[x, value] : u)
      nodal.push_back(value);
    double             error_squared = 0;
    constexpr unsigned n = 2000; // points a cell
    for (unsigned cell = 0; cell < 10; ++cell)
      for (unsigned i = 0; i < n; ++i)
      {
        const double t = (i + 0.5) / n, x = (cell + t) / 10;
        const double slope = 10 * (nodal[2 * cell] * (4 * t - 3) + nodal[2 * cell + 1] * (4 - 8 * t) + nodal[2 * cell + 2] * (4 * t - 1));
        error_squared += std::pow(10 - 20 * x + k / 200 * std::cos(k * x) - slope, 2) / (10. * n);
      }
    EXPECT_TRUE(solution.result.estimate->guaranteed);
    EXPECT_GE(solution.result.estimate->total, std::sqrt(error_squared)) << waves;
    EXPECT_GT(error_squared, 0.1);
  }
}

/// An obstacle with a slope touches the free side x = -1: the contact bears a force along it, which polynomials that are cut off at zero
/// would make larger by a quarter, on any mesh.
TEST(TotalError, a_force_along_a_free_side_keeps_its_size)
{
  for (const char *const element : {"Q2", "Q3", "P2"})
  {
    double bound[2] = {};
    for (const unsigned i : {0, 1})
    {
      const auto result = result_of<2>(
        fmt::format("[mesh]\nbox = [[-1, 0], [1, 1]]\ncells = [{}, {}]\n[model]\nkind = \"membrane\"\nelement = \"{}\"\nload = -1\n"
                    "[boundary]\nright = 0\n[constraint]\nlower = \"-0.8 - x\"\n",
                    8 << 2 * i, 4 << 2 * i, element));
      EXPECT_TRUE(result.estimate->guaranteed);
      bound[i] = result.estimate->total / result.energy_norm;
    }
    EXPECT_LT(bound[1], 0.6 * bound[0]) << element; // the order is 1/2
    EXPECT_LT(bound[1], 0.15) << element;
  }
}

TEST(TotalError, parts_add_up_and_a_large_epsilon_shows)
{
  const std::string text = "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 8\n[model]\nkind = \"membrane\"\nload = -8\n[boundary]\nall = 0\n"
                           "[constraint]\nlower = -0.2\n[method]\nepsilon = ";
  const auto        small = result_of<2>(text + "1e-8\n"), large = result_of<2>(text + "0.1\n");
  for (const RunResult &result : {small, large})
    EXPECT_NEAR(result.estimate->total, result.estimate->discretisation + result.estimate->penalty + result.estimate->algebraic,
                1e-12 * result.estimate->total);
  EXPECT_LT(small.estimate->penalty, 1e-4 * small.estimate->total);
  EXPECT_GT(large.estimate->total, large.certificate->penalty_error_bound / 2);
  EXPECT_GT(large.estimate->total, small.estimate->total);
}

TEST(TotalError, is_not_claimed_of_data_that_are_known_at_samples)
{
  const auto table = std::filesystem::temp_directory_path() / "unilateral_samples.csv";
  std::ofstream(table) << "0 1\n0.3 2\n1 1\n";
  const std::string samples = "{ profile = \"" + table.string() + "\" }";
  // As they are, and in an expression.
  for (const auto &[key, value] : {std::pair("load", samples), std::pair("load", std::string("\"2*p\"")),
                                   std::pair("stiffness", std::string("\"2*p\"")), std::pair("load", std::string("1"))})
  {
    const auto result =
      result_of<1>(fmt::format("[parameters]\np = {}\n[mesh]\nbox = [[0], [1]]\ncells = 8\n[model]\nkind = \"membrane\"\n{} = {}\n"
                               "[boundary]\nall = 0\n[constraint]\nupper = 0.05\n",
                               samples, key, value));
    EXPECT_EQ(result.estimate->guaranteed, value == "1") << key << " = " << value;
  }
  std::filesystem::remove(table);
}

TEST(TotalError, is_not_claimed_where_its_hypotheses_do_not_hold)
{
  const auto reason = [](const std::string &mesh, const std::string &model, const std::string &boundary = "all = 0")
  {
    const auto result = result_of<2>("[mesh]\n" + mesh + "\n[model]\nkind = \"membrane\"\nload = 1\n" + model + "\n[boundary]\n" +
                                     boundary + "\n[constraint]\nupper = 0.05\n");
    EXPECT_FALSE(result.estimate->guaranteed);
    EXPECT_GT(result.estimate->total, 0);
    return result.estimate->reason;
  };
  const std::string box = "box = [[0, 0], [1, 1]]\ncells = 4";
  // In the middle of cells, and between them.
  for (const char *const place : {"0.4", "0.5"})
  {
    const auto result =
      result_of<2>("[mesh]\n" + box + "\n[model]\nkind = \"membrane\"\nload = -20\n[boundary]\nall = 0\n[constraint]\nlower = \"if(x < " +
                   place + ", -0.2, -0.1)\"\n");
    EXPECT_NE(result.estimate->reason.find("jumps"), std::string::npos) << place;
  }
  EXPECT_NE(reason("ball = { center = [0, 0], radius = 1 }\nrefine = 1", "").find("curved"), std::string::npos);
  EXPECT_NE(reason(box, "velocity = [1, 0]").find("velocity"), std::string::npos);
  EXPECT_NE(reason(box, "reaction = 1", "all = \"free\"").find("prescribed"), std::string::npos);
}

TEST(TotalError, sees_an_obstacle_between_the_points)
{
  // The tangents from both ends to a parabola that no node feels.
  const auto result = result_of<1>(
    "[mesh]\nbox = [[-1], [1]]\ncells = 2\n[model]\nkind = \"membrane\"\nelement = \"P1\"\nload = 0\n[boundary]\nall = 0\n[constraint]\n"
    "lower = \"0.01 - (x-0.5)^2/2\"\n[exact]\nu = \"if(x<0.4933184523068078, (0.01-(0.4933184523068078-0.5)^2/2)*(x+1)/1.4933184523068078, "
    "if(x>0.520416847668728, (0.01-(0.520416847668728-0.5)^2/2)*(1-x)/(1-0.520416847668728), 0.01-(x-0.5)^2/2))\"\n");
  ASSERT_TRUE(result.estimate->guaranteed) << result.estimate->reason;
  EXPECT_GE(result.estimate->total, result.errors->energy);
  EXPECT_GT(result.errors->energy, 0.013);
}

TEST(TotalError, is_not_claimed_where_prescribed_values_jump)
{
  const std::string box = "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 4\n[model]\n", membrane = box + "kind = \"membrane\"\nload = 1\n",
                    body = box + "kind = \"elasticity\"\nyoung = 1\npoisson = 0.3\n", lower = "[constraint]\nlower = -5\n",
                    bottom = "[constraint]\non = \"bottom\"\ngap = 1\n";
  for (const std::string &text :
       {membrane + "[boundary]\nleft = 0\nbottom = 1\n" + lower, membrane + "[boundary]\ntop = \"if(x>0.3, 1, 0)\"\nall = 0\n" + lower,
        body + "[boundary]\nleft = \"clamped\"\ntop = [\"if(x>0.55, 0.01, 0)\", 0]\n" + bottom})
  {
    const auto result = result_of<2>(text);
    EXPECT_FALSE(result.estimate->guaranteed) << text;
    EXPECT_NE(result.estimate->reason.find("jump"), std::string::npos) << result.estimate->reason << text;
  }
  for (const std::string &text :
       {membrane + "[boundary]\nleft = \"y\"\nbottom = \"sin(3*x)\"\n" + lower, membrane + "[boundary]\nall = \"max(x, y)^4\"\n" + lower,
        body + "[boundary]\nleft = \"clamped\"\ntop = [\"0.01*x\", 0]\n" + bottom})
  {
    const auto result = result_of<2>(text);
    EXPECT_TRUE(result.estimate->guaranteed) << result.estimate->reason << text;
  }
}

TEST(TotalError, a_clamped_edge_beside_contact_need_not_move)
{
  // Where vertices hang all faces in contact move off the obstacle by what the worst needs, next to the clamped side as well.
  const auto result = result_of<3>(
    "[mesh]\nbox = [[0, 0, 0], [2, 1, 1]]\ncells = [4, 2, 2]\nadapt = { tolerance = 0.05, max_unknowns = 5000 }\n[model]\n"
    "kind = \"elasticity\"\nelement = \"Q2\"\nyoung = 1000\npoisson = 0.3\n[boundary]\nback = { pressure = \"if(x<0.5, 1, 0)\" }\n"
    "left = \"clamped\"\n[constraint]\non = \"front\"\ngap = \"0.0001 + 0.001*(x-1)^2\"\n");
  for (const auto &cycle : result.estimate->cycles)
    EXPECT_TRUE(cycle.guaranteed) << cycle.n_dofs << result.estimate->reason;
  EXPECT_EQ(result.estimate->cycles.size(), 3u);
}

TEST(TotalError, is_not_claimed_where_the_load_is_not_resolved)
{
  const std::string string = "[mesh]\nbox = [[0], [1]]\ncells = 9\n[model]\nkind = \"membrane\"\nelement = \"Q1\"\n";
  // A peak between points, a pole without a square, a stiffness that ends at the boundary.
  for (const std::string &text : {string + "load = \"exp(-((x - 0.287)/0.0003)^2)/0.0003\"\n[boundary]\nall = 0\n",
                                  string + "load = \"abs(x - 0.3333)^(-0.9)\"\n[boundary]\nall = 0\n",
                                  string + "stiffness = \"x^0.9\"\nload = 1\n[boundary]\nall = 0\n"})
  {
    const auto result = result_of<1>(text);
    EXPECT_FALSE(result.estimate->guaranteed) << text;
    EXPECT_TRUE(std::any_of(result.warnings.begin(), result.warnings.end(),
                            [](const Diagnostic &warning) { return warning.name.text == "detail-unseen"; }))
      << text;
  }
  // Jumps, kinks and oscillations that a few cells resolve are no such loads.
  for (const std::string load : {"if(x > 0.37, 10, -3)", "abs(x - 0.41)", "sin(40*x)", "abs(x - 0.3333)^0.3"})
    EXPECT_TRUE(result_of<1>(string + "load = \"" + load + "\"\n[boundary]\nall = 0\n").estimate->guaranteed) << load;
}
