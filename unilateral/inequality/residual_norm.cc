#include "unilateral/inequality/residual_norm.h"

#include "unilateral/algebra/dense_solvers.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace unilateral
{
  ResidualNorm::ResidualNorm(DiscreteProblem &problem, const double shift, const Vector &lambda)
    : problem(problem), n_modes(problem.null_space().size())
  {
    problem.initialize_point_vector(support_stiffness);
    if (n_modes == 0)
      return;
    for (const Vector &mode : problem.null_space())
    {
      problem.initialize_point_vector(traces.emplace_back());
      problem.apply_trace(traces.back(), mode);
    }
    choose_supports(shift, lambda);
  }

  /// By their shares of the contact force.
  void ResidualNorm::choose_supports(const double shift, const Vector &lambda)
  {
    const std::size_t n_points = lambda.locally_owned_size();
    Eigen::MatrixXd   shares(n_modes, n_points);
    for (std::size_t k = 0; k < n_modes; ++k)
      for (std::size_t i = 0; i < n_points; ++i)
        shares(k, i) = traces[k](i) * problem.weights()(i) * lambda(i);
    supports = choose_support_points(problem, std::move(shares), n_modes, 1e-8);
    work_of_supports = Eigen::MatrixXd::Zero(n_modes, supports.size());
    for (std::size_t s = 0; s < supports.size(); ++s)
      for (const std::size_t i : supports[s].places)
      {
        support_stiffness(i) = problem.weights()(i) / (shift * problem.compliance()(i));
        for (std::size_t k = 0; k < n_modes && problem.owns_point(i); ++k)
          work_of_supports(k, s) = traces[k](i) * problem.weights()(i);
      }
    problem.processes().sum(work_of_supports.data(), work_of_supports.size());
    available = supports.size() == n_modes;
  }

  bool ResidualNorm::balance(Vector &lambda, Vector &r) const
  {
    if (n_modes == 0)
      return true;
    Eigen::VectorXd excess(n_modes);
    for (unsigned repetition = 0; repetition < 2; ++repetition) // once more for the rounding of the first
    {
      for (std::size_t k = 0; k < n_modes; ++k)
        excess(k) = problem.dot(problem.null_space()[k], r);
      const Eigen::VectorXd change = work_of_supports.fullPivLu().solve(-excess);
      Vector                at_points, BtW_change;
      problem.initialize_point_vector(at_points);
      problem.initialize_dof_vector(BtW_change);
      bool negative = false;
      for (std::size_t s = 0; s < n_modes; ++s)
        for (const std::size_t i : supports[s].places)
        {
          at_points(i) = change(s);
          lambda(i) += change(s);
          negative |= !(lambda(i) >= 0);
        }
      if (problem.processes().any(negative))
        return false;
      problem.apply_trace_transpose(BtW_change, at_points);
      r += BtW_change;
    }
    return true;
  }

  bool ResidualNorm::operator()(const Vector &r, double &norm)
  {
    norm = 0;
    if (problem.largest(r) == 0)
      return true;
    Vector z, Tz, trace;
    problem.initialize_dof_vector(z);
    problem.initialize_dof_vector(Tz);
    const LinearSolve solve = problem.solve_tangent(support_stiffness, r, {0, 1e-2}, z);
    problem.apply_stiffness(Tz, z);
    double on_supports = 0;
    if (n_modes > 0)
    {
      problem.initialize_point_vector(trace);
      problem.apply_trace(trace, z);
      on_supports = problem.sum_over_points([&](const std::size_t i) { return support_stiffness(i) * trace(i) * trace(i); });
    }
    // r'T^-1 r = 2 r'z - z'Tz + rest, rest >= 0 of second order in the residual of the solve.
    norm = 1.05 * std::sqrt(std::max(0., 2 * problem.dot(r, z) - problem.dot(z, Tz) - on_supports)) + solve.residual;
    return solve.converged && std::isfinite(norm);
  }
} // namespace unilateral
