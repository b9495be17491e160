// DiscreteProblem without assembled matrices: element matrices and geometric multigrid.
#pragma once

#include "unilateral/algebra/conjugate_gradients.h"
#include "unilateral/discretisation/constrained_system.h"
#include "unilateral/multigrid/level_hierarchy.h"
#include "unilateral/multigrid/multigrid.h"

#include <memory>
#include <set>
#include <vector>

namespace unilateral
{
  /// A DiscreteProblem on the finest level of a LevelHierarchy. There is no Gram matrix.
  class MatrixFree : public ConstrainedSystem
  {
  public:
    struct Parameters
    {
      unsigned              max_iterations = 500; ///< of conjugate gradients or GMRES
      unsigned              gmres_basis = 20;     ///< vectors between restarts of GMRES
      Multigrid::Parameters multigrid;
    };

    MatrixFree(std::shared_ptr<const LevelHierarchy> hierarchy,
               ConstraintTrace                       trace,
               Vector                                load,
               std::vector<Vector>                   null_space,
               std::vector<Vector>                   rigid_body_modes,
               const Parameters                     &parameters);

    /// Takes over load and bounds; what multigrid knows of A serves on. False, and nothing has changed, where the rows of @p trace are
    /// others.
    bool set_data(ConstraintTrace trace, Vector load);

    const SharedUnknowns &shared() const override { return hierarchy->levels.back().shared; }
    bool                  symmetric() const override { return !hierarchy->convection; }
    void                  apply_stiffness(Vector &Au, const Vector &u) const override;
    void                  apply_gram(Vector &, const Vector &) const override; ///< not available: throws

    LinearSolve
    solve_tangent(const Vector &d, const Vector &rhs, const SolveTolerance &tolerance, Vector &x, Vector *Ax = nullptr) override;

    LocalRows   rows_near_free_boundary(const std::vector<bool> &active) const override;
    std::string linear_solver_name() const override { return "multigrid"; }
    std::size_t n_operator_applications() const override { return applications + multigrid.n_fine_applications(); }

  private:
    void find_cells_of_points();
    void set_penalty(const Vector &d);

    /// The unknowns at the node that a point lies in; empty where it sees several nodes.
    std::vector<std::uint32_t> node_of(std::size_t point, const std::vector<std::uint32_t> &dofs_of_cell) const;

    std::shared_ptr<const LevelHierarchy> hierarchy;
    Parameters                            parameters;
    std::vector<std::uint32_t>            cell_of_point; ///< of points that see more than one unknown: it has all of them,
    std::set<std::size_t>                 known_on_cell; ///< or those of ConstraintTrace::rows_on_cells
    Multigrid                             multigrid;
    ConjugateGradients                    conjugate_gradients;
    Vector                                tangent_diagonal;    ///< the d that multigrid knows
    std::vector<double>                   penalty_on_diagonal; ///< of B' D B, at each unknown
    bool                                  tangent_is_set = false;
    mutable std::size_t                   applications = 0;
  };
} // namespace unilateral
