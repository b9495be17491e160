// Contact piece by piece: its force, and how much of it is concentrated at points and along lines.
#pragma once

#include "unilateral/discretisation/problem.h"
#include "unilateral/evaluation/run_result.h"
#include "unilateral/inequality/discrete_problem.h"

#include <vector>

namespace unilateral
{
  /// The connected pieces of contact (see contact_pieces.h), from left to right.
  ///
  /// The force of a piece of a beam or plate is the integral of a pressure p over the region D of contact and a force that is concentrated
  /// at the ends or along the edge of D. At the points that force is spread over some layers, inwards in waves that die out, and D is known
  /// to within a cell; but integrals of the discrete pressure against smooth functions are right. So
  ///
  ///     delta = h sqrt(n)   n cells of size h span the width of the piece: many cells, yet little of the width as h -> 0
  ///     p      at depths beyond delta the discrete pressure, up to the edge the polynomial of degree 0, 1 or 2 (as the number of points
  ///            allows) that is closest to it inside, in the mean weighted with (depth - delta)^2, where the waves cancel
  ///     chi    share of contact in a ball of radius delta: weights w_j max(0, 1 - |x_j - x|^2/delta^2)^((3-dim)/2), the projection of a
  ///            ball in space, which a straight edge at the distance d inside x cuts to 2 chi - 1 = (3 d/delta - (d/delta)^3)/2
  ///     d      the root of that, 2 delta sin(arcsin(2 chi - 1)/3), and to first order in the curvature of the edge
  ///            d + 3/2 c (1 - d^2/delta^2), c L = sum w (1 + d/delta)/2 - A
  ///     A, L   area sum w of the points in contact, and length 35/(9 delta) sum w chi (1 - chi) of its edge
  ///     R, T   sum r and sum r d of what p leaves of the force at the points, r = w (lambda - p)
  ///
  /// The true edge lies at d = t, where the concentrated force has the moment that is left: (R + p L t) t = T + p L t^2/2, and
  ///
  ///     distributed = sum w p - p L t,   concentrated = force - distributed = R + p L t
  ///
  /// The error falls with h or faster where p is smooth. A piece without points inside is concentrated altogether: whether it is a point,
  /// a line or a small region only a finer mesh can tell. Below a width of seven points (`resolved` = false) the split is a guess. The
  /// penalty method smears concentrated forces over a length of epsilon^(1/4): on a mesh much finer than that the split means little.
  template <int dim>
  std::vector<ContactComponent>
  contact_components(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, std::size_t block, const Vector &lambda);
} // namespace unilateral
