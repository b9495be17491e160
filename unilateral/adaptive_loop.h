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

    /// After a solve, with the square of the estimated error by active cell: notes the cycle in the results and says whether it was the
    /// last one: the error is small enough, the next mesh would have too many unknowns, the solver failed, or no refinement was asked for.
    /// Else chosen_cells() are to be refined.
    template <int dim>
    bool ends(const Problem<dim> &problem, const std::vector<double> &error_squares, bool converged, RunResult &result, Progress &progress);

    const std::vector<bool> &chosen_cells() const { return chosen; } ///< by active cell

  private:
    static constexpr double share = 0.6; ///< of the square of the error that the cells to be refined have

    const std::optional<AdaptiveRefinement> adapt;
    std::vector<Estimate::Cycle>            cycles;
    std::vector<bool>                       chosen;
  };
} // namespace unilateral
