#include "unilateral/inequality/solution_check.h"

#include "unilateral/inequality/round_off.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace unilateral
{
  namespace
  {
    /// J(u) is a difference of numbers this much larger than its rounding.
    constexpr double negligible_energy = 1e-6;

    /// Of the forces, what their imbalance may owe to rounding.
    constexpr double largest_rounding = 1e-4;

    bool zero_keeps_bounds(const DiscreteProblem &problem)
    {
      const double *const s = problem.obstacle().begin();
      bool                keeps = true;
      for (std::size_t i = 0; i < problem.obstacle().locally_owned_size(); ++i)
        keeps &= s[i] >= 0;
      return !problem.processes().any(!keeps);
    }

    /// Of functions that are nothing but rounding beside the bounds: 1e-12 times the least distance between zero and one of them that it
    /// does not touch, at single nodes.
    double energy_of_nothing(const DiscreteProblem &problem)
    {
      const double *const s = problem.obstacle().begin();
      double              least = std::numeric_limits<double>::max();
      for (std::size_t i = 0; i < problem.obstacle().locally_owned_size(); ++i)
        if (s[i] > 0)
          least = std::min(least, s[i]);
      least = problem.processes().min(least);
      if (least == std::numeric_limits<double>::max())
        return 0;
      return std::pow(1e-12 * least, 2) *
             problem.sum_over_unknowns([&](const std::size_t j) { return problem.stiffness_diagonal().begin()[j]; });
    }

    double elastic_energy(const DiscreteProblem &problem, const Vector &u)
    {
      Vector Au;
      problem.initialize_dof_vector(Au);
      problem.apply_stiffness(Au, u);
      return 0.5 * problem.dot(u, Au);
    }
  } // namespace

  bool zero_is_a_better_guess(const DiscreteProblem &problem, const Vector &u)
  {
    return problem.symmetric() && zero_keeps_bounds(problem) && elastic_energy(problem, u) > problem.dot(problem.load(), u);
  }

  double imbalance_of_rigid_body_modes(const DiscreteProblem &problem, const Vector &u, const Vector &lambda)
  {
    if (problem.rigid_body_modes().empty())
      return 0;
    Vector Au, contact;
    problem.initialize_dof_vector(Au);
    problem.initialize_dof_vector(contact);
    problem.apply_stiffness(Au, u);
    problem.apply_trace_transpose(contact, lambda);
    const Vector &f = problem.load();
    const double  load_size = problem.sum_over_unknowns([&](const std::size_t j) { return std::abs(f.begin()[j]); });
    const double  contact_size = problem.sum_over_unknowns([&](const std::size_t j) { return std::abs(contact.begin()[j]); });
    const double  size = std::max(load_size, contact_size);
    // Internal forces do no work on such a mode but that of rounding, which would count for stiff bodies; springs do.
    const bool   springs = problem.rigid_body_modes().size() > problem.null_space().size();
    const Vector rounding = springs ? residual_round_off(problem, u, lambda, /*alike=*/true) : Vector();
    double       worst = 0;
    for (const Vector &mode : problem.rigid_body_modes())
    {
      double work = std::abs(problem.dot(mode, f) - problem.dot(mode, contact) - (springs ? problem.dot(mode, Au) : 0.));
      if (springs)
        work -= std::min(largest_rounding * size,
                         problem.sum_over_unknowns([&](const std::size_t j) { return std::abs(mode.begin()[j]) * rounding.begin()[j]; }));
      worst = std::max(worst, work / std::max(problem.largest(mode), 1e-300));
    }
    return size > 0 ? worst / size : 0.;
  }

  double imbalance_with_supports(const DiscreteProblem &problem, const std::vector<Vector> &modes, const Vector &u, const Vector &lambda)
  {
    Vector residual, contact;
    problem.initialize_dof_vector(residual);
    problem.initialize_dof_vector(contact);
    problem.apply_stiffness(residual, u);
    problem.apply_trace_transpose(contact, lambda);
    const Vector &f = problem.load();
    const double  size = problem.sum_over_unknowns([&](const std::size_t j) { return std::abs(contact.begin()[j]); });
    residual += contact;
    residual -= f;
    double worst = 0;
    for (const Vector &mode : modes)
      worst = std::max(worst, std::abs(problem.dot(mode, residual)) / std::max(problem.largest(mode), 1e-300));
    return worst > 0 ? worst / size : 0.;
  }

  std::string
  objection_to_solution(const DiscreteProblem &problem, const double epsilon, const double tolerance, const Vector &u, const Vector &lambda)
  {
    if (!problem.symmetric())
      return "";
    if (const double imbalance = imbalance_of_rigid_body_modes(problem, u, lambda); !(imbalance <= tolerance))
      return fmt::format("not in equilibrium: load and contact forces are out of balance by {:.1e}", imbalance);

    if (!zero_keeps_bounds(problem))
      return "";
    const double elastic = elastic_energy(problem, u), fu = problem.dot(problem.load(), u);
    const double of_penalty =
      epsilon *
      problem.sum_over_points([&](const std::size_t i) { return problem.weights().begin()[i] * lambda.begin()[i] * lambda.begin()[i]; });
    const double energy = elastic - fu + 0.5 * of_penalty;
    // A u and f'u may be nothing but what is left of terms that cancel, where a body is moved as a whole or loads meet their reactions.
    const double terms_of_fu =
      problem.sum_over_unknowns([&](const std::size_t j) { return std::abs(problem.load().begin()[j] * u.begin()[j]); });
    const double of_single_nodes = problem.sum_over_unknowns(
      [&](const std::size_t j) { return std::pow(problem.load().begin()[j], 2) / problem.stiffness_diagonal().begin()[j]; });
    const double rounding = std::min(std::pow(energy_round_off(problem, u), 2) + 1e-15 * terms_of_fu, negligible_energy * of_single_nodes);
    if (!(energy <= negligible_energy * (2 * std::abs(elastic) + std::abs(fu) + of_penalty) + rounding + energy_of_nothing(problem)))
      return fmt::format("not a solution: its energy {:.3e} is above 0, that of u = 0, which keeps the bounds", energy);
    return "";
  }
} // namespace unilateral
