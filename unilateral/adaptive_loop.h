// Refinement by the estimated error, until it is small enough.
#pragma once

#include "unilateral/base/progress.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/evaluation/run_result.h"
#include "unilateral/mesh/mesh_description.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace unilateral
{
  /// The fewest cells whose squares sum up to @p share of all. Reference: W. Doerfler, SIAM J. Numer. Anal. 33 (1996) 1106-1124.
  std::vector<bool> largest_contributions(const std::vector<double> &squares, double share);

  /// Solves are followed by refinements of the cells that have most of the error: solve - estimate - mark - refine.
  class AdaptiveLoop
  {
  public:
    explicit AdaptiveLoop(const std::optional<AdaptiveRefinement> &adapt) : adapt(adapt) {}

    /// The bound of the error may cost more than the solve. It is computed where the estimate of the mesh's error, relative to the energy
    /// norm, is at most this: where the last ratio of bound and estimate predicts a bound within 1.5 times the tolerance, and at the latest
    /// where the estimate is within the tolerance. Infinity, which is in any case, on the first mesh, after the unknowns have become eight
    /// times as many, and where the next mesh may have too many.
    template <int dim>
    double bound_below(const Problem<dim> &problem) const;

    /// After a solve, with the square of the estimated error by active cell: notes the cycle in the results and says whether it was the
    /// last one: the error is small enough, the next mesh would have too many unknowns even if fewer cells were refined, a cell is
    /// 1e-12 of the largest one, the solver failed, or no refinement was asked for. Else chosen_cells() are to be refined.
    template <int dim>
    bool ends(const Problem<dim> &problem, const std::vector<double> &error_squares, bool converged, RunResult &result, Progress &progress);

    const std::vector<bool> &chosen_cells() const { return chosen; } ///< by active cell

    /// After ends(): could more than half of the cells be twice as large, each with at most its share of the error that is allowed, not
    /// counting as many as the @p n_cells_unrefined on the mesh before all refinement by the error? So it is in load histories where
    /// contact has moved on.
    template <int dim>
    bool mesh_is_over_refined(const Problem<dim> &problem, const std::vector<double> &error_squares, unsigned n_cells_unrefined) const;

  private:
    /// Of the square of the error, what the cells to be refined have: 0.75, and less on the last mesh but one, where that is enough.
    double share_to_refine() const;

    const std::optional<AdaptiveRefinement> adapt;
    std::vector<Estimate::Cycle>            cycles;
    std::vector<bool>                       chosen;
    double                                  error_per_tolerance = 0;                       ///< on the last mesh
    double                                  bound_per_estimate = 0, unknowns_at_bound = 0; ///< of the last bound; zero: none yet
  };
} // namespace unilateral
