// Smoothed aggregation: aggregates, prolongations, and conjugate gradients with nothing but them as coarse spaces.
#include "unilateral/multigrid/aggregation.h"

#include "algebra/five_point_grid.h"
#include "multigrid/rows_at_unknowns.h"
#include "unilateral/algebra/conjugate_gradients.h"
#include "unilateral/multigrid/galerkin_multigrid.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

using namespace unilateral;

namespace
{
  /// A cubic lattice of springs, along edges and diagonals: its matrix knows the six rigid body modes. Nodes of the layer z = 0 are fixed
  /// where that is asked for.
  struct Lattice
  {
    explicit Lattice(
      const int n, const bool fixed = true, const std::function<double(double)> &stiffness = [](double) { return 1.; })
      : n_nodes(n * n * n)
    {
      dealii::DynamicSparsityPattern entries(3 * n_nodes, 3 * n_nodes);
      const auto                     for_each_spring = [&](const auto &visit)
      {
        for (int i = 0; i < n_nodes; ++i)
          for (int dx = -1; dx <= 1; ++dx)
            for (int dy = -1; dy <= 1; ++dy)
              for (int dz = -1; dz <= 1; ++dz)
              {
                const auto at = position(i, n);
                const int  x = int(at[0]) + dx, y = int(at[1]) + dy, z = int(at[2]) + dz;
                const int  length = std::abs(dx) + std::abs(dy) + std::abs(dz), j = (z * n + y) * n + x;
                if ((length == 1 || length == 2) && std::min({x, y, z}) >= 0 && std::max({x, y, z}) < n && i < j)
                  visit(i, j, std::array<double, 3>{double(dx), double(dy), double(dz)}, stiffness(at[0] + dx / 2.) / length);
              }
      };
      const auto is_fixed = [&](const int node) { return fixed && position(node, n)[2] == 0; };
      for_each_spring(
        [&](const int i, const int j, const auto &, double)
        {
          for (unsigned a = 0; a < 3; ++a)
            for (unsigned b = 0; b < 3; ++b)
              for (const int row : {i, j})
                for (const int column : {i, j})
                  entries.add(3 * row + a, 3 * column + b);
        });
      pattern.copy_from(entries);
      matrix.reinit(pattern);
      for_each_spring(
        [&](const int i, const int j, const auto &d, const double c)
        {
          for (unsigned a = 0; a < 3; ++a)
            for (unsigned b = 0; b < 3; ++b)
              for (const int row : {i, j})
                for (const int column : {i, j})
                  if (!is_fixed(row) && !is_fixed(column))
                    matrix.add(3 * row + a, 3 * column + b, (row == column ? c : -c) * d[a] * d[b]);
        });
      for (unsigned k = 0; k < 6; ++k)
        modes.emplace_back(3 * n_nodes);
      for (int node = 0; node < n_nodes; ++node)
      {
        if (is_fixed(node))
        {
          for (unsigned a = 0; a < 3; ++a)
            matrix.set(3 * node + a, 3 * node + a, 1.);
          continue;
        }
        const auto x = position(node, n);
        for (unsigned a = 0; a < 3; ++a)
        {
          const unsigned b = (a + 1) % 3, c = (a + 2) % 3;
          modes[a](3 * node + a) = 1;
          modes[3 + a](3 * node + c) = x[b];
          modes[3 + a](3 * node + b) = -x[c];
        }
      }
    }

    static std::array<double, 3> position(const int node, const int n)
    {
      return {double(node % n), double(node / n % n), double(node / (n * n))};
    }

    const int                    n_nodes;
    dealii::SparsityPattern      pattern;
    dealii::SparseMatrix<double> matrix;
    std::vector<Vector>          modes;
  };
  /// Steps of conjugate gradients for A + diag(d); fails the test where they do not converge.
  unsigned steps(const dealii::SparseMatrix<double> &A, const Vector &d, const GalerkinMultigrid &multigrid)
  {
    Vector exact(A.m()), rhs(exact), x(exact);
    for (std::size_t i = 0; i < exact.size(); ++i)
      exact(i) = std::sin(1 + 0.1 * i * i);
    const LinearMap T = [&](Vector &Tx, const Vector &v)
    {
      A.vmult(Tx, v);
      for (std::size_t i = 0; i < d.size(); ++i)
        Tx(i) += d(i) * v(i);
    };
    T(rhs, exact);
    ConjugateGradients cg;
    const LinearSolve  solve = cg.solve(
       T, [&](Vector &z, const Vector &r) { multigrid.vmult(z, r); }, rhs, [](const Vector &a, const Vector &b) { return a * b; },
       {0, 1e-10}, 200, x);
    EXPECT_TRUE(solve.converged) << solve.failure;
    x -= exact;
    EXPECT_LT(x.linfty_norm(), 1e-5);
    return solve.iterations;
  }
} // namespace

TEST(Aggregation, every_free_node_is_in_an_aggregate)
{
  const Lattice    lattice(10);
  const Aggregates sets = aggregates(lattice.matrix, 3, 0.02);
  ASSERT_EQ(sets.of_node.size(), 1000u);
  std::set<std::uint32_t> met;
  for (unsigned node = 0; node < 1000; ++node)
    if (node < 100) // z = 0
      EXPECT_EQ(sets.of_node[node], Aggregates::none);
    else
    {
      ASSERT_LT(sets.of_node[node], sets.size);
      met.insert(sets.of_node[node]);
    }
  EXPECT_EQ(met.size(), sets.size);
  EXPECT_LT(sets.size, 900 / 8);
}

