// Sparse Cholesky factorisations, and one that serves for A + B'DB with every diagonal D.
#include "unilateral/algebra/updated_cholesky.h"

#include "five_point_grid.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <csignal>
#include <numeric>
#include <random>

using namespace unilateral;

namespace
{
  /// x with T x = b, by the factorisation.
  Vector solution(const SparseCholesky &cholesky, const Vector &b)
  {
    Vector x(b);
    cholesky.forward(b.begin(), x.begin());
    cholesky.backward(x.begin(), x.begin());
    return x;
  }

  /// Rows of B with two or three entries each on the last nodes of a grid.
  struct RandomRows
  {
    RandomRows(const unsigned n_unknowns, const unsigned n_rows, std::mt19937 &random)
    {
      std::uniform_real_distribution<> value(-1, 1);
      for (unsigned i = 0; i < n_rows; ++i)
      {
        for (unsigned k = 0; k < 2 + i % 2; ++k)
        {
          columns.push_back(n_unknowns - 1 - (2 * i + 3 * k) % 20);
          values.push_back(value(random));
        }
        row_start.push_back(columns.size());
      }
    }

    Eigen::MatrixXd dense(const unsigned n_unknowns) const
    {
      Eigen::MatrixXd B = Eigen::MatrixXd::Zero(row_start.size() - 1, n_unknowns);
      for (unsigned i = 0; i + 1 < row_start.size(); ++i)
        for (std::size_t k = row_start[i]; k < row_start[i + 1]; ++k)
          B(i, columns[k]) += values[k];
      return B;
    }

    std::vector<std::size_t>                     row_start = {0};
    std::vector<dealii::types::global_dof_index> columns;
    std::vector<double>                          values;
  };

  /// Largest error of (A + B'DB)^-1 b for some D, relative to x: all points, none where A alone has an inverse, and random ones.
  double largest_error(const dealii::SparseMatrix<double> &A, const std::vector<Vector> &modes)
  {
    std::mt19937     random(3);
    const unsigned   n = A.m(), n_rows = 9;
    const RandomRows B(n, n_rows, random);
    UpdatedCholesky  factorisation(A, {B.row_start, B.columns, B.values}, modes);
    factorisation.factorise();
    double                           largest = 0;
    std::uniform_real_distribution<> exponent(-6, 6);
    std::bernoulli_distribution      is_active(0.5);
    for (unsigned trial = 0; trial < 12; ++trial)
    {
      Vector d(n_rows), b(n), x(n);
      for (double &di : d)
        di = trial == 0 || is_active(random) ? std::pow(10., exponent(random)) : 0.;
      if (trial == 1 && modes.empty())
        d = 0.;
      for (double &bj : b)
        bj = exponent(random);
      factorisation.set_diagonal(d);
      factorisation.solve(x, b);
      const Eigen::MatrixXd rows = B.dense(n);
      const Eigen::MatrixXd T = dense(A) + rows.transpose() * Eigen::Map<Eigen::VectorXd>(d.begin(), n_rows).asDiagonal() * rows;
      const Eigen::VectorXd exact = T.ldlt().solve(Eigen::Map<Eigen::VectorXd>(b.begin(), n));
      largest = std::max(largest, (Eigen::Map<Eigen::VectorXd>(x.begin(), n) - exact).norm() / exact.norm());
    }
    return largest;
  }
} // namespace

TEST(SparseCholesky, solves_in_any_order)
{
  FivePointGrid grid(14);
  for (const std::vector<dealii::types::global_dof_index> &last : {std::vector<dealii::types::global_dof_index>{}, {5}, {3, 100, 7, 195}})
  {
    SparseCholesky cholesky(grid.matrix, last);
    cholesky.factorise(grid.matrix);
    grid.x = solution(cholesky, grid.rhs);
    EXPECT_LT(grid.error(), 1e-12);
    EXPECT_GE(cholesky.predicted_entries(), grid.matrix.n_nonzero_elements() / 2);
    EXPECT_GT(cholesky.predicted_operations(), cholesky.predicted_entries());
  }
}

TEST(SparseCholesky, leaves_the_Schur_complement_of_what_comes_last)
{
  const FivePointGrid                                grid(9);
  const std::vector<dealii::types::global_dof_index> last = {8, 2, 44, 45, 79};
  SparseCholesky                                     cholesky(grid.matrix, last);
  cholesky.factorise(grid.matrix);
  const Eigen::MatrixXd inverse = dense(grid.matrix).inverse(), L = cholesky.last_block();
  EXPECT_LT((L * L.transpose() - Eigen::MatrixXd(inverse(last, last)).inverse()).norm(), 1e-12);
}

