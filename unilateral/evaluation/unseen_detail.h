// Where data have values of which the points that a cell looks at show nothing.
#pragma once

#include "unilateral/algebra/vector.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/evaluation/run_result.h"

#include <vector>

namespace unilateral
{
  struct UnseenDetails
  {
    std::vector<UnseenDetail> details;
    bool                      certain = true; ///< false: bounds in the domain could not be searched to the end here

    /// Bounds in the domain: the active cells where u is beyond them, and by which part of the largest u.
    struct Crossing
    {
      std::size_t cell;
      double      relative_excess;
    };
    std::vector<Crossing> crossings;

    /// The active cells where a load is missed, and the part of the square of the energy norm that it may be.
    struct MissedLoad
    {
      std::size_t cell;
      double      relative_square;
    };
    std::vector<MissedLoad> missed_loads;
  };

  /// Stiffness, reaction, Young's modulus, Poisson's ratio and load that are expressions, and the bounds and gaps that are, are searched
  /// cell by cell, on boundary parts face by face, for values that are far from those at the points of its rules: see find_value_outside().
  /// One entry for each cell in which one was found that is off by more than 5 % of the largest one (of gaps: 5 %
  /// of the largest u) and half of the range seen, and, of gaps, on the side of u. Where the search ends before, as in cells that a
  /// function oscillates or jumps in, nothing is said. Problems of second order on straight cells; obstacles that are surfaces, velocities
  /// and what else acts on the boundary are not searched.
  ///
  /// Of loads those that are missed count as a whole, beside 0.3 of the @p relative_error, from 1e-6 of the energy norm on.
  ///
  /// Bounds in the domain are searched for places where u is beyond them, by more than 0.3 of its @p relative_error (and from 1e-6 to 5 %)
  /// of the largest u, on all cells and for problems of any order, see CrossingSearch; by at least 1 % where a process has
  /// more than 2000 cells, and 5 % from 50 000 on.
  /// @p u with its prescribed values. Collective. Reference: R. E. Moore, R. B. Kearfott, M. J. Cloud, Introduction to Interval Analysis,
  /// SIAM 2009.
  template <int dim>
  UnseenDetails unseen_details(const Problem<dim> &problem, const Vector &u, double relative_error);

  /// The first entry for each function, of those that the parts of all @p processes have; without the numbers of cells. Collective.
  std::vector<UnseenDetail> one_of_each_function(const std::vector<UnseenDetail> &own, const Processes &processes);
} // namespace unilateral
