// Passes over the patches in single precision: products, steps of the smoother, and transfers as each other's transpose.
#include "both_ways.h"
#include "multigrid/chain_of_cells.h"
#include "unilateral/case/problem_of_case.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <set>
#include <string>
#include <vector>

namespace
{
  using namespace unilateral;

  /// By position, from numbers by unknown.
  LevelVector at_positions(const PatchSweep &sweep, const std::vector<double> &v)
  {
    LevelVector result(sweep.size(), 0.f);
    for (std::size_t i = 0; i < v.size(); ++i)
      result[sweep.positions()[i]] = v[i];
    return result;
  }

  double product(const LevelVector &a, const LevelVector &b)
  {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      sum += double(a[i]) * b[i];
    return sum;
  }

  /// On cells that were refined as a whole, and in places; nothing is fixed.
  const std::string meshes[] = {"box = [[0, 0], [2, 1]]\ncells = [6, 6]\nrefine = 2",
                                "box = [[0, 0], [2, 1]]\ncells = [6, 6]\nrefine = 1\nlocal = [{ where = \"x > 0.9\" }]"};

  std::string membrane(const std::string &mesh, const unsigned degree)
  {
    return fmt::format("[mesh]\n{}\n[model]\nkind = \"membrane\"\nelement = \"Q{}\"\nreaction = 1\nload = -1\n[boundary]\n"
                       "[constraint]\nlower = -0.2\n",
                       mesh, degree);
  }
} // namespace

TEST(PatchSweep, unknowns_have_positions_of_their_own)
{
  for (const unsigned n : {4, 5})
  {
    const ChainOfCells            chain(n);
    const PatchSweep              sweep(*chain.op, nullptr, {});
    const auto                   &position = sweep.positions();
    const std::set<std::uint32_t> different(position.begin(), position.end());
    ASSERT_EQ(position.size(), chain.n_dofs);
    EXPECT_EQ(different.size(), chain.n_dofs);
    EXPECT_LT(*different.rbegin(), sweep.size());
    EXPECT_EQ(sweep.n_batches(), 3u);
    // The batch that completes an unknown is that of the last patch which has it.
    for (unsigned cell = 0; cell < chain.n_cells; ++cell)
      for (unsigned i = 0; i + 1 < n; ++i)
        EXPECT_EQ(sweep.batch_of(position[chain.dofs[cell][i]]), cell / 32);
  }
}

TEST(PatchSweep, a_step_of_the_smoother_is_what_it_says)
{
  for (const unsigned n : {4, 5, 9})
  {
    ChainOfCells     chain(n);
    const PatchSweep sweep(*chain.op, nullptr, {});
    const auto       random = [&]
    {
      std::vector<double> v(chain.n_dofs);
      for (auto &entry : v)
        entry = chain.uniform(chain.generator);
      return v;
    };
    auto       x = random(), inverse = random();
    const auto b = random(), before = random(), penalty = random();
    for (const auto dof : chain.fixed)
      x[dof] = inverse[dof] = 0;
    // Blocks outside the cells come as terms.
    std::vector<double> beside(chain.n_dofs, 0.);
    for (const auto &[dofs, matrix] : chain.op->further_blocks())
      for (std::size_t k = 0; k < matrix.size(); ++k)
        beside[dofs[k / dofs.size()]] += matrix[k] * x[dofs[k % dofs.size()]];
    LevelVector       X = at_positions(sweep, x), step(sweep.size(), 0.f), terms = at_positions(sweep, beside);
    const LevelVector B = at_positions(sweep, b), D = at_positions(sweep, inverse), previous = at_positions(sweep, before),
                      P = at_positions(sweep, penalty);
    PatchSweep::Additions additions{P.data(), std::vector<unsigned char>(sweep.n_batches(), 3)};
    sweep.smooth({X.data(), previous.data(), step.data(), B.data(), D.data(), 0.3f, 0.7f}, additions, terms.data());

    const auto Ax = chain.product(x);
    for (unsigned i = 0; i < chain.n_dofs; ++i)
    {
      const double expected = 0.3 * before[i] + 0.7 * inverse[i] * (b[i] - Ax[i] - penalty[i] * x[i]);
      ASSERT_NEAR(step[sweep.positions()[i]], expected, 1e-5) << i;
      ASSERT_NEAR(X[sweep.positions()[i]], x[i] + expected, 1e-5) << i;
    }
    EXPECT_EQ(product(terms, terms), 0);
  }
}

TEST(PatchSweep, prolongation_reproduces_linear_functions_and_restriction_is_its_transpose)
{
  for (const auto &mesh : meshes)
    for (const unsigned degree : {1, 2})
    {
      const BothWays<2> both(membrane(mesh, degree));
      const auto       &levels = both.hierarchy->levels;
      const PatchSweep &sweep = *levels.back().sweep, &coarser = *levels[levels.size() - 2].sweep;
      const auto        linear = [](const auto &x) { return 1 + x[0] - 3 * x[1]; };
      // The same problem with one refinement less knows where the coarse unknowns are.
      Diagnostics diagnostics;
      Problem<2>  coarse_problem(problem_of(case_of(membrane("box = [[0, 0], [2, 1]]\ncells = [6, 6]\nrefine = 1", degree))), diagnostics);
      std::vector<Vector> nothing;
      coarse_problem.refine(nothing);

      LevelVector coarse(coarser.size(), 0.f), fine(sweep.size(), 0.f), one(sweep.size(), 1.f), zero(sweep.size(), 0.f);
      for (const auto &value : coarse_problem.space.nodal_values())
        coarse[coarser.positions()[value.dof]] = linear(value.x);
      sweep.prolongate(fine.data(), coarse.data(), one.data());
      for (const auto &value : both.assembled.problem->space.nodal_values())
      {
        const bool hangs = both.assembled.problem->space.dirichlet.is_constrained(value.dof);
        EXPECT_NEAR(fine[sweep.positions()[value.dof]], hangs ? 0 : linear(value.x), 1e-5) << value.x;
      }

      // (P'R b, c) = (b, R P c).
      const auto  b = both.random_function(1), r = both.random_function(2);
      LevelVector B = zero, receives = zero, P_c = zero, terms = zero, scratch = zero, restricted(coarser.size(), 0.f);
      for (std::size_t i = 0; i < b.size(); ++i)
      {
        B[sweep.positions()[i]] = b(i);
        receives[sweep.positions()[i]] = r(i) > 0;
      }
      sweep.prolongate(P_c.data(), coarse.data(), receives.data());
      sweep.restrict_residual(restricted.data(), B.data(), zero.data(), receives.data(), {}, terms.data(), scratch.data());
      EXPECT_NEAR(product(restricted, coarse), product(B, P_c), 1e-3);
    }
}
