#include "unilateral/inequality/balanced_pressure.h"

#include "unilateral/inequality/solution_check.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace unilateral
{
  namespace
  {
    /// Relative to the best held mode, a mode that contact does not stop.
    constexpr double not_held = 1e-8;
  } // namespace

  double restore_balance(const DiscreteProblem &problem, const double largest_change, const Vector &u, Vector &lambda)
  {
    const std::vector<Vector> &modes = problem.null_space();
    if (modes.empty())
      return 0;

    // In modes of equal work under contact, G_kl = sum_i w_i lambda_i c_k(i) c_l(i) with c_k = B z_k.
    const int           n = int(modes.size());
    std::vector<Vector> traces(n);
    Vector              contact;
    problem.initialize_dof_vector(contact);
    problem.apply_trace_transpose(contact, lambda);
    const double *const w = problem.weights().begin(), *const pressure = lambda.begin();
    Eigen::MatrixXd G(n, n);
    Eigen::VectorXd excess(n), scale(n);
    for (int k = 0; k < n; ++k)
    {
      problem.initialize_point_vector(traces[k]);
      problem.apply_trace(traces[k], modes[k]);
      excess(k) = problem.dot(modes[k], problem.load()) - problem.dot(modes[k], contact);
      for (int l = 0; l <= k; ++l)
        G(k, l) = G(l, k) =
          problem.sum_over_points([&](const std::size_t i) { return w[i] * pressure[i] * traces[k].begin()[i] * traces[l].begin()[i]; });
      scale(k) = G(k, k) > 0 ? 1 / std::sqrt(G(k, k)) : 0.;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of_contact(scale.asDiagonal() * G * scale.asDiagonal());
    const Eigen::VectorXd                               &values = of_contact.eigenvalues();
    const Eigen::VectorXd inverse = (values.array() > not_held * values(n - 1)).select(values.cwiseInverse(), 0.);
    const Eigen::VectorXd y =
      scale.asDiagonal() *
      (of_contact.eigenvectors() * (inverse.asDiagonal() * (of_contact.eigenvectors().transpose() * (scale.asDiagonal() * excess))));

    Vector change;
    problem.initialize_point_vector(change);
    for (int k = 0; k < n; ++k)
      for (std::size_t i = 0; i < change.locally_owned_size(); ++i)
        change.begin()[i] += y(k) * traces[k].begin()[i];
    for (std::size_t i = 0; i < change.locally_owned_size(); ++i)
      change.begin()[i] *= pressure[i] > 0;
    const double largest = problem.largest(change);
    if (!(largest <= largest_change))
      return 0;
    Vector balanced(lambda);
    for (std::size_t i = 0; i < change.locally_owned_size(); ++i)
      balanced.begin()[i] *= 1 + change.begin()[i];
    if (!(imbalance_of_rigid_body_modes(problem, u, balanced) < imbalance_of_rigid_body_modes(problem, u, lambda)))
      return 0;
    lambda.swap(balanced);
    return largest;
  }

  double
  round_off_of_pressure(const DiscreteProblem &problem, const double epsilon, const Vector &shift, const Vector &u, const Vector &lambda)
  {
    constexpr double of_sums_and_solves = 100, most = 1e-3;
    Vector           trace;
    problem.initialize_point_vector(trace);
    problem.apply_trace_to_sizes(trace, u);
    const double *const sizes = trace.begin(), *const s = problem.obstacle().begin(), *const w = problem.weights().begin(),
                        *const r = shift.begin(), *const pressure = lambda.begin();
    const double magnified = problem.sum_over_points(
      [&](const std::size_t i) { return pressure[i] > 0 ? w[i] * (sizes[i] + std::abs(s[i])) / (epsilon + r[i]) : 0.; });
    const double force = problem.sum_over_points([&](const std::size_t i) { return w[i] * pressure[i]; });
    return force > 0 ? std::min(most, of_sums_and_solves * std::numeric_limits<double>::epsilon() * magnified / force) : 0.;
  }
} // namespace unilateral
