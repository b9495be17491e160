// What the rules of cells miss of a stiffness that varies within them.
#pragma once

#include "unilateral/algebra/vector.h"
#include "unilateral/discretisation/problem.h"

#include <vector>

namespace unilateral
{
  /// By how much two rules differ on a cell for a coefficient c > 0 and for 1/c, relative to their integrals: @p coarse, values at the
  /// points of one with @p weights, and the same of a finer one. A jump that only @p corners, points next to the corners of the cell, see
  /// counts as if a twentieth of the cell lay beyond it; a coefficient that varies as much between the points as beyond them has no jump.
  double unseen_share(const std::vector<double> &coarse,
                      const std::vector<double> &weights,
                      const std::vector<double> &fine,
                      const std::vector<double> &fine_weights,
                      const std::vector<double> &corners);

  /// Adds to @p cell_squares, by active cell, delta |u|_K^2 where the share delta of the stiffness that the rules miss is more than 1e-8,
  /// |u|_K^2 the energy of the cell as they see it, or, if it is more, that of the flux through the cell: where a cell is stiff but for a
  /// part of it, u hardly varies on it, and that part has nearly all of the energy. That flux is, in each component, the least mean over
  /// the cell and those that share a face with it, since along a jump of the stiffness the flux jumps, too. An error of that size, to its
  /// order, as where the stiffness jumps inside a cell. Returns the root of the sum over all processes, 0 where the rules resolve the
  /// stiffness. Forms of order 2 in space; @p u with its prescribed values. Collective.
  template <int dim>
  double add_unresolved_stiffness(const Problem<dim> &problem, const Vector &u, std::vector<double> &cell_squares);
} // namespace unilateral
