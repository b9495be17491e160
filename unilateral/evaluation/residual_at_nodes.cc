#include "unilateral/evaluation/residual_at_nodes.h"

#include "unilateral/evaluation/held_unknowns.h"
#include "unilateral/evaluation/nodal_forces.h"

#include <algorithm>
#include <cmath>

namespace unilateral
{
  namespace
  {
    /// Of the summands of a residual.
    constexpr double rounding = 1e-12;
  } // namespace

  template <int dim>
  double residual_at_nodes(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const Vector &u, const Vector &lambda)
  {
    const HeldUnknowns<dim> held(problem);
    ForcesAtUnknowns        forces = forces_at_unknowns(problem, constraint_set, u, lambda);
    const auto             &shared = problem.space.shared();
    for (Vector *const at_unknowns : {&forces.missing, &forces.diagonal, &forces.summands})
    {
      hand_over_at_ties(problem, *at_unknowns); // each to one other
      shared.add(at_unknowns->begin());
    }
    double sum = 0;
    for (std::size_t dof = 0; dof < u.size(); ++dof)
      if (shared.owns(dof) && !held.is_held[dof] && forces.diagonal(dof) > 0)
      {
        const double r = std::max(0., std::abs(forces.missing(dof)) - rounding * forces.summands(dof));
        sum += r * r / forces.diagonal(dof);
      }
    return std::sqrt(problem.space.processes().sum(sum));
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template double residual_at_nodes(const Problem<dim> &, const ConstraintSet<dim> &, const Vector &, const Vector &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
