#include "unilateral/inequality/solution_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  namespace
  {
    /// J(u) is a difference of numbers this much larger than its rounding.
    constexpr double negligible_energy = 1e-6;
  } // namespace

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
    // Internal forces do no work on a mode of the null space but that of rounding, which would count for stiff bodies.
    const bool springs = problem.rigid_body_modes().size() > problem.null_space().size();
    double     worst = 0;
    for (const Vector &mode : problem.rigid_body_modes())
    {
      const double work = problem.dot(mode, f) - problem.dot(mode, contact) - (springs ? problem.dot(mode, Au) : 0.);
      worst = std::max(worst, std::abs(work) / std::max(problem.largest(mode), 1e-300));
    }
    return size > 0 ? worst / size : 0.;
  }

  std::string
  objection_to_solution(const DiscreteProblem &problem, const double epsilon, const double tolerance, const Vector &u, const Vector &lambda)
  {
    if (!problem.symmetric())
      return "";
    if (const double imbalance = imbalance_of_rigid_body_modes(problem, u, lambda); !(imbalance <= tolerance))
      return fmt::format("not in equilibrium: load and contact forces are out of balance by {:.1e}", imbalance);

    const double *const s = problem.obstacle().begin();
    bool                zero_is_feasible = true;
    for (std::size_t i = 0; i < problem.obstacle().locally_owned_size(); ++i)
      zero_is_feasible &= s[i] >= 0;
    if (problem.processes().any(!zero_is_feasible))
      return "";
    Vector Au;
    problem.initialize_dof_vector(Au);
    problem.apply_stiffness(Au, u);
    const double uAu = problem.dot(u, Au), fu = problem.dot(problem.load(), u);
    const double of_penalty =
      epsilon *
      problem.sum_over_points([&](const std::size_t i) { return problem.weights().begin()[i] * lambda.begin()[i] * lambda.begin()[i]; });
    const double energy = 0.5 * uAu - fu + 0.5 * of_penalty;
    if (!(energy <= negligible_energy * (std::abs(uAu) + std::abs(fu) + of_penalty)))
      return fmt::format("not a solution: its energy {:.3e} is above 0, that of u = 0, which keeps the bounds", energy);
    return "";
  }
} // namespace unilateral
