// What makes a solution other than it seems, said beside it.
#pragma once

#include "unilateral/base/diagnostics.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/evaluation/faceted_surface.h"
#include "unilateral/evaluation/run_result.h"
#include "unilateral/inequality/discrete_problem.h"

namespace unilateral
{
  /// Warnings about a solution on the finest mesh that an algebraic residual does not see, each with a remedy:
  ///  - strains or rotations of a body that are not small, |grad u| > 0.5 in more than 1 % of its volume;
  ///  - active contact points beside points of the part that do not meet the obstacle;
  ///  - contact at nodes whose values are fixed, where no pressure can act, if the force that is missing is more than 5 %;
  ///  - facets that stand for a curved surface and change the pressure by more than a quarter, see FacetedSurface;
  ///  - values of [boundary] that were dropped because others contradict them;
  ///  - functionals that are not finite.
  /// @p u with its prescribed values. @p coarse: the faces before the first refinement.
  template <int dim>
  void warn_about_result(const RunResult           &result,
                         const Problem<dim>        &problem,
                         const ConstraintSet<dim>  &constraint_set,
                         const FacetedSurface<dim> &coarse,
                         const Vector              &u,
                         const Vector              &lambda,
                         Diagnostics               &diagnostics);
} // namespace unilateral
