// The bound of the total error of elastic bodies is never below the error, close to it, exact where u_h is, and not claimed without reason.
#include "random_elastic_bodies.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

using namespace unilateral;

TEST(BodyError, is_never_below_the_error_of_random_bodies)
{
  std::mt19937        random(1983);
  std::vector<double> effectivities;
  for (unsigned trial = 0; trial < 16; ++trial)
  {
    const std::string       element = std::vector<std::string>{"Q1", "P1", "Q2", "P2"}[trial % 4];
    const RandomElasticBody body(random, element, trial % 8 == 0 ? "[[mesh.local]]\nwhere = \"x < 0.4 && y < 0.3\"\n" : "");
    const RunResult         result = result_of<2>(body.text);
    ASSERT_TRUE(result.converged) << body.text;
    ASSERT_TRUE(result.estimate->guaranteed) << result.estimate->reason << "\n" << body.text;
    EXPECT_GE(*result.estimate->effectivity, 1) << body.text;
    effectivities.push_back(*result.estimate->effectivity);
    if (std::getenv("UNILATERAL_SHOW"))
      fmt::print("{} {}\n{}\n", element, effectivities.back(), body.text);
  }
  std::sort(effectivities.begin(), effectivities.end());
  EXPECT_LT(effectivities[effectivities.size() / 2], 1.5);
  EXPECT_LT(effectivities.back(), 3);
}

TEST(BodyError, vanishes_where_the_displacement_is_exact)
{
  // Constant stress, held by contact and a plane of symmetry; rigid body modes stay.
  for (const char *const element : {"Q1", "P1", "Q2", "P2", "P3", "Q3"})
  {
    const auto result = result_of<2>(fmt::format(
      "[mesh]\nbox = [[0, 0], [2, 1]]\ncells = [3, 2]\n[model]\nkind = \"elasticity\"\nelement = \"{}\"\nyoung = 1000\npoisson = 0.3\n"
      "[boundary]\ntop = {{ pressure = 10 }}\n[constraint]\non = \"bottom\"\ngap = 0.1\n",
      element));
    ASSERT_TRUE(result.estimate->guaranteed) << result.estimate->reason << element;
    EXPECT_LT(result.estimate->total, 1e-5 * result.energy_norm) << element;
  }
}

/// A block on a floor under an eccentric force: the stress is linear, and Q2 has the displacement.
TEST(BodyError, knows_loads_by_moments)
{
  const auto result = result_of<2>("[mesh]\nbox = [[0, 0], [2, 1]]\ncells = [4, 2]\n[model]\nkind = \"elasticity\"\nelement = \"Q2\"\n"
                                   "young = 1000\npoisson = 0\n[boundary]\ntop = { force = [0, -20], moment = -2 }\n[constraint]\n"
                                   "on = \"bottom\"\ngap = 0\n");
  ASSERT_TRUE(result.estimate->guaranteed) << result.estimate->reason;
  const auto fine =
    result_of<2>("[mesh]\nbox = [[0, 0], [2, 1]]\ncells = [4, 2]\nrefine = 3\n[model]\nkind = \"elasticity\"\nelement = \"Q3\"\n"
                 "young = 1000\npoisson = 0\n[boundary]\ntop = { force = [0, -20], moment = -2 }\n[constraint]\n"
                 "on = \"bottom\"\ngap = 0\n");
  // |u - u_h|^2 <= 2 (J(u_h) - J(u)), for u_h in K.
  EXPECT_GE(std::pow(result.estimate->total, 2), 2 * (result.energy - fine.energy) * (1 - 1e-6) - 1e-12);
  EXPECT_LT(result.estimate->total, 0.3 * result.energy_norm);
}

