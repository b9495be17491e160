// A discrete problem as dense matrices with more digits than the solvers have, and a solver of its own for the inequality.
#pragma once

#include "unilateral/discretisation/assembled.h"

#include <deal.II/lac/affine_constraints.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

namespace unilateral
{
  using Real = long double;
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  using Column = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

  /// lambda >= 0, y = M lambda - q >= 0, lambda.y = 0, for a matrix with positive principal minors: block principal pivoting with single
  /// pivots where blocks gain nothing (L. F. Portugal, J. J. Judice, L. N. Vicente, Math. Comp. 63 (1994) 625-643).
  inline Column solve_complementarity(const Matrix &M, const Column &q)
  {
    const auto        N = q.size();
    std::vector<bool> active(N, false);
    Column            lambda = Column::Zero(N);
    Eigen::Index      fewest = N + 1;
    unsigned          patience = 3;
    for (unsigned step = 0; step < 100 + 20 * unsigned(N); ++step)
    {
      std::vector<Eigen::Index> set;
      for (Eigen::Index i = 0; i < N; ++i)
        if (active[i])
          set.push_back(i);
      lambda.setZero();
      if (!set.empty())
        lambda(set) = M(set, set).partialPivLu().solve(q(set)).eval();
      const Column y = M * lambda - q;
      const Real   little_pressure = 1e-15L * lambda.lpNorm<Eigen::Infinity>(), little_gap = 1e-16L * q.lpNorm<Eigen::Infinity>();
      std::vector<Eigen::Index> wrong;
      for (Eigen::Index i = 0; i < N; ++i)
        if (active[i] ? lambda(i) < -little_pressure : y(i) < -little_gap)
          wrong.push_back(i);
      if (wrong.empty())
        return lambda.cwiseMax(0);
      if (Eigen::Index(wrong.size()) < fewest)
      {
        fewest = Eigen::Index(wrong.size());
        patience = 3;
      }
      else if (patience > 0)
        --patience;
      else
        wrong = {wrong.back()};
      for (const Eigen::Index i : wrong)
        active[i] = !active[i];
    }
    throw std::runtime_error("the dense solver did not end");
  }

  /// The unknowns that nothing fixes, in their order.
  class DenseProblem
  {
  public:
    DenseProblem(const Assembled &problem, const dealii::AffineConstraints<double> &dirichlet)
    {
      const std::size_t n_all = problem.load().size(), N = problem.weights().size();
      std::vector<int>  number(n_all, -1);
      for (std::size_t j = 0; j < n_all; ++j)
        if (!dirichlet.is_constrained(j))
        {
          number[j] = int(unknowns.size());
          unknowns.push_back(j);
        }
      const auto n = Eigen::Index(unknowns.size());
      A = Matrix::Zero(n, n);
      B = Matrix::Zero(Eigen::Index(N), n);
      for (Eigen::Index row = 0; row < n; ++row)
        for (auto entry = problem.stiffness_matrix().begin(unknowns[row]); entry != problem.stiffness_matrix().end(unknowns[row]); ++entry)
          if (number[entry->column()] >= 0)
            A(row, number[entry->column()]) = entry->value();
      const ConstraintTrace &trace = problem.trace();
      for (std::size_t i = 0; i < N; ++i)
        for (std::size_t k = trace.row_start[i]; k < trace.row_start[i + 1]; ++k)
          B(Eigen::Index(i), number.at(trace.columns[k])) += trace.values[k];
      f = restricted(problem.load());
      s = at_points(problem.obstacle());
      w = at_points(problem.weights());
      compliance = at_points(problem.compliance());
      // Where a vanishes on some modes: a little stiffness against them, of which the iteration in solve() leaves nothing.
      held = A;
      modes = Matrix(n, Eigen::Index(problem.null_space().size()));
      for (Eigen::Index k = 0; k < modes.cols(); ++k)
      {
        Column mode = restricted(problem.null_space()[std::size_t(k)]);
        for (Eigen::Index l = 0; l < k; ++l)
          mode -= modes.col(l) * modes.col(l).dot(mode);
        modes.col(k) = mode.normalized();
      }
      if (modes.cols() > 0)
        held += little * A.diagonal().mean() * modes * modes.transpose();
      inverse.compute(held);
      symmetric = problem.symmetric();
      V = inverse.solve(Matrix(B.transpose() * w.asDiagonal()));
    }

