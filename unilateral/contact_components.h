// Contact piece by piece: its force, and how much of it is concentrated at single points.
#pragma once

#include "unilateral/discrete_problem.h"
#include "unilateral/problem.h"
#include "unilateral/results.h"

#include <vector>

namespace unilateral
{
  /// The connected pieces of the points of a block with a positive pressure, neighbours being the points of one cell, from left to right.
  ///
  /// Beams and plates touch with forces at single points and along lines, next to a pressure that is spread out. Behind such a force the
  /// discrete pressure oscillates for a point or two and may vanish at one, which then counts as in contact: what counts as spread out is
  /// the pressure three points inside the rim and deeper, continued to the rim, whose points bear half of their weight, int p over the
  /// piece. The rest of the force is concentrated. A piece without inner points is concentrated altogether: whether it is a point or a
  /// short interval only a finer mesh can tell.
  template <int dim>
  std::vector<ContactComponent>
  contact_components(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, std::size_t block, const Vector &lambda);
} // namespace unilateral
