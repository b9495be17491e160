#include "unilateral/inequality/residual_norm.h"

#include "unilateral/algebra/dense_solvers.h"

#include <algorithm>
#include <cmath>

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

  /// Greedy: the point whose trace is the largest outside the span of those before, by its share of the contact force.
  void ResidualNorm::choose_supports(const double shift, const Vector &lambda)
  {
    Eigen::MatrixXd rest(n_modes, lambda.size());
    for (std::size_t k = 0; k < n_modes; ++k)
      for (std::size_t i = 0; i < lambda.size(); ++i)
        rest(k, i) = traces[k](i) * problem.weights()(i) * lambda(i);
    const double largest = lambda.size() > 0 ? rest.colwise().norm().maxCoeff() : 0;
    for (std::size_t k = 0; k < n_modes; ++k)
    {
      Eigen::Index i = 0;
      if (lambda.size() == 0 || rest.colwise().norm().maxCoeff(&i) <= 1e-8 * largest)
        return;
      const Eigen::VectorXd direction = rest.col(i).normalized();
      rest -= direction * (direction.transpose() * rest).eval();
      supports.push_back(i);
      support_stiffness(i) = problem.weights()(i) / (shift * problem.compliance()(i));
    }
    available = true;
  }

  bool ResidualNorm::balance(Vector &lambda, Vector &r) const
  {
    if (n_modes == 0)
      return true;
    Eigen::MatrixXd work(n_modes, n_modes);
    Eigen::VectorXd excess(n_modes);
    for (unsigned repetition = 0; repetition < 2; ++repetition) // once more for the rounding of the first
    {
      for (std::size_t k = 0; k < n_modes; ++k)
      {
        excess(k) = problem.dot(problem.null_space()[k], r);
        for (std::size_t i = 0; i < n_modes; ++i)
          work(k, i) = traces[k](supports[i]) * problem.weights()(supports[i]);
      }
      const Eigen::VectorXd change = work.fullPivLu().solve(-excess);
      Vector                at_points, BtW_change;
      problem.initialize_point_vector(at_points);
      problem.initialize_dof_vector(BtW_change);
      for (std::size_t i = 0; i < n_modes; ++i)
      {
        at_points(supports[i]) = change(i);
        lambda(supports[i]) += change(i);
        if (!(lambda(supports[i]) >= 0))
          return false;
      }
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
      for (const std::size_t i : supports)
        on_supports += support_stiffness(i) * trace(i) * trace(i);
    }
    // r'T^-1 r = 2 r'z - z'Tz + rest, rest >= 0 of second order in the residual of the solve.
    norm = 1.05 * std::sqrt(std::max(0., 2 * problem.dot(r, z) - problem.dot(z, Tz) - on_supports)) + solve.residual;
    return solve.converged && std::isfinite(norm);
  }
} // namespace unilateral
