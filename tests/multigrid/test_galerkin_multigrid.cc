// Gauss-Seidel by nodes, and the V-cycle on Galerkin products.
#include "unilateral/multigrid/galerkin_multigrid.h"

#include "algebra/five_point_grid.h"
#include "algebra/random_symmetric_matrix.h"
#include "multigrid/rows_at_unknowns.h"
#include "unilateral/algebra/conjugate_gradients.h"
#include "unilateral/multigrid/block_gauss_seidel.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>

using namespace unilateral;

namespace
{
  /// From a grid of (n - 1)/2 nodes in each direction to one of n.
  OwnSparseRows bilinear(const unsigned n, const unsigned copies)
  {
    const int     n_coarse = (n - 1) / 2;
    OwnSparseRows P;
    P.n_columns = n_coarse * n_coarse * copies;
    for (int i = 0; i < int(n); ++i)
      for (int j = 0; j < int(n); ++j)
        for (unsigned c = 0; c < copies; ++c)
        {
          for (int I = 0; I < n_coarse; ++I)
            for (int J = 0; J < n_coarse; ++J)
            {
              const double w = std::max(0., 1 - std::abs(i - 2 * I - 1) / 2.) * std::max(0., 1 - std::abs(j - 2 * J - 1) / 2.);
              if (w > 0)
              {
                P.columns.push_back((I * n_coarse + J) * copies + c);
                P.values.push_back(w);
              }
            }
          P.row_start.push_back(P.columns.size());
        }
    return P;
  }

  /// Points that see unknowns of two nodes which RandomSymmetricMatrix connects, in any order.
  OwnSparseRows rows_at_neighbours(const unsigned n, const unsigned block_size)
  {
    OwnSparseRows B;
    B.n_columns = n;
    for (unsigned node = 0; node + 1 < n / block_size; ++node)
      if (node % 5 != 3 && (node + 1) % 5 != 3)
      {
        B.columns.insert(B.columns.end(), {(node + 1) * block_size, node * block_size + block_size - 1, (node + 2) * block_size - 1});
        B.values.insert(B.values.end(), {1., -0.5, block_size > 1 ? 0.25 : 0.});
        B.row_start.push_back(B.columns.size());
      }
    return B;
  }

  Eigen::MatrixXd dense(const OwnSparseRows &B)
  {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(B.size(), B.n_columns);
    for (std::size_t i = 0; i < B.size(); ++i)
      for (std::size_t k = B.row_start[i]; k < B.row_start[i + 1]; ++k)
        result(i, B.columns[k]) += B.values[k];
    return result;
  }
} // namespace

TEST(BlockGaussSeidel, sweeps_are_those_of_the_dense_matrix)
{
  for (const unsigned block_size : {1u, 2u, 3u, 6u})
  {
    const RandomSymmetricMatrix random(15, block_size);
    const SymmetricBlockMatrix  A(random.matrix, block_size);
    const unsigned              n = A.m();
    const OwnSparseRows         B = rows_at_neighbours(n, block_size);
    const Eigen::MatrixXd       dense_B = dense(B);
    BlockGaussSeidel            smoother(A, B.rows());
    Vector                      d(B.size());
    for (const unsigned touching : {0u, n / 2, 1u}) // the last takes most of the contact away again
    {
      Eigen::MatrixXd T = dense(random.matrix);
      d = 0.;
      for (unsigned i = 0; i < std::min<std::size_t>(touching, B.size()); ++i)
      {
        d(i) = 3;
        T += 3 * dense_B.row(i).transpose() * dense_B.row(i);
      }
      smoother.set_diagonal(d);
      Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(n, n), upper = lower;
      for (unsigned i = 0; i < n; ++i)
        for (unsigned j = 0; j < n; ++j)
        {
          lower(i, j) = j / block_size <= i / block_size ? T(i, j) : 0;
          upper(i, j) = j / block_size >= i / block_size ? T(i, j) : 0;
        }
      Eigen::VectorXf r(n), x(n), rest(n), scratch(n);
      for (unsigned i = 0; i < n; ++i)
        r(i) = float(std::sin(1 + i));
      smoother.first_sweep(r.data(), x.data(), rest.data());
      const Eigen::VectorXd rd = r.cast<double>();
      const Eigen::VectorXd first = lower.inverse() * rd, left = rd - T * first;
      EXPECT_LT((x.cast<double>() - smoother.scale() * first).norm(), 1e-5);
      EXPECT_LT((rest.cast<double>() - left).norm(), 1e-5);
      smoother.backward_sweep(r.data(), x.data(), scratch.data());
      EXPECT_LT((x.cast<double>() - smoother.scale() * (first + upper.inverse() * left)).norm(), 1e-5);
    }
  }
}

