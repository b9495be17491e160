#include "unilateral/inequality/round_off.h"

#include <cmath>
#include <limits>
#include <random>

namespace unilateral
{
  namespace
  {
    constexpr double half_last_digit = std::numeric_limits<double>::epsilon() / 2;

    /// +1 or -1 at random, the same on all processes that have the unknown.
    Vector random_signs(const DiscreteProblem &problem, std::mt19937 &random)
    {
      Vector signs;
      problem.initialize_dof_vector(signs);
      for (std::size_t j = 0; j < signs.locally_owned_size(); ++j)
        signs(j) = random() % 2 ? 1. : -1.;
      if (!problem.processes().alone())
        problem.shared().add(signs.begin());
      for (std::size_t j = 0; j < signs.locally_owned_size(); ++j)
        signs(j) = signs(j) < 0 ? -1. : 1.;
      return signs;
    }
  } // namespace

  Vector residual_round_off(const DiscreteProblem &problem, const Vector &u, const Vector &lambda, const bool alike)
  {
    std::mt19937 random(1980);
    Vector       sizes, terms;
    problem.initialize_dof_vector(sizes);
    problem.initialize_dof_vector(terms);
    for (unsigned k = 0; k < 4; ++k)
    {
      Vector turned = random_signs(problem, random);
      turned.scale(u);
      problem.apply_stiffness(terms, turned);
      for (std::size_t j = 0; j < sizes.locally_owned_size(); ++j)
        sizes(j) += 0.5 * std::abs(terms(j));
    }
    problem.apply_trace_transpose(terms, lambda);
    const Vector &load = problem.load();
    for (std::size_t j = 0; j < sizes.locally_owned_size(); ++j)
      sizes(j) = half_last_digit * (sizes(j) + std::abs(terms(j)) + std::abs(load(j)));
    if (!alike)
      sizes.scale(random_signs(problem, random));
    return sizes;
  }

  double smallest_round_off(const DiscreteProblem &problem, const Vector &u, const Vector &Au, const Vector &lambda)
  {
    Vector force;
    problem.initialize_dof_vector(force);
    problem.apply_trace_transpose(force, lambda);
    const double *const f = problem.load().begin(), *const a = problem.stiffness_diagonal().begin();
    return half_last_digit * std::sqrt(problem.sum_over_unknowns(
                               [&](const std::size_t j)
                               {
                                 const double terms = std::abs(f[j]) + std::abs(Au.begin()[j]) + std::abs(force.begin()[j]) +
                                                      2 * a[j] * std::abs(u.begin()[j]);
                                 return terms * terms / a[j];
                               }));
  }

  double energy_round_off(const DiscreteProblem &problem, const Vector &d)
  {
    const double *const a = problem.stiffness_diagonal().begin(), *const values = d.begin();
    return std::sqrt(8 * half_last_digit *
                     problem.sum_over_unknowns([&](const std::size_t j) { return 2 * a[j] * values[j] * values[j]; }));
  }

  double bound_round_off(const DiscreteProblem &problem, const std::vector<bool> &decides, const double excess)
  {
    constexpr double coupling = 4;
    const double     stiffness =
      problem.sum_over_points([&](const std::size_t i) { return decides[i] ? problem.weights()(i) / problem.compliance()(i) : 0.; });
    return 2 * std::sqrt(coupling * stiffness) * excess;
  }
} // namespace unilateral
