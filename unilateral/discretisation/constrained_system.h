// What every discretisation keeps of a DiscreteProblem besides A: f, B, W, s and the modes, in terms of the unknowns.
#pragma once

#include "unilateral/constraints/constraint_trace.h"
#include "unilateral/inequality/discrete_problem.h"

#include <vector>

namespace unilateral
{
  /// How A is stored, and how systems with it are solved, is left to the classes derived from it.
  class ConstrainedSystem : public DiscreteProblem
  {
  public:
    void initialize_dof_vector(Vector &v) const override { v.reinit(f.size()); }
    void initialize_point_vector(Vector &q) const override { q.reinit(B.n_points()); }
    bool owns_point(const std::size_t i) const override { return B.owns(i); }

    const std::vector<Vector> &null_space() const override { return null_vectors; }
    const std::vector<Vector> &rigid_body_modes() const override { return modes; }

    void apply_trace(Vector &Bu, const Vector &u) const override { B.apply(Bu, u); }
    void apply_trace_to_sizes(Vector &sizes, const Vector &u) const override { B.apply_to_sizes(sizes, u); }
    void apply_trace_transpose(Vector &BtWq, const Vector &q) const override
    {
      B.apply_transpose(BtWq, q);
      shared().add(BtWq.begin());
    }

    const Vector &stiffness_diagonal() const override { return diagonal; }
    const Vector &load() const override { return f; }
    const Vector &weights() const override { return B.weights; }
    const Vector &obstacle() const override { return B.obstacle; }
    const Vector &compliance() const override { return local_compliance; }
    const Vector &trace_mass() const override { return BtWB_diagonal; }

  protected:
    /// compliance() and trace_mass() from B and the diagonal, which is that of the whole A.
    void set_scales()
    {
      B.scale(diagonal, local_compliance, BtWB_diagonal);
      shared().add(BtWB_diagonal.begin());
    }

    ConstraintTrace     B;
    Vector              f, diagonal;
    std::vector<Vector> null_vectors; ///< null_space()
    std::vector<Vector> modes;        ///< rigid_body_modes()

  private:
    Vector local_compliance, BtWB_diagonal;
  };
} // namespace unilateral