TEST(BodyError, is_not_claimed_where_parts_are_coupled_or_planes_are_inclined)
{
  const std::string block = "[mesh]\nbox = [[0, 0], [2, 1]]\ncells = [4, 2]\n[model]\nkind = \"elasticity\"\nyoung = 1000\npoisson = 0.3\n";
  for (const char *const rest :
       {"[boundary]\ntop = { rigid = true, force = [0, -20] }\n[constraint]\non = \"bottom\"\ngap = 0\n",
        "[boundary]\ntop = { pressure = 10 }\n[[periodic]]\nparts = [\"left\", \"right\"]\n[constraint]\non = \"bottom\"\ngap = 0\n",
        "[boundary]\ntop = [0, -0.1]\n[constraint]\non = \"bottom\"\ngap = { plane = { point = [0, 0], normal = [-0.1, 1] } }\n"})
  {
    const auto result = result_of<2>(block + rest);
    ASSERT_TRUE(result.converged) << rest << result.reason;
    EXPECT_FALSE(result.estimate->guaranteed) << rest;
    EXPECT_FALSE(result.estimate->reason.empty()) << rest;
  }
}

TEST(BodyError, in_space)
{
  // Normal strains linear in x, y, z, no shear: the load is constant, the pressure on y = 0 linear.
  for (const char *const element : {"Q1", "P1", "P2"})
  {
    const auto result = result_of<3>(fmt::format(
      "[parameters]\nlam = 1.5\nmu = 1\nexx = \"0.2*x + 0.1\"\neyy = \"-0.3*y - 0.4\"\nezz = \"0.1*z\"\ntr = \"exx + eyy + ezz\"\n"
      "[mesh]\nbox = [[0, 0, 0], [1, 1, 1]]\ncells = 2\nrefine = {}\n[model]\nkind = \"elasticity\"\nelement = \"{}\"\n"
      "young = 2.6\npoisson = 0.3\nload = [\"-0.2*(lam + 2*mu)\", \"0.3*(lam + 2*mu)\", \"-0.1*(lam + 2*mu)\"]\n[boundary]\n"
      "left = \"symmetry\"\nfront = \"symmetry\"\nright = {{ traction = [\"lam*tr + 2*mu*exx\", 0, 0] }}\n"
      "back = {{ traction = [0, 0, \"lam*tr + 2*mu*ezz\"] }}\ntop = {{ traction = [0, \"lam*tr + 2*mu*eyy\", 0] }}\n"
      "[constraint]\non = \"bottom\"\ngap = 0\n[exact]\nu = [\"0.1*x^2 + 0.1*x\", \"-0.15*y^2 - 0.4*y\", \"0.05*z^2\"]\n",
      element[1] == '1' ? 1 : 0, element));
    ASSERT_TRUE(result.estimate->guaranteed) << result.estimate->reason << element;
    if (std::getenv("UNILATERAL_SHOW"))
      fmt::print("{} {}\n", element, *result.estimate->effectivity);
    // The rule `edges` of P2 does not take the linear pressure as it is.
    EXPECT_GE(*result.estimate->effectivity, 1) << element;
    EXPECT_LT(*result.estimate->effectivity, 3) << element;
  }
}

namespace
{
  /// The bound of a coarse mesh against the energy of a much finer one: ||u - u_h||^2 is at most 2 (J(u_h) - J(u)).
  void expect_bound_beside_energy(const std::string &text, const double energy)
  {
    const auto result = result_of<2>(text);
    ASSERT_TRUE(result.estimate->guaranteed) << result.estimate->reason << text;
    const double error = std::sqrt(std::max(0., 2 * (result.energy - energy)));
    if (std::getenv("UNILATERAL_SHOW"))
      fmt::print("{}\nbound {} energy error {}\n", text, result.estimate->total, error);
    EXPECT_LT(result.estimate->total, 4 * error) << text;
    EXPECT_GT(result.estimate->total, 0.3 * error) << text;
  }
} // namespace

