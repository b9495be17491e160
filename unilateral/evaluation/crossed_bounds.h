// Bounds in the domain that u crosses between the points of their rules, and what that makes of the error.
#pragma once

#include "unilateral/algebra/vector.h"
#include "unilateral/constraints/constraint_set.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/evaluation/run_result.h"

#include <vector>

namespace unilateral
{
  struct CrossedBounds
  {
    struct Crossing
    {
      std::size_t cell;            ///< active cell index
      double      excess;          ///< how far the bound is beyond u
      double      relative_excess; ///< beside the largest u
    };
    std::vector<Crossing>     crossings;
    std::vector<UnseenDetail> details;        ///< those that are no small part of the error
    bool                      certain = true; ///< false: a search has ended before it was certain, here
  };

  /// Bounds that are expressions, for beams and plates constant ones, too, are searched cell by cell for places where u is beyond them by
  /// more than 0.3 of its @p relative_error, and from 1e-6 to 5 %, of the largest u, and than the penalty lets it be at the points of
  /// @p set: see cells_to_search() and CrossingSearch. Of several those count that are more than half of the largest. Problems of any
  /// order, on all cells; obstacles that are surfaces are not searched.
  /// @p u with its prescribed values. Collective.
  template <int dim>
  CrossedBounds crossed_bounds(const Problem<dim> &problem, const ConstraintSet<dim> &set, const Vector &u, double relative_error);

  /// What they add to the error in the energy norm, @p norm that of u; adds what cells have of its square to @p cell_squares. Where u would
  /// be moved by a part d of its largest value at a point, its energy norm changes by about as much of itself; of beams and plates, which
  /// next to points in contact are stiffer than as a whole, by up to three times that: closed forms of strings and beams on wedges and
  /// parabolas. Where @p norm is zero, the norm of functions that rise by d over the length L of the domain, (k L^(dim - 2m))^1/2 d, k the
  /// stiffness. Of several the largest counts. Collective.
  template <int dim>
  double add_crossed_bounds(const Problem<dim> &problem, const CrossedBounds &crossed, double norm, std::vector<double> &cell_squares);
} // namespace unilateral
