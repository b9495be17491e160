// Known inf-sup constants: unit interval with both ends fixed, unit square with the boundary fixed, uniform meshes.
#include "tests/small_problem.h"

#include "unilateral/inf_sup.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace unilateral;

namespace
{
  template <int dim>
  InfSup
  constants(const std::string &element, const std::string &rule, const unsigned n, const bool middle, const bool with_dual_norm = false)
  {
    const std::string box = dim == 1 ? "[[0], [1]]" : "[[0, 0], [1, 1]]";
    SmallProblem<dim> small(
      fmt::format("[mesh]\nbox = {}\ncells = {}\n[model]\nkind = \"membrane\"\nelement = \"{}\"\n[boundary]\nall = 0\n"
                  "[constraint]\nupper = 1\nquadrature = \"{}\"\n",
                  box, n, element, rule));
    std::vector<bool> zone(small.constraint_set.size(), true);
    if (middle)
      for (std::size_t i = 0; i < zone.size(); ++i)
        for (unsigned d = 0; d < dim; ++d)
          if (std::abs(small.constraint_set.points[i][d] - 0.5) > 1. / 6)
            zone[i] = false;
    return inf_sup(*small.problem, small.constraint_set, zone, with_dual_norm);
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
  EXPECT_NEAR(*constants<1>("Q1", "midpoint", 24, true, true).beta_h, 0.323, 0.004);
  EXPECT_NEAR(*constants<1>("Q1", "midpoint", 48, true, true).beta_h, 0.168, 0.002);
  EXPECT_NEAR(*constants<1>("Q2", "gauss(2)", 24, true, true).beta_h, 0.247, 0.003);
  EXPECT_NEAR(*constants<1>("Q3", "gauss(3)", 24, true, true).beta_h, 0.208, 0.003);
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
