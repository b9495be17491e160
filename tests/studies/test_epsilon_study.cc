// Theorems 1 to 3 as inequalities between computed numbers, on problems with known answers.
#include "small_problem.h"

#include "unilateral/case/problem_of_case.h"
#include "unilateral/inequality/increment_problem.h"
#include "unilateral/stability/form_constants.h"
#include "unilateral/stability/multiplier_pairing.h"
#include "unilateral/studies/epsilon_study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace unilateral;

namespace
{
  template <int dim>
  EpsilonStudy study(const std::string &text, const std::vector<double> &values = {})
  {
    Diagnostics diagnostics;
    Progress    quiet;
    return study_epsilon<dim>(problem_of(case_of(text)), {values}, diagnostics, quiet);
  }

  std::string string_under_ceiling(const unsigned cells, const std::string &element, const std::string &rule)
  {
    return fmt::format(
      "[mesh]\nbox = [[0], [1]]\ncells = {}\n[model]\nkind = \"membrane\"\nelement = \"{}\"\nload = 1\n[boundary]\nall = 0\n"
      "[constraint]\nupper = \"1/18\"\nquadrature = \"{}\"\n",
      cells, element, rule);
  }

  const std::string string_over_parabola = "[mesh]\nbox = [[-1], [1]]\ncells = 40\n[model]\nkind = \"membrane\"\n[boundary]\nall = 0\n"
                                           "[constraint]\nlower = \"0.5 - 2*x^2\"\n";
  const std::string disc_under_ceiling =
    "[mesh]\nball = { center = [0, 0], radius = 1 }\nrefine = 2\n[model]\nkind = \"membrane\"\nload = 1\n"
    "[boundary]\nall = 0\n[constraint]\nupper = 0.1008566024300068\n";
  const std::string smooth_contact =
    "[parameters]\nr2 = \"x^2+y^2\"\n[mesh]\nbox = [[-1, -1], [1, 1]]\ncells = 12\n[model]\nkind = \"membrane\"\n"
    "load = \"if(r2 > 0.49, -(8*(r2-0.49)+8*r2), -8*0.49*(1.49-r2))\"\n[boundary]\nall = \"(max(r2-0.49,0))^2\"\n[constraint]\nlower = 0\n";

  void expect_bounds(const EpsilonStudy &result, const bool sharp_gap = true)
  {
    ASSERT_EQ(result.rows.size(), 10u);
    for (const auto &row : result.rows)
    {
      SCOPED_TRACE(row.epsilon);
      EXPECT_TRUE(row.converged);
      ASSERT_TRUE(row.bound_u_lbb_free);
      EXPECT_LE(row.u_error_V, *row.bound_u_lbb_free);
      EXPECT_LE(row.norm_p, result.reference.norm_p * (1 + 1e-9));
      EXPECT_LE(row.p_error_L2, result.reference.norm_p * (1 + 1e-9));
      if (row.bound_u_gap)
      {
        EXPECT_LE(row.u_error_energy, *row.bound_u_gap * (1 + 1e-9));
        if (sharp_gap)
        {
          EXPECT_LE(*row.bound_u_gap, 4 * row.u_error_energy);
        }
      }
      EXPECT_LE(row.penetration_L2, row.bound_penetration * (1 + 1e-6)); // equal in the limit
      EXPECT_LE(row.norm_u_V, *result.bound_norm_u);
    }
  }

  void expect_theorem3(const EpsilonStudy &result)
  {
    expect_bounds(result);
    EXPECT_GE(*result.constants.C_h_active, *result.constants.C_h * (1 - 1e-6));
    for (const auto &row : result.rows)
    {
      ASSERT_TRUE(row.bound_u && row.bound_p && row.bound_u_active && row.bound_p_active);
      EXPECT_LE(row.u_error_V, *row.bound_u_active);
      EXPECT_LE(row.p_error_L2, *row.bound_p_active);
      EXPECT_LE(*row.bound_u_active, *row.bound_u * (1 + 1e-6));
    }
    EXPECT_TRUE(*result.holds.theorem1_bounded && *result.holds.theorem2 && *result.holds.theorem3_u && *result.holds.theorem3_p);
    EXPECT_NEAR(*result.slope_u, 1, 0.02);
    EXPECT_NEAR(*result.slope_p, 1, 0.02);
  }
} // namespace

