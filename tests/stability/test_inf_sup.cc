// Known inf-sup constants: unit interval with both ends fixed, unit square with the boundary fixed, uniform meshes.
#include "small_problem.h"

#include "unilateral/stability/inf_sup.h"

#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <tuple>

using namespace unilateral;

namespace
{
  /// V_h on the unit interval or square with n cells a direction, and the middle third as a zone.
  template <int dim>
  struct Pair
  {
    Pair(const std::string &element, const std::string &rule, const unsigned n, const std::string &on = "")
      : small(fmt::format("[mesh]\nbox = {}\ncells = {}\n[model]\nkind = \"membrane\"\nelement = \"{}\"\n[boundary]\nall = 0\n{}"
                          "[constraint]\nupper = 1\nquadrature = \"{}\"\n{}",
                          dim == 1 ? "[[0], [1]]" : "[[0, 0], [1, 1]]",
                          n,
                          element,
                          on.empty() ? "" : on + " = \"free\"\n",
                          rule,
                          on.empty() ? "" : "on = \"" + on + "\"\n")),
        everywhere(small.constraint_set.size(), true), middle(everywhere)
    {
      for (std::size_t i = 0; i < middle.size(); ++i)
        for (unsigned d = 0; d < dim; ++d)
          if (std::abs(small.constraint_set.points[i].x[d] - 0.5) > 1. / 6 + 1e-9)
            middle[i] = false;
    }

    InfSup constants(const std::vector<bool> &zone,
                     const bool               with_dual_norm = false,
                     const PairingKind        kind = PairingKind::by_rule,
                     const InfSupLimits      &limits = {}) const
    {
      const auto &[problem, set] = std::tie(*small.problem, small.constraint_set);
      const Pairing pairing = make_pairing(problem, set, zone, kind);
      if (!with_dual_norm)
        return inf_sup(pairing, nullptr, limits);
      const bool    exact = set.blocks[0].exact_pairing && has_polynomials(problem, set);
      const Pairing dual = make_dual_pairing(problem, set, zone, exact ? PairingKind::by_L2 : kind);
      return inf_sup(pairing, &dual, limits);
    }

    SmallProblem<dim> small;
    std::vector<bool> everywhere, middle;
  };

  template <int dim>
  InfSup
  constants(const std::string &element, const std::string &rule, const unsigned n, const bool middle, const bool with_dual_norm = false)
  {
    const Pair<dim> pair(element, rule, n);
    return pair.constants(middle ? pair.middle : pair.everywhere, with_dual_norm);
  }

  void expect_digits(const double value, const double expected, const double relative)
  {
    EXPECT_NEAR(value, expected, relative * std::abs(expected));
  }
} // namespace

TEST(InfSup, table_of_one_dimensional_pairs)
{
  struct Row
  {
    const char *element, *rule;
    int         nullity;              ///< at n = 24: everywhere
    double      C_h_coarse, C_h_fine; ///< at n = 6 and 96: everywhere where the nullity is 0, in the middle third otherwise
  };
  // gauss(p) in the middle third, nodal rules everywhere; p + 1 Gauss points leave a kernel everywhere.
  const std::vector<Row> rows = {{"Q1", "midpoint", 1, 6.74e-2, 2.56e-4}, {"Q1", "nodal", 0, 8.62e-2, 5.21e-3},
                                 {"Q2", "gauss(2)", 1, 2.10e-2, 8.52e-5}, {"Q2", "nodal", 0, 3.44e-2, 2.13e-3},
                                 {"Q3", "gauss(3)", 1, 1.06e-2, 4.26e-5}, {"Q3", "nodal", 0, 1.94e-2, 1.21e-3}};
  for (const Row &row : rows)
  {
    SCOPED_TRACE(std::string(row.element) + " " + row.rule);
    EXPECT_EQ(int(constants<1>(row.element, row.rule, 24, false).nullity), row.nullity);
    expect_digits(constants<1>(row.element, row.rule, 6, row.nullity > 0).C_h, row.C_h_coarse, 5e-3);
    expect_digits(constants<1>(row.element, row.rule, 96, row.nullity > 0).C_h, row.C_h_fine, 5e-3);
  }
  // The pairing by I_G where (14) fails.
  expect_digits(constants<1>("Q2", "gauss(1)", 96, false).C_h, 4.51e-3, 5e-3);
  expect_digits(constants<1>("Q3", "gauss(2)", 96, false).C_h, 2.24e-3, 5e-3);
  expect_digits(constants<1>("Q4", "gauss(3)", 96, false).C_h, 1.34e-3, 5e-3);
}

TEST(InfSup, kernels_count_as_theory_says)
{
  for (const unsigned p : {1u, 2u, 3u})
    for (const unsigned n : {8u, 24u})
    {
      const auto result = constants<1>(fmt::format("Q{}", p), fmt::format("gauss({})", p + 1), n, false);
      EXPECT_EQ(result.rank, p * n - 1);
      EXPECT_EQ(result.nullity, n + 1);
      EXPECT_EQ(result.C_h, 0);
    }
}

