#include "unilateral/algebra/mixed_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace unilateral
{
  namespace
  {
    /// The residual is computed anew where MINRES has reduced its own measure of it by a factor between these two.
    constexpr double reduction_before_check = 0.1, largest_reduction_before_check = 0.6;

    /// Of the residual in one run of MINRES, whose measure drifts from the residual by rounding; then it starts again from there.
    constexpr double reduction_of_one_run = 1e-5;

    constexpr unsigned most_runs = 8;

    /// Of a step of conjugate gradients with multigrid, which SolveTolerance::enough_iterations counts.
    constexpr double   reduction_by_a_step = 0.3;
    constexpr unsigned most_steps_that_count = 100;

    /// An entry of a row that several processes have.
    struct SharedEntry
    {
      unsigned      rank;     ///< whose part it is
      std::uint64_t column;   ///< by SharedUnknowns::numbers_by_owner()
      double        value;    ///< C_ij, or of what @p rank has of it
      double        diagonal; ///< T_jj
    };
  } // namespace

  MixedSolver::MixedSolver(OwnSparseRows matrix, const Vector &diagonal, SharedUnknowns shared_unknowns, SharedUnknowns shared_rows)
    : C(std::move(matrix)), unknowns(std::move(shared_unknowns)), rows(std::move(shared_rows)), S(C.size(), 1.),
      squares(diagonal.size(), 0.)
  {
    add_squares(diagonal);
  }

  /// To S and the diagonal of C'C. Of rows that several processes have they bring the entries together first: each has a part of C_ij^2.
  void MixedSolver::add_squares(const Vector &diagonal)
  {
    for (std::size_t i = 0; i < C.size(); ++i)
      for (std::size_t k = C.row_start[i]; k < C.row_start[i + 1] && !rows.shares(i); ++k)
      {
        const double square = C.values[k] * C.values[k];
        S[i] += square / diagonal(C.columns[k]);
        squares[C.columns[k]] += square;
      }
    if (unknowns.processes().alone())
      return;
    const unsigned                                own_rank = unknowns.processes().rank();
    const std::vector<std::uint64_t>              number = unknowns.numbers_by_owner(squares.size());
    std::vector<std::pair<unsigned, SharedEntry>> entries;
    for (const auto i : rows.all())
      for (std::size_t k = C.row_start[i]; k < C.row_start[i + 1]; ++k)
        entries.push_back({i, {own_rank, number[C.columns[k]], C.values[k], diagonal(C.columns[k])}});
    rows.share(entries);
    // By row and column; the same sums on all processes.
    std::stable_sort(entries.begin(), entries.end(),
                     [](const auto &a, const auto &b)
                     { return std::pair(a.first, a.second.column) < std::pair(b.first, b.second.column); });
    std::map<std::uint64_t, std::uint32_t> own_columns;
    for (const auto i : rows.all())
      for (std::size_t k = C.row_start[i]; k < C.row_start[i + 1]; ++k)
        own_columns[number[C.columns[k]]] = C.columns[k];
    for (std::size_t begin = 0, end = 0; begin < entries.size(); begin = end)
    {
      const auto &[row, first] = entries[begin];
      double value = 0;
      for (; end < entries.size() && entries[end].first == row && entries[end].second.column == first.column; ++end)
        value += entries[end].second.value;
      S[row] += value * value / first.diagonal;
      if (first.rank == own_rank) // the lowest that has a part of the entry
        squares[own_columns.at(first.column)] += value * value;
    }
    unknowns.add(squares.data());
  }

  void MixedSolver::multiply(Vector &p, const Vector &x) const
  {
    const double *const x_of = x.begin();
    double *const       p_of = p.begin();
    for (std::size_t i = 0; i < C.size(); ++i)
    {
      double sum = 0;
      for (std::size_t k = C.row_start[i]; k < C.row_start[i + 1]; ++k)
        sum += C.values[k] * x_of[C.columns[k]];
      p_of[i] = sum;
    }
    rows.add(p_of);
  }

  void MixedSolver::add_transposed_product(Vector &y, const double factor, const Vector &p) const
  {
    Vector              own(unknowns.empty() ? 0 : y.size()); // the others' parts come to it
    double *const       y_of = unknowns.empty() ? y.begin() : own.begin();
    const double *const p_of = p.begin();
    for (std::size_t i = 0; i < C.size(); ++i)
    {
      const double weight = factor * p_of[i];
      for (std::size_t k = C.row_start[i]; k < C.row_start[i + 1]; ++k)
        y_of[C.columns[k]] += weight * C.values[k];
    }
    if (unknowns.empty())
      return;
    unknowns.add(own.begin());
    y += own;
  }

  void MixedSolver::add_product(Vector &y, const Vector &x) const
  {
    Vector p(C.size());
    multiply(p, x);
    add_transposed_product(y, 1, p);
  }

  void MixedSolver::add_to_diagonal(Vector &diagonal) const
  {
    for (std::size_t j = 0; j < squares.size(); ++j)
      diagonal(j) += squares[j];
  }

  /// Lets conjugate gradients for T alone meet the smallest Ritz value of P^-1 T that the residual @p r has a part in.
  void MixedSolver::learn_spectrum(const LinearMap &T, const LinearMap &precondition, const Vector &r)
  {
    constexpr double    accuracy = 0.1;
    constexpr unsigned  most_steps = 20;
    Vector              x(r.size());
    const ScalarProduct scalar_product = [this](const Vector &a, const Vector &b) { return product(a, b); };
    conjugate_gradients.solve(T, precondition, r, scalar_product, {0, accuracy}, most_steps, x);
  }

  LinearSolve MixedSolver::solve(const LinearMap      &T,
                                 const LinearMap      &precondition,
                                 const Vector         &b,
                                 const SolveTolerance &tolerance,
                                 const unsigned        max_iterations,
                                 Vector               &x)
  {
    const double relative =
      std::max(tolerance.relative,
               tolerance.enough_iterations < most_steps_that_count ? std::pow(reduction_by_a_step, tolerance.enough_iterations) : 0.);
    LinearSolve result;
    BlockVector rest(2), change(2);
    rest.block(0).reinit(b.size());
    rest.block(1).reinit(C.size());
    rest.collect_sizes();
    change.reinit(rest);
    Vector p(C.size()), z(b.size()), x_now(x), p_now;
    multiply(p, x);
    p_now = p;

    // r and q of (x_now, p_now), and the bound of its error.
    const auto evaluate = [&]
    {
      Vector &r = rest.block(0), &q = rest.block(1);
      T(r, x_now);
      r.sadd(-1, 1, b);
      add_transposed_product(r, -1, p_now);
      multiply(q, x_now);
      q.sadd(-1, 1, p_now);
      precondition(z, r);
      result.residual =
        std::sqrt(std::max(0., product(r, z)) / conjugate_gradients.smallest_ritz_value_met()) + std::sqrt(product_of_rows(q, q));
    };
    evaluate();
    const Vector residual_at_start(rest.block(0)), x_at_start(x); // of T + C'C: q = 0
    double       goal = tolerance.absolute;

    const BlockLinearMap K = [&](BlockVector &y, const BlockVector &of)
    {
      T(y.block(0), of.block(0));
      add_transposed_product(y.block(0), 1, of.block(1));
      multiply(y.block(1), of.block(0));
      y.block(1) -= of.block(1);
    };
    const BlockLinearMap precondition_both = [&](BlockVector &y, const BlockVector &of)
    {
      precondition(y.block(0), of.block(0));
      for (std::size_t i = 0; i < S.size(); ++i)
        y.block(1)(i) = of.block(1)(i) / S[i];
    };
    const BlockScalarProduct product_of_both = [this](const BlockVector &a, const BlockVector &b)
    { return product(a.block(0), b.block(0)) + product_of_rows(a.block(1), b.block(1)); };
    for (unsigned run = 0; run < most_runs && result.residual > goal && result.failure.empty(); ++run)
    {
      double     end_of_run = -1, next_check = -1;
      const auto is_enough = [&](const BlockVector &of, const double norm)
      {
        if (end_of_run < 0)
        {
          end_of_run = reduction_of_one_run * norm;
          next_check = reduction_before_check * norm;
        }
        if (norm > next_check)
          return false;
        x_now = x;
        x_now += of.block(0);
        p_now = p;
        p_now += of.block(1);
        evaluate();
        z = x_now;
        z -= x_at_start;
        goal = std::max(tolerance.absolute, relative * std::sqrt(std::abs(product(residual_at_start, z))));
        next_check = norm * std::clamp(0.7 * goal / result.residual, reduction_before_check, largest_reduction_before_check);
        return result.residual <= goal || norm <= end_of_run;
      };
      const LinearSolve of_run = minres(K, precondition_both, rest, product_of_both, is_enough, max_iterations - result.iterations, change);
      result.iterations += of_run.iterations;
      result.failure = of_run.failure;
      x = x_now;
      p = p_now;
      if (result.residual > goal)
        continue;
      learn_spectrum(T, precondition, rest.block(0));
      evaluate();
    }
    if (result.residual > goal && result.failure.empty())
      result.failure = fmt::format("minimal residuals came to rest at a residual of {:.1e}", result.residual);
    result.converged = result.failure.empty();
    return result;
  }
} // namespace unilateral