TEST(EpsilonStudy, theorem_3_on_stable_pairs)
{
  for (const auto &[element, rule] : {std::pair("Q1", "nodal"), {"Q2", "nodal"}, {"Q2", "midpoint"}, {"Q3", "gauss(2)"}})
  {
    SCOPED_TRACE(std::string(element) + " " + rule);
    expect_theorem3(study<1>(string_under_ceiling(32, element, rule)));
  }
  {
    SCOPED_TRACE("string over a parabola");
    const EpsilonStudy result = study<1>(string_over_parabola);
    expect_theorem3(result);
    EXPECT_FALSE(result.hypotheses.obstacle_in_V_h);
  }
  {
    SCOPED_TRACE("disc");
    expect_theorem3(study<2>(disc_under_ceiling));
  }
  {
    SCOPED_TRACE("smooth contact");
    expect_theorem3(study<2>(smooth_contact));
  }
}

// Without an inf-sup constant nothing of (22) is left, but the bounds that need none hold, and p_eps finds the smallest multiplier.
TEST(EpsilonStudy, rules_with_a_kernel)
{
  for (const auto &[element, rule] : {std::pair("Q1", "gauss(2)"), {"Q2", "gauss(3)"}})
  {
    SCOPED_TRACE(std::string(element) + " " + rule);
    const EpsilonStudy result = study<1>(string_under_ceiling(32, element, rule));
    EXPECT_EQ(*result.constants.C_h, 0);
    EXPECT_FALSE(*result.hypotheses.lbb);
    EXPECT_TRUE(result.hypotheses.exact_pairing);
    // With three points for two unknowns a cell some points of contact have next to no gap, and the pressure hesitates between them.
    expect_bounds(result, element != std::string("Q2"));
    EXPECT_FALSE(result.rows.front().bound_u);
    EXPECT_FALSE(result.holds.theorem3_u);
    EXPECT_TRUE(*result.holds.theorem2);
    EXPECT_NEAR(*result.slope_u, 1, 0.05);
    EXPECT_LT(result.rows.back().p_error_L2, 1e-5 * result.reference.norm_p);
    EXPECT_NEAR(result.rows.back().total_contact_force, 1. / 3, 2e-3);
  }
}

TEST(EpsilonStudy, without_contact_and_with_nothing_but_contact)
{
  const std::string  square = "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 6\n[model]\nkind = \"membrane\"\nload = 1\n[boundary]\nall = 0\n"
                              "[constraint]\nupper = ";
  const EpsilonStudy apart = study<2>(square + "10\n");
  EXPECT_TRUE(*apart.holds.theorem1_bounded && *apart.holds.theorem2);
  EXPECT_FALSE(apart.constants.C_h_active);
  const EpsilonStudy pressed = study<2>(square + "0\n");
  EXPECT_GT(pressed.rows.front().epsilon, 1e-4);
  EXPECT_TRUE(*pressed.holds.theorem1_bounded && *pressed.holds.theorem2 && *pressed.holds.theorem3_u && *pressed.holds.theorem3_p);
}

TEST(EpsilonStudy, a_limit_is_not_judged_from_one_epsilon)
{
  const EpsilonStudy result = study<1>(string_under_ceiling(16, "Q1", "nodal"), {1e-3, 1e-3});
  EXPECT_EQ(result.rows.size(), 1u);
  EXPECT_FALSE(result.holds.theorem2);
  EXPECT_FALSE(result.slope_u);
  EXPECT_TRUE(*result.holds.theorem3_u);
}