TEST(GalerkinMultigrid, counts_do_not_depend_on_the_grid)
{
  for (const unsigned copies : {1u, 2u})
    for (const unsigned n_levels : {3u, 5u})
    {
      unsigned                   n = 7;
      std::vector<OwnSparseRows> prolongations;
      for (unsigned l = 1; l < n_levels; ++l)
      {
        n = 2 * n + 1;
        prolongations.insert(prolongations.begin(), bilinear(n, copies));
      }
      const FivePointGrid grid(n, 0, copies);
      const OwnSparseRows B = rows_at_unknowns(grid.exact.size());
      GalerkinMultigrid   multigrid(SymmetricBlockMatrix(grid.matrix, copies), B.rows(), std::move(prolongations),
                                    {.block_size = copies, .near_null_space = {}});
      EXPECT_EQ(multigrid.n_levels(), n_levels);
      EXPECT_TRUE(multigrid.factorises());
      Vector d(grid.exact.size());
      for (unsigned step = 0; step < 2; ++step) // without contact, and with contact on a third of the nodes
      {
        for (std::size_t i = 0; i < d.size() / 3 && step > 0; ++i)
          d(i) = 10;
        multigrid.set_diagonal(d);
        const LinearMap T = [&](Vector &Tx, const Vector &x)
        {
          grid.matrix.vmult(Tx, x);
          for (std::size_t i = 0; i < d.size(); ++i)
            Tx(i) += d(i) * x(i);
        };
        Vector rhs(grid.exact), x(grid.exact);
        T(rhs, grid.exact);
        x = 0.;
        ConjugateGradients cg;
        const LinearSolve  solve = cg.solve(
           T, [&](Vector &z, const Vector &r) { multigrid.vmult(z, r); }, rhs, [](const Vector &a, const Vector &b) { return a * b; },
           {0, 1e-10}, 50, x);
        EXPECT_TRUE(solve.converged) << solve.failure;
        EXPECT_LE(solve.iterations, 14u) << n << " nodes, step " << step;
        x -= grid.exact;
        EXPECT_LT(x.linfty_norm(), 1e-7);
      }
    }
}

TEST(GalerkinMultigrid, passes_over_spaces_that_are_nearly_as_large)
{
  const FivePointGrid        grid(15);
  const OwnSparseRows        B = rows_at_unknowns(grid.exact.size());
  std::vector<OwnSparseRows> prolongations = {rows_at_unknowns(225), bilinear(15, 1), rows_at_unknowns(49), bilinear(7, 1)};
  GalerkinMultigrid multigrid(SymmetricBlockMatrix(grid.matrix, 1), B.rows(), std::move(prolongations), GalerkinMultigrid::Parameters());
  EXPECT_EQ(multigrid.n_levels(), 3u); // of 225, 49 and 9 unknowns
  Vector d(grid.exact.size()), x(d);
  multigrid.set_diagonal(d);
  multigrid.vmult(x, grid.rhs);
  x -= grid.exact;
  EXPECT_LT(x.l2_norm(), 0.3 * grid.exact.l2_norm());
}

TEST(GalerkinMultigrid, few_changes_of_the_contact_need_no_new_factorisation)
{
  const FivePointGrid        grid(15);
  const OwnSparseRows        B = rows_at_unknowns(grid.exact.size());
  std::vector<OwnSparseRows> prolongations = {bilinear(15, 1)};
  GalerkinMultigrid multigrid(SymmetricBlockMatrix(grid.matrix, 1), B.rows(), std::move(prolongations), GalerkinMultigrid::Parameters());
  Vector            d(grid.exact.size());
  for (unsigned i = 0; i < 100; ++i)
    d(i) = 5;
  multigrid.set_diagonal(d);
  EXPECT_EQ(multigrid.n_setups(), 1u);
  d(100) = 5;
  multigrid.set_diagonal(d);
  EXPECT_EQ(multigrid.n_setups(), 1u);
  d = 0.;
  multigrid.set_diagonal(d);
  EXPECT_EQ(multigrid.n_setups(), 2u);
}