TEST(BodyError, of_several_materials_on_springs)
{
  const auto text = [](const unsigned refine, const std::string &element)
  {
    return fmt::format(
      "[mesh]\nbox = [[0, 0], [2, 1]]\ncells = [4, 2]\nrefine = {}\n[model]\nkind = \"elasticity\"\nelement = \"{}\"\n"
      "young = \"if(x < 1, 100, 300)\"\npoisson = 0.3\n[boundary]\nleft = {{ spring = [50, 20] }}\n"
      "top = {{ traction = [\"1 - x\", \"-2*x*(2 - x)\"] }}\n[constraint]\non = \"bottom\"\ngap = \"0.01 + 0.01*(x - 1)^2\"\n",
      refine, element);
  };
  const double energy = result_of<2>(text(4, "Q2")).energy;
  for (const char *const element : {"Q1", "P1", "Q2"})
    expect_bound_beside_energy(text(1, element), energy);
}

TEST(BodyError, of_bodies_that_soft_springs_hold)
{
  // In the direction of the springs the residual of the solver is a displacement of many times the body's strain, but a force of nothing.
  const auto plane = [](const unsigned refine, const std::string &element)
  {
    return fmt::format("[mesh]\nbox = [[0, 0], [2, 1]]\ncells = [8, 4]\nrefine = {}\n[model]\nkind = \"elasticity\"\nelement = \"{}\"\n"
                       "young = 1000\npoisson = 0.3\nload = [0, -1]\n[boundary]\nleft = {{ spring = 1e-3 }}\nright = {{ spring = 1e-3 }}\n"
                       "top = {{ traction = [\"0.1*(x - 1)\", -0.3] }}\n[constraint]\non = \"bottom\"\ngap = \"0.01 + 0.01*x\"\n",
                       refine, element);
  };
  const double energy = result_of<2>(plane(3, "Q2")).energy;
  for (const char *const element : {"Q1", "P2", "Q2"})
    expect_bound_beside_energy(plane(0, element), energy);
  const auto solid =
    result_of<3>("[mesh]\nbox = [[0, 0, 0], [2, 1, 1]]\ncells = [4, 2, 2]\n[model]\nkind = \"elasticity\"\nelement = \"P2\"\nyoung = 1000\n"
                 "poisson = 0.3\nload = [0, 0, -1]\n[boundary]\nleft = { spring = 1e-3 }\nright = { spring = [1e-3, 1, 2] }\n"
                 "back = { traction = [0.1, 0, -0.3] }\n[constraint]\non = \"front\"\ngap = \"0.01 + 0.01*x\"\n");
  EXPECT_TRUE(solid.estimate->guaranteed) << solid.estimate->reason;
}

TEST(BodyError, is_not_claimed_where_its_hypotheses_do_not_hold)
{
  const auto reason = [](const std::string &mesh, const std::string &model, const std::string &constraint = "gap = 0")
  {
    const auto result = result_of<2>("[mesh]\n" + mesh + "\n[model]\nkind = \"elasticity\"\nyoung = 1\n" + model +
                                     "\n[boundary]\ntop = [0, -0.01]\n[constraint]\non = \"bottom\"\n" + constraint + "\n");
    EXPECT_FALSE(result.estimate->guaranteed);
    EXPECT_GT(result.estimate->total, 0);
    return result.estimate->reason;
  };
  const std::string box = "box = [[0, 0], [1, 1]]\ncells = 4";
  EXPECT_NE(reason(box, "poisson = 0.3\nassumption = \"axisymmetric\"").find("revolution"), std::string::npos);
  EXPECT_NE(reason(box, "poisson = 0.4999\nelement = \"Q1\"").find("reduced"), std::string::npos);
  EXPECT_NE(reason(box, "poisson = 0.3", "gap = \"0.1*x\"\ndirection = [0.6, -0.8]").find("direction"), std::string::npos);
  // Steps of an obstacle, inside a face and between two.
  for (const char *const edge : {"0.4", "0.5"})
    EXPECT_NE(reason(box, "poisson = 0.3", fmt::format("gap = \"if(x > {}, 0, 0.005)\"", edge)).find("jumps"), std::string::npos) << edge;
}