TEST(EpsilonStudy, round_off_breaks_no_theorem)
{
  const EpsilonStudy result =
    study<2>("[mesh]\nbox = [[-1, -1], [1, 0]]\ncells = [8, 4]\n[model]\nkind = \"elasticity\"\nyoung = 100\npoisson = 0.3\n"
             "assumption = \"plane strain\"\n[boundary]\n\"y-\" = { x = 0, y = 0 }\n\"x-\" = \"symmetry\"\n\"x+\" = \"symmetry\"\n"
             "[constraint]\non = \"y+\"\ngap = \"x^2/2 - 0.02\"\n",
             {1e-5, 1e-8, 1e-11, 1e-14});
  EXPECT_FALSE(result.rows.back().at_round_off);
  EXPECT_TRUE(*result.holds.theorem1_bounded && *result.holds.theorem2 && *result.holds.theorem3_u && *result.holds.theorem3_p);

  // Where contact is at one point the bound of the penetration is an equality.
  const EpsilonStudy at_a_point =
    study<2>("[mesh]\nbox = [[-1, -1], [1, 0]]\ncells = [8, 4]\n[model]\nkind = \"elasticity\"\nelement = \"Q1\"\nyoung = 100\n"
             "poisson = 0.3\n[boundary]\nbottom = [0, 0]\n[constraint]\non = \"top\"\ngap = \"(x + 0.5)^2/2 - 0.001\"\n",
             {1e-3, 1e-6, 1e-9, 1e-10, 1e-11, 1e-12});
  EXPECT_TRUE(*at_a_point.holds.theorem1_bounded);
  EXPECT_NEAR(at_a_point.rows[0].penetration_L2, at_a_point.rows[0].bound_penetration, 1e-9 * at_a_point.rows[0].bound_penetration);
}

// The pressure is not unique, and the last epsilon too small for a solve: what is left is measured against the right pressure.
TEST(EpsilonStudy, an_epsilon_beyond_round_off_spoils_no_other)
{
  const EpsilonStudy result = study<1>(string_under_ceiling(32, "Q1", "gauss(2)"), {1e-4, 1e-6, 1e-20});
  EXPECT_NEAR(result.reference.total_contact_force, 1. / 3, 2e-3);
  for (const auto &row : result.rows)
    if (row.epsilon > 1e-10)
    {
      EXPECT_TRUE(row.converged) << row.epsilon;
      EXPECT_LT(row.p_error_L2, 0.5 * result.reference.norm_p) << row.epsilon;
    }
}

TEST(EpsilonStudy, constants_of_the_form)
{
  // -u'' on (0, 1), P1 on n equal cells: the eigenvalues of (u', v') against (u, v) are known, those against (u', v') + (u, v) follow.
  const unsigned        n = 16;
  const SmallProblem<1> small(string_under_ceiling(n, "Q1", "nodal"));
  const FreeUnknowns    free(*small.problem);
  const Pairing         pairing =
    make_pairing(*small.problem, small.constraint_set, std::vector<bool>(small.constraint_set.size(), true), PairingKind::by_rule);
  const FormConstants constants = form_constants(free.restricted(small.discrete->stiffness_matrix()), pairing.gram, true);
  const auto          eigenvalue = [](const unsigned k)
  {
    const double c = std::cos(k * std::numbers::pi / n);
    return 6. * n * n * (1 - c) / (2 + c);
  };
  EXPECT_NEAR(constants.m, eigenvalue(1) / (1 + eigenvalue(1)), 1e-8);
  EXPECT_NEAR(constants.M, eigenvalue(n - 1) / (1 + eigenvalue(n - 1)), 1e-8);
  // A multiple of H itself.
  const FormConstants twice = form_constants(2 * pairing.gram, pairing.gram, true);
  EXPECT_NEAR(twice.m, 2, 1e-8);
  EXPECT_NEAR(twice.M, 2, 1e-8);

  // H = I, A = I + 2 K with K' = -K, K'K = I: m = 1 does not see K, M^2 = 1 + 2^2 does.
  SparseMatrixd identity(40, 40), skewed(40, 40);
  for (int j = 0; j < 40; j += 2)
  {
    for (const int i : {j, j + 1})
    {
      identity.insert(i, i) = 1;
      skewed.insert(i, i) = 1;
    }
    skewed.insert(j, j + 1) = 2;
    skewed.insert(j + 1, j) = -2;
  }
  const FormConstants rotated = form_constants(skewed, identity, false);
  EXPECT_NEAR(rotated.m, 1, 1e-8);
  EXPECT_NEAR(rotated.M, std::sqrt(5.), 1e-8);
}