    struct Solution
    {
      Column u, lambda;
    };

    /// The solution of the penalty problem, epsilon > 0, or the mixed one, epsilon = 0. Throws std::runtime_error when it does not find it.
    Solution solve(const Real epsilon) const
    {
      Solution now{Column::Zero(f.size()), Column::Zero(s.size())};
      for (unsigned step = 0; step < 100; ++step)
      {
        // With modes that nothing but contact stops: steps of the proximal method, until the contact is that of the solution.
        const Column u0 = inverse.solve(f + little * A.diagonal().mean() * modes * (modes.transpose() * now.u));
        now.lambda = symmetric ? by_dual_active_sets(u0, epsilon) : by_principal_pivots(u0, epsilon);
        now.u = u0 - V * now.lambda;
        if (modes.cols() == 0)
          return now;
        const Solution polished = with_known_contact(now, epsilon);
        const Column   passed = B * polished.u - s - epsilon * polished.lambda;
        Column         residual = A * polished.u + B.transpose() * w.cwiseProduct(polished.lambda) - f;
        residual -= modes * (modes.transpose() * residual);
        if (polished.lambda.minCoeff() >= 0 && passed.maxCoeff() <= 1e-13L * (B * polished.u).lpNorm<Eigen::Infinity>() &&
            dual_norm(residual) <= 1e-11L * energy_norm(polished.u))
          return polished;
      }
      throw std::runtime_error("the dense solver does not come to rest");
    }

    Real energy_norm(const Column &v) const { return std::sqrt(std::max<Real>(0, v.dot(A * v))); }

    /// (r'A^-1 r)^1/2, of an r that does no work on modes.
    Real dual_norm(const Column &r) const { return std::sqrt(std::abs(r.dot(inverse.solve(r)))); }

    /// (sum w tau q^2)^1/2, a norm of pressures in the unit of the energy norm.
    Real pressure_norm(const Column &q) const { return std::sqrt((w.array() * compliance.array() * q.array().square()).sum()); }

    Column restricted(const Vector &v) const
    {
      Column result(Eigen::Index(unknowns.size()));
      for (std::size_t j = 0; j < unknowns.size(); ++j)
        result(Eigen::Index(j)) = v(unknowns[j]);
      return result;
    }

    static Column at_points(const Vector &q)
    {
      Column result(Eigen::Index(q.size()));
      for (std::size_t i = 0; i < q.size(); ++i)
        result(Eigen::Index(i)) = q(i);
      return result;
    }

    Matrix A, B;
    Column f, s, w, compliance; ///< compliance: tau
    Matrix modes;               ///< an orthonormal basis of the kernel of A

  private:
    /// The same contact without the little stiffness, which costs digits: A u + B'W lambda = f, B u - epsilon lambda = s at its points.
    Solution with_known_contact(const Solution &found, const Real epsilon) const
    {
      std::vector<Eigen::Index> set;
      for (Eigen::Index i = 0; i < s.size(); ++i)
        if (found.lambda(i) > 0)
          set.push_back(i);
      const auto   n = f.size(), N = Eigen::Index(set.size());
      const Matrix b = B(set, Eigen::all);
      Matrix       K = Matrix::Zero(n + N, n + N);
      K.topLeftCorner(n, n) = A;
      K.topRightCorner(n, N) = b.transpose() * w(set).asDiagonal();
      K.bottomLeftCorner(N, n) = b;
      K.bottomRightCorner(N, N).diagonal().setConstant(-epsilon);
      Column right(n + N);
      right << f, s(set);
      const Column both = K.fullPivLu().solve(right);
      Solution     result{both.head(n), Column::Zero(s.size())};
      result.lambda(set) = both.tail(N);
      return result;
    }

