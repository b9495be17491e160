// The penalty problem in the unknown d = u_eps - u_h: how far it is from the mixed solution, without a cancelling difference.
#pragma once

#include "unilateral/inequality/discrete_problem.h"

namespace unilateral
{
  /// With the mixed solution (u_h, lambda_h), A u_h + B'W lambda_h = f, the problem (7) for u_h + d reads
  ///     A d + B'W lambda = B'W lambda_h,   lambda = (B d - g)^+ / eps,   g = s - B u_h >= 0,
  /// a problem of the same kind: load B'W lambda_h, obstacle g. Nothing of the size of u cancels in it, so that errors down to about 1e-12
  /// of the solution are measured with several digits. Gaps g below round-off are contact and count as 0.
  /// Keeps references to the original, which must outlive it.
  class IncrementProblem : public DiscreteProblem
  {
  public:
    IncrementProblem(DiscreteProblem &original, const Vector &u_h, const Vector &lambda_h);

    void                       initialize_dof_vector(Vector &v) const override { original.initialize_dof_vector(v); }
    void                       initialize_point_vector(Vector &q) const override { original.initialize_point_vector(q); }
    const SharedUnknowns      &shared() const override { return original.shared(); }
    bool                       owns_point(const std::size_t i) const override { return original.owns_point(i); }
    bool                       symmetric() const override { return original.symmetric(); }
    const std::vector<Vector> &null_space() const override { return original.null_space(); }
    const std::vector<Vector> &rigid_body_modes() const override { return original.rigid_body_modes(); }
    void                       apply_stiffness(Vector &Au, const Vector &u) const override { original.apply_stiffness(Au, u); }
    void                       apply_gram(Vector &Hu, const Vector &u) const override { original.apply_gram(Hu, u); }
    void                       apply_trace(Vector &Bu, const Vector &u) const override { original.apply_trace(Bu, u); }
    void          apply_trace_to_sizes(Vector &sizes, const Vector &u) const override { original.apply_trace_to_sizes(sizes, u); }
    void          apply_trace_transpose(Vector &BtWq, const Vector &q) const override { original.apply_trace_transpose(BtWq, q); }
    const Vector &stiffness_diagonal() const override { return original.stiffness_diagonal(); }
    const Vector &load() const override { return contact_load; }
    const Vector &weights() const override { return original.weights(); }
    const Vector &obstacle() const override { return gap; }
    const Vector &compliance() const override { return original.compliance(); }
    const Vector &trace_mass() const override { return original.trace_mass(); }
    LinearSolve   solve_tangent(const Vector &d, const Vector &rhs, const SolveTolerance &tolerance, Vector &x, Vector *Ax) override
    {
      return original.solve_tangent(d, rhs, tolerance, x, Ax);
    }
    LocalRows   rows_near_free_boundary(const std::vector<bool> &active) const override { return original.rows_near_free_boundary(active); }
    bool        solves_exactly() const override { return original.solves_exactly(); }
    std::string linear_solver_name() const override { return original.linear_solver_name(); }
    std::size_t n_operator_applications() const override { return original.n_operator_applications(); }

  private:
    DiscreteProblem &original;
    Vector           contact_load, gap;
  };
} // namespace unilateral