TEST(EpsilonStudy, a_form_that_is_not_symmetric)
{
  const EpsilonStudy result = study<1>("[mesh]\nbox = [[0], [1]]\ncells = 32\n[model]\nkind = \"membrane\"\nload = 1\nvelocity = [2]\n"
                                       "[boundary]\nall = 0\n[constraint]\nupper = 0.05\n");
  EXPECT_FALSE(result.hypotheses.symmetric);
  EXPECT_FALSE(result.rows.front().bound_u_gap);
  EXPECT_GT(*result.constants.M, 1);
  EXPECT_TRUE(*result.holds.theorem3_u && *result.holds.theorem3_p && *result.holds.lbb_free);
}

TEST(EpsilonStudy, both_sides_of_a_constraint)
{
  const EpsilonStudy result = study<1>("[mesh]\nbox = [[0], [1]]\ncells = 32\n[model]\nkind = \"membrane\"\nload = \"30*sin(2*pi*x)\"\n"
                                       "[boundary]\nall = 0\n[constraint]\nlower = -0.2\nupper = 0.2\n");
  EXPECT_GT(*result.constants.C_h, 0);
  EXPECT_TRUE(*result.holds.theorem3_u && *result.holds.theorem3_p);
}

// The rates of the continuous penalty problem, uniform in h: eps^(3/4) for u, eps^(1/4) for p.
TEST(EpsilonStudy, uniform_rates_on_a_fine_mesh)
{
  const EpsilonStudy result = study<1>(string_under_ceiling(3000, "Q1", "nodal"), {1e-2, 1e-3, 1e-4});
  // From the exact solution of the penalised string.
  EXPECT_NEAR(result.rows[0].p_error_L2, 0.209853757545, 1e-3);
  EXPECT_NEAR(result.rows[1].p_error_L2, 0.119058633850, 1e-3);
  EXPECT_NEAR(result.rows[1].u_error_energy, 0.00289899170791, 2e-5);
  EXPECT_NEAR(result.rows[2].u_error_energy, 0.000466803815182, 2e-5);
  EXPECT_NEAR(*result.rows[2].slope_u, 0.75, 0.06);
  EXPECT_NEAR(*result.rows[2].slope_p, 0.25, 0.02);
}

TEST(EpsilonStudy, default_values_do_not_know_units)
{
  const EpsilonStudy metres = study<1>(string_under_ceiling(16, "Q1", "nodal"));
  const EpsilonStudy scaled =
    study<1>("[mesh]\nbox = [[0], [1000]]\ncells = 16\n[model]\nkind = \"membrane\"\nload = 1e3\nstiffness = 1e6\n"
             "[boundary]\nall = 0\n[constraint]\nupper = \"1000/18\"\n");
  EXPECT_DOUBLE_EQ(metres.rows.front().epsilon, 0.1);
  EXPECT_NEAR(scaled.rows.front().epsilon, 0.1, 1e-12);
}

// d = u_eps - u_h computed as such is the difference of the two solutions, as far as that has digits.
TEST(IncrementProblem, is_the_difference_of_two_solutions)
{
  SmallProblem<2> small(smooth_contact);
  auto           &problem = *small.discrete;
  Progress        quiet;
  const double    epsilon = 1e-3;
  Vector          u = small.zero_dofs(), lambda = small.zero_points(), u_h = u, lambda_h = lambda, d = u, mu = lambda;
  method_of_multipliers(problem, {.epsilon = 0, .tolerance = 1e-12}, {}, u_h, lambda_h, quiet);
  method_of_multipliers(problem, {.epsilon = epsilon, .tolerance = 1e-12}, {}, u, lambda, quiet);
  IncrementProblem increment(problem, u_h, lambda_h);
  EXPECT_TRUE(method_of_multipliers(increment, {.epsilon = epsilon, .tolerance = 1e-12}, {}, d, mu, quiet).converged);
  Vector difference = u;
  difference -= u_h;
  difference -= d;
  EXPECT_LT(difference.linfty_norm(), 1e-9 * d.linfty_norm());
  mu -= lambda;
  EXPECT_LT(mu.linfty_norm(), 1e-8 * lambda.linfty_norm());
}