TEST(SparseCholesky, takes_other_values_and_other_entries)
{
  FivePointGrid grid(10);
  auto          decoupled = grid.matrix.begin(33);
  // Row and column 33 are zero apart from the diagonal, as of an unknown with a prescribed value; later they are not.
  dealii::SparseMatrix<double> without(grid.pattern);
  without.copy_from(grid.matrix);
  for (auto entry = without.begin(); entry != without.end(); ++entry)
    if (entry->row() != entry->column() && (entry->row() == 33 || entry->column() == 33))
      entry->value() = 0;
  SparseCholesky cholesky(without);
  cholesky.factorise(without);
  const Vector x = solution(cholesky, grid.rhs);
  EXPECT_DOUBLE_EQ(x(33), grid.rhs(33) / decoupled->value());
  cholesky.factorise(grid.matrix);
  grid.x = solution(cholesky, grid.rhs);
  EXPECT_LT(grid.error(), 1e-12);
}

TEST(SparseCholesky, orders_matrices_without_couplings_and_keeps_the_handlers_of_signals)
{
  struct sigaction before = {}, after = {};
  std::signal(SIGTERM, SIG_IGN);
  sigaction(SIGTERM, nullptr, &before);
  FivePointGrid grid(30);
  SparseCholesky(grid.matrix).factorise(grid.matrix);
  sigaction(SIGTERM, nullptr, &after);
  std::signal(SIGTERM, SIG_DFL);
  EXPECT_EQ(before.sa_handler, after.sa_handler);
  EXPECT_EQ(before.sa_flags, after.sa_flags);

  for (auto entry = grid.matrix.begin(); entry != grid.matrix.end(); ++entry)
    entry->value() = entry->row() == entry->column() ? 2. + entry->row() : 0.;
  for (const std::vector<dealii::types::global_dof_index> &last : {std::vector<dealii::types::global_dof_index>{}, {7, 3}})
  {
    SparseCholesky cholesky(grid.matrix, last);
    cholesky.factorise(grid.matrix);
    const Vector x = solution(cholesky, grid.rhs);
    for (unsigned i = 0; i < x.size(); ++i)
      ASSERT_NEAR(x(i), grid.rhs(i) / (2. + i), 1e-15 * std::abs(grid.rhs(i)));
  }
}

TEST(SparseCholesky, eliminates_all_unknowns_in_a_given_order)
{
  FivePointGrid                                grid(4);
  std::vector<dealii::types::global_dof_index> all(grid.matrix.m());
  std::iota(all.begin(), all.end(), 0);
  SparseCholesky cholesky(grid.matrix, all);
  cholesky.factorise(grid.matrix);
  grid.x = solution(cholesky, grid.rhs);
  EXPECT_LT(grid.error(), 1e-13);
  const Eigen::MatrixXd L = cholesky.last_block();
  EXPECT_LT((L * L.transpose() - dense(grid.matrix)).norm(), 1e-13);
}

TEST(SparseCholesky, refuses_what_is_not_positive_definite)
{
  FivePointGrid  grid(6);
  SparseCholesky cholesky(grid.matrix);
  grid.matrix.diag_element(17) = -1;
  EXPECT_THROW(cholesky.factorise(grid.matrix), NotPositiveDefinite);
  EXPECT_NO_THROW(cholesky.factorise(grid.matrix, {{17, 6.}}));
}

TEST(UpdatedCholesky, one_factorisation_serves_for_every_diagonal)
{
  EXPECT_LT(largest_error(FivePointGrid(12).matrix, {}), 1e-9);
}

TEST(UpdatedCholesky, rows_without_entries_change_nothing)
{
  FivePointGrid                                      grid(8);
  const std::vector<std::size_t>                     row_start = {0, 0, 0};
  const std::vector<dealii::types::global_dof_index> columns;
  const std::vector<double>                          values;
  UpdatedCholesky                                    factorisation(grid.matrix, {row_start, columns, values}, {});
  factorisation.factorise();
  Vector d(2);
  d = 3.;
  factorisation.set_diagonal(d);
  factorisation.solve(grid.x, grid.rhs);
  EXPECT_LT(grid.error(), 1e-12);
}

TEST(UpdatedCholesky, what_only_the_updates_hold)
{
  // Rows that sum up to zero: constants have no energy.
  FivePointGrid grid(12);
  Vector        constant(grid.x), A_constant(grid.x);
  constant = 1.;
  grid.matrix.vmult(A_constant, constant);
  for (const double spring : {0., 1e-10})
  {
    FivePointGrid free(12);
    for (unsigned i = 0; i < free.matrix.m(); ++i)
      free.matrix.diag_element(i) += spring - A_constant(i);
    EXPECT_LT(largest_error(free.matrix, {constant}), 1e-8) << spring;
  }
}