TEST(InfSup, dual_norm_constants)
{
  EXPECT_NEAR(*constants<1>("Q1", "nodal", 24, false, true).beta_h, 1, 0.01);
  EXPECT_NEAR(*constants<1>("Q2", "nodal", 24, false, true).beta_h, std::sqrt(0.75), 0.01);
  EXPECT_NEAR(*constants<1>("Q2", "gauss(1)", 24, false, true).beta_h, 0.866, 0.01);
  EXPECT_NEAR(*constants<1>("Q3", "nodal", 24, false, true).beta_h, 0.8391, 0.0005);
  EXPECT_NEAR(*constants<1>("Q3", "gauss(2)", 24, false, true).beta_h, 0.908, 0.005);
  EXPECT_NEAR(*constants<1>("Q4", "gauss(3)", 24, false, true).beta_h, 0.876, 0.005);
  EXPECT_NEAR(*constants<1>("Q1", "gauss(2)", 24, false, true).beta_h_nonzero, 0.913, 0.001);
  EXPECT_NEAR(*constants<1>("Q2", "gauss(3)", 24, false, true).beta_h_nonzero, 0.837, 0.001);
  EXPECT_NEAR(*constants<1>("Q3", "gauss(4)", 24, false, true).beta_h_nonzero, 0.775, 0.001);
  EXPECT_NEAR(*constants<1>("Q1", "midpoint", 24, true, true).beta_h, 0.323, 0.004);
  EXPECT_NEAR(*constants<1>("Q1", "midpoint", 48, true, true).beta_h, 0.168, 0.002);
  EXPECT_NEAR(*constants<1>("Q2", "gauss(2)", 24, true, true).beta_h, 0.247, 0.003);
  EXPECT_NEAR(*constants<1>("Q3", "gauss(3)", 24, true, true).beta_h, 0.208, 0.003);
}

TEST(InfSup, pairing_by_the_L2_product)
{
  const auto by_L2 = [](const std::string &element, const std::string &rule)
  {
    const Pair<1> pair(element, rule, 96);
    return pair.constants(pair.everywhere, true, PairingKind::by_L2);
  };
  expect_digits(by_L2("Q2", "gauss(1)").C_h, 3.01e-3, 5e-3);
  expect_digits(by_L2("Q3", "gauss(2)").C_h, 1.34e-3, 5e-3);
  EXPECT_NEAR(*by_L2("Q2", "gauss(1)").beta_h, 1, 1e-3);
  EXPECT_NEAR(*by_L2("Q3", "gauss(2)").beta_h, 1, 1e-3);
}

TEST(InfSup, dual_norm_constants_in_the_plane)
{
  const double q1_midpoint[] = {0.855, 0.578, 0.264, 0.091}, q2_gauss[] = {0.737, 0.448, 0.185};
  for (unsigned k = 0; k < 4; ++k)
    EXPECT_NEAR(*constants<2>("Q1", "midpoint", 3 << k, true, true).beta_h, q1_midpoint[k], 6e-4);
  for (unsigned k = 0; k < 3; ++k)
    EXPECT_NEAR(*constants<2>("Q2", "gauss(2)", 3 << k, true, true).beta_h, q2_gauss[k], 6e-4);
  EXPECT_NEAR(*constants<2>("Q2", "midpoint", 6, false, true).beta_h, constants<2>("Q2", "midpoint", 12, false, true).beta_h.value(), 0.01);
}

// The best any pair can do is h^m in a domain and h^(1/2) on a boundary; a checkerboard costs one power more.
TEST(InfSup, exponents_on_triangles_and_on_a_boundary)
{
  const auto rate = [](const std::string &element, const std::string &rule, const std::string &on)
  {
    const Pair<2> coarse(element, rule, 8, on), fine(element, rule, 16, on);
    return std::log2(coarse.constants(coarse.everywhere).C_h_nonzero / fine.constants(fine.everywhere).C_h_nonzero);
  };
  EXPECT_NEAR(rate("P1", "nodal", ""), 1, 0.05);
  EXPECT_NEAR(rate("P2", "edges", ""), 1, 0.05);
  for (const char *element : {"Q1", "P1", "Q2"})
    EXPECT_NEAR(rate(element, "nodal", "top"), 0.5, 0.02) << element;
  for (const auto &[element, rule] : {std::pair("Q1", "midpoint"), {"Q2", "gauss(2)"}, {"P1", "midpoint"}, {"P2", "gauss(2)"}})
    EXPECT_NEAR(rate(element, rule, "top"), 1.5, 0.05) << element;
}

