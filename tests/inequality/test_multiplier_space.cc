// Equations (14) to (17): the pairing of Q_h with V_h, the cone N_h, and K_h by its dual.
#include "small_problem.h"

#include "unilateral/inequality/multiplier_space.h"
#include "unilateral/stability/multiplier_pairing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace unilateral;

namespace
{
  /// No Dirichlet data: V_h is the whole space, and s = 0.3 + 0.2 x is in it.
  template <int dim>
  std::string case_with(const std::string &element, const std::string &rule, const std::string &on = "")
  {
    return fmt::format("[mesh]\nbox = {}\ncells = 3\n[model]\nkind = \"membrane\"\nelement = \"{}\"\nreaction = 1\n[constraint]\n"
                       "upper = \"0.3 + 0.2*x\"\nquadrature = \"{}\"\n{}",
                       dim == 1   ? "[[0], [1]]"
                       : dim == 2 ? "[[0, 0], [1, 1]]"
                                  : "[[0, 0, 0], [1, 1, 1]]",
                       element, rule, on.empty() ? "" : "on = \"" + on + "\"\n");
  }

  Vector random_vector(Vector v, const unsigned seed)
  {
    std::mt19937                           random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (double &x : v)
      x = uniform(random);
    return v;
  }

  /// max |(q_i, phi_j) - I_G(q_i phi_j)| over the points i and the shape functions j.
  template <int dim>
  double exactness_defect(const std::string &element, const std::string &rule, const std::string &on = "")
  {
    const SmallProblem<dim> small(case_with<dim>(element, rule, on));
    const std::vector<bool> everywhere(small.constraint_set.size(), true);
    const Pairing           by_L2 = make_pairing(*small.problem, small.constraint_set, everywhere, PairingKind::by_L2);
    const Pairing           by_rule = make_pairing(*small.problem, small.constraint_set, everywhere, PairingKind::by_rule);
    const bool              small_defect = (by_L2.functionals - by_rule.functionals).norm() < 1e-12 * by_rule.functionals.norm();
    EXPECT_EQ(small_defect, small.constraint_set.blocks[0].exact_pairing) << element << " " << rule << " " << on;
    return (by_L2.functionals - by_rule.functionals).norm();
  }
} // namespace

// The answer for the reference cell is that of the integrals over the mesh, element by element and rule by rule.
TEST(MultiplierSpace, exactness_is_what_the_integrals_say)
{
  for (unsigned p = 1; p <= 4; ++p)
    for (unsigned n = 1; n <= 5; ++n)
    {
      const auto element = fmt::format("Q{}", p), rule = fmt::format("gauss({})", n);
      EXPECT_EQ(exactness_defect<1>(element, rule) < 1e-12, n >= p) << element << " " << rule;
      if (p <= 2 && n <= 3)
      {
        EXPECT_EQ(exactness_defect<2>(element, rule) < 1e-12, n >= p);
        EXPECT_EQ(exactness_defect<2>(element, rule, "top") < 1e-12, n >= p);
      }
    }
  EXPECT_LT(exactness_defect<3>("Q1", "gauss(1)", "front"), 1e-12);
  EXPECT_LT(exactness_defect<2>("P1", "gauss(1)"), 1e-12);
  EXPECT_LT(exactness_defect<3>("P1", "gauss(1)"), 1e-12);
  EXPECT_GT(exactness_defect<2>("P2", "gauss(1)"), 1e-3);
  EXPECT_LT(exactness_defect<2>("P1", "gauss(2)", "right"), 1e-12);
}

// (15): v <= s at the points if and only if (q, v - s) >= 0 for all q of N_h, with the L2 product, since (14) holds and s is in V_h.
TEST(MultiplierSpace, the_constraint_set_is_the_polar_of_the_cone)
{
  const SmallProblem<2>         small(case_with<2>("Q2", "gauss(2)"));
  const std::vector<bool>       everywhere(small.constraint_set.size(), true);
  const Pairing                 by_L2 = make_pairing(*small.problem, small.constraint_set, everywhere, PairingKind::by_L2);
  const MultiplierSpace         Q_h(*small.discrete);
  std::vector<dealii::Point<2>> nodes(small.problem->space.dof_handler.n_dofs());
  dealii::DoFTools::map_dofs_to_support_points(*small.problem->space.mapping, small.problem->space.dof_handler, nodes);
  unsigned n_inside = 0, n_outside = 0;
  for (unsigned seed = 0; seed < 200; ++seed)
  {
    Vector v = random_vector(small.zero_dofs(), seed);
    v *= 0.03 * (seed % 25);
    Eigen::VectorXd difference(v.size()); // v - s in V_h
    for (std::size_t j = 0; j < v.size(); ++j)
      difference(j) = v(j) - 0.3 - 0.2 * nodes[j][0];
    // The extreme rays of N_h are -q_i.
    const double least = -(by_L2.functionals.transpose() * difference).maxCoeff();
    EXPECT_EQ(least >= -1e-13, Q_h.in_K_h(v, 1e-12)) << seed;
    EXPECT_EQ(Q_h.violation(v) > 1e-13, least < -1e-13) << seed;
    (least >= 0 ? n_inside : n_outside)++;
  }
  EXPECT_GT(n_inside, 20u);
  EXPECT_GT(n_outside, 20u);
}

// (17) by I_G, for any rule: the supremum over the cone is the norm of the penetration, and it is attained.
TEST(MultiplierSpace, violation_is_the_supremum_over_the_cone)
{
  for (const char *rule : {"nodal", "gauss(1)", "gauss(2)", "simpson"})
  {
    const SmallProblem<2> small(case_with<2>("Q1", rule));
    const MultiplierSpace Q_h(*small.discrete);
    Vector                v = random_vector(small.zero_dofs(), 7);
    v.add(0.3);
    Vector excess = small.zero_points(), best = small.zero_points();
    small.discrete->apply_trace(excess, v);
    excess -= small.discrete->obstacle();
    for (std::size_t i = 0; i < best.size(); ++i)
      best(i) = -std::max(excess(i), 0.);
    EXPECT_TRUE(Q_h.in_N_h(best));
    EXPECT_NEAR(-Q_h.inner_product(best, excess) / Q_h.norm(best), Q_h.violation(v), 1e-13);
    for (unsigned seed = 0; seed < 50; ++seed)
    {
      Vector q = random_vector(small.zero_points(), seed);
      for (double &value : q)
        value = -std::abs(value);
      EXPECT_TRUE(Q_h.in_N_h(q));
      EXPECT_LE(-Q_h.inner_product(q, excess), Q_h.norm(q) * Q_h.violation(v) + 1e-13);
      EXPECT_NEAR(Q_h.pairing(q, v), Q_h.inner_product(q, excess) + Q_h.inner_product(q, small.discrete->obstacle()), 1e-13);
      q *= -1.;
      EXPECT_FALSE(Q_h.in_N_h(q));
    }
  }
}
