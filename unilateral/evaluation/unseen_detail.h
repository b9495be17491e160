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

    /// The active cells where a load is missed, and the part of the square of the energy norm that it may be.
    struct MissedLoad
    {
      std::size_t cell;
      double      relative_square;
    };
    std::vector<MissedLoad> missed_loads;
  };

  /// Stiffness, reaction, Young's modulus, Poisson's ratio and load that are expressions, and bounds and gaps on the boundary that are, are
  /// searched cell by cell, on boundary parts face by face, for values that are far from those at the points of its rules: see
  /// find_value_outside(). One entry for each cell in which one was found that is off by more than 5 % of the largest one (of gaps: of the
  /// largest u) and half of the range seen, and, of gaps, on the side of u. Of loads those that are missed count as a whole, beside 0.3 of
  /// the @p relative_error, from 1e-6 of the energy norm on. Where the search ends before, as in cells that a function oscillates or jumps
  /// in, nothing is said. Problems of second order on straight cells; obstacles that are surfaces, velocities and what else acts on the
  /// boundary are not searched. @p u with its prescribed values. Collective. Reference: R. E. Moore, R. B. Kearfott, M. J. Cloud,
  /// Introduction to Interval Analysis, SIAM 2009.
  template <int dim>
  UnseenDetails unseen_details(const Problem<dim> &problem, const Vector &u, double relative_error);

  /// What loads that are missed may be of the error in the energy norm, @p norm that of u; adds what cells have of its square to
  /// @p cell_squares. Collective.
  template <int dim>
  double add_missed_loads(const Problem<dim> &problem, const UnseenDetails &unseen, double norm, std::vector<double> &cell_squares);

  /// The first entry for each function, of those that the parts of all @p processes have; without the numbers of cells. Collective.
  std::vector<UnseenDetail> one_of_each_function(const std::vector<UnseenDetail> &own, const Processes &processes);
} // namespace unilateral
