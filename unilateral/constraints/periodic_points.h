// Points of I_G on periodic parts: those on the second part are those on the first.
#pragma once

#include "unilateral/constraints/constraint_set.h"
#include "unilateral/spaces/periodic_nodes.h"

namespace unilateral
{
  /// Takes the points of @p set whose unknowns are all images out, where the point by their originals is there: it gets their weight, so
  /// that I_G(v) stays what it is for periodic v. Of the two bounds, the image's less the jump, the tighter one stays. Directions of a body
  /// that differ by less than 60 degrees at a node make their mean, weighted with area.
  template <int dim>
  void merge_periodic_points(ConstraintSet<dim> &set, const PeriodicNodes<dim> &periodic);
} // namespace unilateral