/// The faces of refined curved cells lie on none of the coarse cell's, but belong to one of them.
TEST(InfSup, dual_norm_constants_on_curved_faces)
{
  for (const char *const element : {"P1", "Q1"})
  {
    SCOPED_TRACE(element);
    const SmallProblem<3>   ball(fmt::format("[mesh]\nball = {{ center = [0, 0, 0] }}\n[[part]]\nname = \"held\"\nwhere = \"z > 0.3\"\n"
                                               "[model]\nkind = \"elasticity\"\nelement = \"{}\"\nyoung = 1\npoisson = 0.3\n[boundary]\n"
                                               "held = [0, 0, 0]\n[constraint]\non = \"surface\"\ngap = 1\nquadrature = \"gauss(1)\"\n",
                                             element));
    const std::vector<bool> everywhere(ball.constraint_set.size(), true);
    const Pairing           pairing = make_pairing(*ball.problem, ball.constraint_set, everywhere, PairingKind::by_rule);
    const Pairing           dual = make_dual_pairing(*ball.problem, ball.constraint_set, everywhere, PairingKind::by_L2);
    const InfSup            constants = inf_sup(pairing, &dual);
    ASSERT_TRUE(constants.beta_h_nonzero);
    EXPECT_GT(*constants.beta_h_nonzero, constants.C_h_nonzero); // ||q||_-1/2 is at most about ||q||_0
    EXPECT_LT(*constants.beta_h_nonzero, 1.2);
  }
}

TEST(InfSup, lanczos_iterations_agree_with_dense_matrices)
{
  const InfSupLimits sparse{.dense = 0};
  for (const auto &[element, rule, with_dual] : {std::tuple("Q1", "nodal", true),
                                                 {"Q2", "nodal", true},
                                                 {"Q2", "midpoint", true},
                                                 {"Q1", "midpoint", false},
                                                 {"Q2", "gauss(3)", false}})
  {
    SCOPED_TRACE(std::string(element) + " " + rule);
    const Pair<2> pair(element, rule, 10);
    const InfSup  expected = pair.constants(pair.everywhere, true),
                 found = pair.constants(pair.everywhere, with_dual, PairingKind::by_rule, sparse);
    EXPECT_TRUE(expected.dense);
    EXPECT_FALSE(found.dense);
    EXPECT_EQ(found.rank, expected.rank);
    EXPECT_EQ(found.nullity, expected.nullity);
    expect_digits(found.C_h_nonzero, expected.C_h_nonzero, 1e-6);
    if (with_dual)
      expect_digits(found.beta_h.value(), expected.beta_h.value(), 1e-5);
    // The mode is what it is called: a kernel vector, or one on which the constant is attained.
    const Pairing         pairing = make_pairing(*pair.small.problem, pair.small.constraint_set, pair.everywhere, PairingKind::by_rule);
    const Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(found.lowest_mode.data(), found.lowest_mode.size());
    const Eigen::VectorXd Pq = pairing.functionals * q;
    EXPECT_NEAR(q.norm(), 1, 1e-8);
    const Eigen::MatrixXd H = pairing.gram;
    EXPECT_NEAR(std::sqrt(Pq.dot(H.llt().solve(Pq))), found.C_h, 1e-6 * found.C_h + 1e-10);
  }
}

TEST(InfSup, a_problem_beyond_the_limits_is_refused)
{
  const Pair<1> pair("Q1", "nodal", 20);
  EXPECT_THROW(pair.constants(pair.everywhere, false, PairingKind::by_rule, {.sparse = 30}), std::length_error);
}

TEST(InfSup, table_of_two_dimensional_pairs)
{
  const auto q1_midpoint = constants<2>("Q1", "midpoint", 12, false);
  EXPECT_EQ(q1_midpoint.n_dofs, 121u);
  EXPECT_EQ(q1_midpoint.nullity, 23u);
  expect_digits(constants<2>("Q1", "midpoint", 12, true).C_h, 4.64e-3, 5e-3);
  EXPECT_EQ(constants<2>("Q1", "gauss(2)", 12, false).nullity, 455u);
  expect_digits(constants<2>("Q1", "nodal", 12, false).C_h, 0.042, 2e-2);
  EXPECT_EQ(constants<2>("Q2", "gauss(2)", 12, false).nullity, 47u);
  expect_digits(constants<2>("Q2", "gauss(2)", 12, true).C_h, 1.29e-3, 5e-3);
  expect_digits(constants<2>("Q2", "nodal", 12, false).C_h, 1.56e-2, 1e-2);
}

TEST(InfSup, verdicts)
{
  const auto verdict = [](const std::string &element, const std::string &rule) {
    return judge_stability({constants<1>(element, rule, 16, false), constants<1>(element, rule, 32, false)}, 1, "nodal").stability;
  };
  EXPECT_EQ(verdict("Q1", "nodal"), Stability::stable);
  EXPECT_EQ(verdict("Q2", "nodal"), Stability::stable);
  EXPECT_EQ(verdict("Q3", "gauss(2)"), Stability::stable);
  EXPECT_EQ(verdict("Q1", "midpoint"), Stability::weakly_unstable);
  EXPECT_EQ(verdict("Q2", "gauss(2)"), Stability::weakly_unstable);
  EXPECT_EQ(verdict("Q1", "gauss(2)"), Stability::kernel);
  EXPECT_EQ(verdict("Q2", "gauss(3)"), Stability::kernel);
}