TEST(Aggregation, rigid_body_modes_are_in_the_coarse_space)
{
  for (const bool fixed : {false, true})
  {
    const int             n = 9;
    const Lattice         lattice(n, fixed);
    const AggregatedSpace space = aggregated_space(lattice.matrix, 3, lattice.modes, {});
    ASSERT_EQ(space.P.n_columns, 6u);
    ASSERT_EQ(space.near_null_space.size(), 6u);
    for (unsigned k = 0; k < 6; ++k)
    {
      std::vector<float> coarse(space.near_null_space[k].begin(), space.near_null_space[k].end()), fine(space.P.n_fine(), 0.F);
      space.P.prolongate(coarse.data(), 1, fine.data());
      for (int i = fixed ? 3 * 2 * n * n : 0; i < 3 * n * n * n; ++i) // not next to what is fixed
        EXPECT_NEAR(fine[i], lattice.modes[k](i), 2e-5) << "mode " << k;
    }
  }
}

TEST(Aggregation, galerkin_product_is_that_of_dense_matrices)
{
  const Lattice         lattice(5);
  const AggregatedSpace space = aggregated_space(lattice.matrix, 3, lattice.modes, {});
  Eigen::MatrixXd       P = Eigen::MatrixXd::Zero(space.P.n_fine(), space.P.n_coarse());
  for (std::size_t j = 0; j < space.P.n_coarse(); ++j)
  {
    std::vector<float> coarse(space.P.n_coarse(), 0.F), fine(space.P.n_fine(), 0.F);
    coarse[j] = 1;
    space.P.prolongate(coarse.data(), 1, fine.data());
    for (std::size_t i = 0; i < fine.size(); ++i)
      P(i, j) = fine[i];
  }
  std::vector<float> fine(space.P.n_fine()), coarse(space.P.n_coarse());
  for (std::size_t i = 0; i < fine.size(); ++i)
    fine[i] = std::sin(i);
  space.P.restrict(fine.data(), coarse.data());
  const Eigen::VectorXd restricted = P.transpose() * Eigen::Map<const Eigen::VectorXf>(fine.data(), fine.size()).cast<double>();
  for (std::size_t j = 0; j < coarse.size(); ++j)
    EXPECT_NEAR(coarse[j], restricted(j), 1e-4);

  Eigen::MatrixXd expected = P.transpose() * dense(lattice.matrix) * P;
  for (Eigen::Index j = 0; j < expected.cols(); ++j)
    if (P.col(j).norm() == 0)
      expected(j, j) = 1;
  dealii::SparsityPattern      pattern;
  dealii::SparseMatrix<double> coarse_matrix;
  galerkin_product(lattice.matrix, space.P, pattern, coarse_matrix);
  EXPECT_LT((dense(coarse_matrix) - expected).norm(), 1e-12 * expected.norm());

  const OwnSparseRows B = rows_at_unknowns(lattice.matrix.m()), BP = product(B.rows(), space.P);
  for (std::size_t i = 0; i < BP.size(); ++i)
    for (std::size_t k = BP.row_start[i]; k < BP.row_start[i + 1]; ++k)
      EXPECT_EQ(BP.values[k], P(i, BP.columns[k]));
}

TEST(Aggregation, steps_hardly_grow_with_the_lattice)
{
  for (const double jump : {1., 1e4})
  {
    std::vector<unsigned> counts;
    for (const int n : {12, 22})
    {
      const Lattice       lattice(n, true, [&](const double x) { return x < n / 2. ? 1. : jump; });
      const OwnSparseRows B = rows_at_unknowns(lattice.matrix.m());
      GalerkinMultigrid   multigrid(SymmetricBlockMatrix(lattice.matrix, 3), B.rows(), {},
                                    {.block_size = 3, .near_null_space = lattice.modes});
      EXPECT_GE(multigrid.n_levels(), 2u);
      EXPECT_TRUE(multigrid.factorises());
      Vector d(lattice.matrix.m());
      for (const bool contact : {false, true})
      {
        for (std::size_t i = d.size() - 3 * n * n; i < d.size() && contact; i += 3)
          d(i) = 1e3 * jump;
        multigrid.set_diagonal(d);
        counts.push_back(steps(lattice.matrix, d, multigrid));
        EXPECT_LE(counts.back(), 45u) << "n " << n << ", jump " << jump << ", contact " << contact;
      }
    }
    EXPECT_LE(counts[2], 1.5 * counts[0]);
    EXPECT_LE(counts[3], 1.5 * counts[1]);
  }
}

TEST(Aggregation, membranes_and_bodies_in_the_plane)
{
  for (const unsigned n : {40u, 120u})
  {
    const FivePointGrid grid(n);
    const OwnSparseRows B = rows_at_unknowns(grid.exact.size());
    GalerkinMultigrid   multigrid(SymmetricBlockMatrix(grid.matrix, 1), B.rows(), {}, {.block_size = 1, .near_null_space = {}});
    EXPECT_GE(multigrid.n_levels(), 2u);
    Vector d(grid.exact.size());
    multigrid.set_diagonal(d);
    EXPECT_LE(steps(grid.matrix, d, multigrid), 35u) << n;
  }
}
