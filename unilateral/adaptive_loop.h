// Refinement by the estimated error, until it is small enough.
#pragma once

#include "unilateral/algebra/vector.h"
#include "unilateral/base/progress.h"
#include "unilateral/discretisation/solver_choice.h"
#include "unilateral/mesh/mesh_description.h"
#include "unilateral/solution.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  /// The fewest cells, of all @p processes, whose squares sum up to @p share of all; of several processes they take all that are equal to
  /// the least of these. Reference: W. Doerfler, SIAM J. Numer. Anal. 33 (1996) 1106-1124.
  std::vector<bool> largest_contributions(const std::vector<double> &squares, double share, const Processes &processes = Processes());

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

    /// Before the solve on a refined mesh: the solution on the mesh before, as a function on this one.
    void starts_from(const Vector &u);

    /// After a solve: notes the cycle in the results and says whether it was the
    /// last one: the error is small enough, the next mesh would have too many unknowns even if fewer cells were refined, a cell is
    /// 1e-12 of the largest one, rounding would make the error larger on a finer mesh, the solver failed, or no refinement was asked for.
    /// Else chosen_cells() are to be refined.
    ///
    /// An estimate without a guarantee is held against what refinement did to u, where that was more: || u_2 - u_1 ||_a is at most
    /// || u - u_1 ||_a up to the part that contact has in it, since the spaces are nested, and the estimate on mesh 2 is raised by as much
    /// as that on mesh 1 was below it. The error of a number is held against the change of the number. On the first mesh, which has no mesh
    /// to be compared with, such an estimate ends nothing.
    ///
    /// Nor does a small error end anything where contact was not seen, see unseen_contact(): the cells there are refined first. Those of
    /// unseen_details() are refined with the others, on eight meshes at most.
    template <int dim>
    bool ends(Solution<dim> &solution, bool converged, Progress &progress);

    /// Before a solve: the mesh is coarser yet than that of the run that is resumed. Its cells that were refined
    /// there are the chosen_cells() then, and neither bounds nor estimates are needed on this mesh.
    template <int dim>
    bool follows_former_mesh(const Problem<dim> &problem);

    const std::vector<bool> &chosen_cells() const { return chosen; } ///< by active cell

    /// After ends() or follows_former_mesh(): what is to be refined, and where @p processes are several what will have become of each
    /// cell in the end. Collective.
    template <int dim>
    RefinementByError next_mesh(const Problem<dim> &problem, const std::vector<double> &error_squares, const Processes &processes) const;

    /// After ends(): why the next step of a load history had better begin with the coarse mesh; empty: go on with this one. Contact may
    /// have moved on, so that more than half of the cells could be twice as large, each with at most its share of the error that is
    /// allowed, not counting as many as the @p n_cells_unrefined on the mesh before all refinement by the error; or so that one process has
    /// far more cells than others, which can help only where this step did not begin with the coarse mesh itself.
    template <int dim>
    std::string obstacle_to_mesh(const Problem<dim>        &problem,
                                 const std::vector<double> &error_squares,
                                 unsigned                   n_cells_unrefined,
                                 bool                       began_with_coarse_mesh) const;

  private:
    /// About how many cells each active cell will have become when the tolerance is met, or as many unknowns are there as there may be, by
    /// its share of the error.
    template <int dim>
    std::vector<double> expected_cells(const Problem<dim> &problem, const std::vector<double> &error_squares) const;

    template <int dim>
    bool mesh_is_over_refined(const Problem<dim> &problem, const std::vector<double> &error_squares, unsigned n_cells_unrefined) const;

    /// In units of what the tolerance allows, the sum of the contributions of all cells: the square of the error, for the error of a number
    /// the error itself.
    double sum_per_tolerance() const;

    /// What halving leaves of the contributions of cells, from the sums before and after a refinement.
    void learn_from_refinement(double sum_before, unsigned degree);

    /// Of the sum, what the cells to be refined have: 0.9 (0.75 in space), and less on the last mesh but one, where that is enough.
    double share_to_refine(int dim) const;

    /// At least 1: by how much the estimate on the mesh before was too low, as the change of u since tells.
    template <int dim>
    double correction_of_estimate(const Problem<dim> &problem, const Vector &u) const;

    /// The same of the error of a number.
    double correction_of_estimate(const Estimate::Goal &goal) const;

    const std::optional<AdaptiveRefinement> adapt;
    std::vector<Estimate::Cycle>            cycles;
    std::vector<bool>                       chosen;
    double                                  n_next = 0; ///< unknowns of the next mesh, about
    std::vector<double>                     n_former;   ///< cells of the former mesh in each active cell, while it is followed
    bool                                    former_reached = false;
    Vector                                  start;                    ///< see starts_from()
    double                                  error_of_goal_before = 0; ///< likewise
    double                                  estimate_before = 0;      ///< on the mesh before, as it was made
    double                                  chosen_share = 0;         ///< of the sum; zero: chosen otherwise
    double                                  left_by_halving = 0.25;   ///< at first, as for degree 1
    double                                  error_per_tolerance = 0;  ///< on the last mesh
    unsigned                                n_refined_for_details = 0;
    double                                  bound_per_estimate = 0, unknowns_at_bound = 0; ///< of the last bound; zero: none yet
  };
} // namespace unilateral
