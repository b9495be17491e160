// DiscreteProblem without assembled matrices: element matrices and geometric multigrid.
#pragma once

#include "unilateral/algebra/conjugate_gradients.h"
#include "unilateral/constraints/constraint_trace.h"
#include "unilateral/inequality/discrete_problem.h"
#include "unilateral/multigrid/level_hierarchy.h"
#include "unilateral/multigrid/multigrid.h"

#include <memory>
#include <set>
#include <vector>

namespace unilateral
{
  /// A DiscreteProblem on the finest level of a LevelHierarchy. There is no Gram matrix.
  class MatrixFree : public DiscreteProblem
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

    void                       initialize_dof_vector(Vector &v) const override { v.reinit(f.size()); }
    void                       initialize_point_vector(Vector &q) const override { q.reinit(B.n_points()); }
    const SharedUnknowns      &shared() const override { return hierarchy->levels.back().shared; }
    bool                       owns_point(const std::size_t i) const override { return B.owns(i); }
    bool                       symmetric() const override { return !hierarchy->convection; }
    const std::vector<Vector> &null_space() const override { return null_vectors; }
    const std::vector<Vector> &rigid_body_modes() const override { return modes; }
    void                       apply_stiffness(Vector &Au, const Vector &u) const override;
    void                       apply_gram(Vector &, const Vector &) const override; ///< not available: throws
    void                       apply_trace(Vector &Bu, const Vector &u) const override { B.apply(Bu, u); }
    void                       apply_trace_transpose(Vector &BtWq, const Vector &q) const override;

    const Vector &stiffness_diagonal() const override { return diagonal; }
    const Vector &load() const override { return f; }
    const Vector &weights() const override { return B.weights; }
    const Vector &obstacle() const override { return B.obstacle; }
    const Vector &compliance() const override { return local_compliance; }
    const Vector &trace_mass() const override { return BtWB_diagonal; }

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
    ConstraintTrace                       B;
    Vector                                f, diagonal, local_compliance, BtWB_diagonal;
    std::vector<Vector>                   null_vectors;  ///< null_space()
    std::vector<Vector>                   modes;         ///< rigid_body_modes()
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