    /// Point by point, the one that passes its bound farthest next; points whose rows depend on each other never have pressures together
    /// (D. Goldfarb, A. Idnani, Math. Programming 27 (1983) 1-33, in terms of the pressures alone).
    Column by_dual_active_sets(const Column &u0, const Real epsilon) const
    {
      const Matrix              G = B * V + Matrix((epsilon * Column::Ones(s.size())).asDiagonal()); // columns weighted
      Column                    lambda = Column::Zero(s.size());
      std::vector<Eigen::Index> set;
      for (unsigned step = 0; step < 100 + 20 * unsigned(s.size()); ++step)
      {
        Column       passed = B * u0 - s - G * lambda;
        const Real   little_gap = 1e-15L * (s.lpNorm<Eigen::Infinity>() + (B * u0).lpNorm<Eigen::Infinity>());
        Eigen::Index next = -1;
        Real         farthest = 0;
        for (Eigen::Index i = 0; i < s.size(); ++i)
          if (std::find(set.begin(), set.end(), i) == set.end() && passed(i) > little_gap)
            if (const Real far = passed(i) * std::sqrt(w(i) / G(i, i)); far > farthest)
            {
              farthest = far;
              next = i;
            }
        if (next < 0)
          return lambda.cwiseMax(0);
        for (bool added = false; !added;)
        {
          Column r(Eigen::Index(set.size()));
          Real   yield = G(next, next);
          if (!set.empty())
          {
            r = G(set, set).partialPivLu().solve(Column(G(set, next)));
            yield -= G(next, set).dot(r);
          }
          passed = B * u0 - s - G * lambda;
          const Real   unlimited = std::numeric_limits<Real>::infinity();
          Real         length = yield > 1e-12L * G(next, next) ? std::max<Real>(0, passed(next)) / yield : unlimited;
          Eigen::Index leaves = -1;
          for (std::size_t k = 0; k < set.size(); ++k)
            if (r(Eigen::Index(k)) > 0 && lambda(set[k]) < length * r(Eigen::Index(k)))
            {
              length = std::max<Real>(0, lambda(set[k])) / r(Eigen::Index(k));
              leaves = Eigen::Index(k);
            }
          if (length == unlimited)
            throw std::runtime_error("no function satisfies all bounds");
          for (std::size_t k = 0; k < set.size(); ++k)
            lambda(set[k]) -= length * r(Eigen::Index(k));
          lambda(next) += length;
          if (leaves < 0)
          {
            set.push_back(next);
            added = true;
          }
          else
          {
            lambda(set[std::size_t(leaves)]) = 0;
            set.erase(set.begin() + leaves);
          }
        }
      }
      throw std::runtime_error("the dense solver did not end");
    }

    /// For forms that are not symmetric, by sets of points that have felt their bound: no other has a pressure. Rows that depend on each
    /// other leave pressures undetermined: steps of the proximal method, whose limit is a solution.
    Column by_principal_pivots(const Column &u0, const Real epsilon) const
    {
      std::vector<Eigen::Index> some;
      std::vector<bool>         known(std::size_t(s.size()), false);
      Column                    lambda = Column::Zero(s.size());
      const Real                yield = epsilon > 0 ? 0 : 1e-6L;
      for (unsigned step = 0; step < 500; ++step)
      {
        const Column before = lambda;
        Column       u = u0;
        if (!some.empty())
        {
          const Matrix b = B(some, Eigen::all), v = V(Eigen::all, some);
          const Column tau = compliance(some), old = before(some);
          const Matrix M = b * v + Matrix((epsilon * Column::Ones(tau.size()) + yield * tau).asDiagonal());
          lambda(some) = solve_complementarity(M, b * u0 - s(some) + yield * tau.cwiseProduct(old));
          u -= v * lambda(some);
        }
        const Column passed = B * u - s;
        const Real   little_gap = 1e-15L * (s.lpNorm<Eigen::Infinity>() + passed.lpNorm<Eigen::Infinity>());
        const auto   n_before = some.size();
        for (Eigen::Index i = 0; i < s.size(); ++i)
          if (!known[std::size_t(i)] && passed(i) > little_gap)
          {
            known[std::size_t(i)] = true;
            some.push_back(i);
          }
        if (some.size() == n_before && (lambda - before).lpNorm<Eigen::Infinity>() <= 1e-7L * lambda.lpNorm<Eigen::Infinity>())
          return lambda;
      }
      throw std::runtime_error("the dense solver does not come to rest");
    }

    bool                                         symmetric = true;
    static constexpr Real                        little = 1e-6L;
    std::vector<dealii::types::global_dof_index> unknowns;
    Matrix                                       held, V; ///< V = A^-1 B'W
    Eigen::PartialPivLU<Matrix>                  inverse;
  };
} // namespace unilateral
