// Cells in which a bound may be beyond u between their nodes; most are ruled out many at a time.
#pragma once

#include "unilateral/algebra/vector.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/functions/field_function.h"

#include <deal.II/dofs/dof_handler.h>

#include <vector>

namespace unilateral
{
  /// The active cells, in their order, in which D = s - u of a lower bound s of u, or u - s of an upper one, may be more than @p tolerance.
  ///
  /// With slopes of s within w_d of a vector g on a block of cells, s - g.x changes by at most sum_d w_d h_d in one of its cells of extent
  /// h, which is all that the interpolant I_h s can miss of s: I_h s - u has the values D(x_j) at the nodes of the element, so that
  ///
  ///   D <= M + (L - 1)/2 (M - m) + L sum_d w_d h_d,  M = max_j D(x_j), m = min_j D(x_j),
  ///
  /// L the Lebesgue constant of the element, 1 for P1 and Q1. Blocks begin with 1024 cells that follow each other, as those do that come
  /// from one coarse cell, and are halved where this is too much. Where s is smooth w_d is O(size of the block): beside an error of O(h)
  /// a few blocks are enough for any number of cells.
  ///
  /// All cells where they are curved, and for Hermite elements. s has to have a range and slopes; @p u with its prescribed values.
  template <int dim>
  std::vector<typename dealii::DoFHandler<dim>::active_cell_iterator>
  cells_to_search(const Problem<dim> &problem, const FieldFunction &s, Side side, const Vector &u, double tolerance);
} // namespace unilateral
