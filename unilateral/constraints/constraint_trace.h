// B, W and s of a constraint set in terms of the unknowns that Dirichlet data leave free.
#pragma once

#include "unilateral/constraints/constraint_set.h"
#include "unilateral/inequality/discrete_problem.h"

#include <deal.II/lac/affine_constraints.h>

#include <map>
#include <vector>

namespace unilateral
{
  /// B as compressed rows, its sign included (a lower obstacle has the rows -B), without the columns that Dirichlet data fix; what those
  /// contribute is in s.
  class ConstraintTrace
  {
  public:
    ConstraintTrace() = default;

    template <int dim>
    ConstraintTrace(const ConstraintSet<dim> &constraint_set, const dealii::AffineConstraints<double> &dirichlet);

    std::size_t n_points() const { return weights.size(); }

    /// B and W are those of @p other; the bounds s may differ.
    bool same_rows(const ConstraintTrace &other) const;

    void apply(Vector &Bu, const Vector &u) const;             ///< B u
    void apply_to_sizes(Vector &sizes, const Vector &u) const; ///< |B| |u|
    void apply_transpose(Vector &BtWq, const Vector &q) const; ///< B' W q; like the next of the points that are owned

    /// Tv += B' D B v, D = diag(@p d).
    void add_penalty_product(const Vector &d, Vector &Tv, const Vector &v) const;

    /// tau_i = w_i (B diag(A)^-1 B')_ii and diag(B' W B), see discrete_problem.h.
    void scale(const Vector &stiffness_diagonal, Vector &compliance, Vector &trace_mass) const;

    std::vector<std::size_t>                     row_start = {0}; ///< N + 1
    std::vector<dealii::types::global_dof_index> columns;
    std::vector<double>                          values;
    Vector                                       weights, obstacle; ///< w > 0 and s, N entries
    std::vector<bool>                            owned;             ///< empty: all are

    /// A row of B as the cell at the point has it, before unknowns that depend on others are replaced.
    struct RowOnCell
    {
      std::vector<dealii::types::global_dof_index> columns;
      std::vector<double>                          values;

      bool operator==(const RowOnCell &) const = default;
    };
    std::map<std::size_t, RowOnCell> rows_on_cells; ///< of the points where that is another one, with more than one entry
    bool                             owns(const std::size_t i) const { return owned.empty() || owned[i]; }
  };
} // namespace unilateral
