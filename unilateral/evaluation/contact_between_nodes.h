// Where a beam or a plate touches its bound between nodes that share the force.
#pragma once

#include "unilateral/algebra/vector.h"
#include "unilateral/discretisation/problem.h"

#include <vector>

namespace unilateral
{
  /// Adds to @p cell_squares, by active cell, what it makes of the energy that contact ends between nodes. On the edge of contact the force
  /// of a beam or plate is concentrated, at a place between nodes, and the moment there is larger than that of u_h by a triangle whose base
  /// is the distance h of the nodes.
  ///
  /// Beams: m^2 h/(3 EI), m = h F_1 F_2/(F_1 + F_2), in cells whose ends bear the forces F_1 and F_2, less what is distributed, at ends of
  /// contact or where it is one point: that triangle lies under the resultant. Plates: F^2 h^2/(90 D), h^2 the area, in cells with points
  /// in contact and others, which share the forces F of those. That is the mean over all places t h of the edge, m = f h t (1 - t) per
  /// length, f = F/h.
  ///
  /// Zero for forms of lower order, and rules with points that are no nodes. Returns the root of the sum over all processes. Collective.
  template <int dim>
  double add_contact_between_nodes(const Problem<dim>       &problem,
                                   const ConstraintSet<dim> &constraint_set,
                                   const Vector             &lambda,
                                   std::vector<double>      &cell_squares);
} // namespace unilateral
