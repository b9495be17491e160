// A row of B: the value at a point as a combination of unknowns.
#pragma once

#include <deal.II/base/types.h>
#include <deal.II/lac/affine_constraints.h>

#include <vector>

namespace unilateral
{
  /// v(x), or v(x).n for a vector-valued v, as a combination of degrees of freedom.
  struct TraceRow
  {
    std::vector<dealii::types::global_dof_index> dofs;
    std::vector<double>                          values;
    std::vector<double> direction; ///< of a vector-valued v: n_c of each entry's component; of Hermite elements: 1 for values,
                                   ///< 0 for derivatives; else empty

    /// Component of the direction in which entry k moves; 1 for a scalar.
    double direction_of(const std::size_t k) const { return direction.empty() ? 1 : direction[k]; }
  };

  /// The row in terms of the unknowns that @p supports leave free; @p constant is what the prescribed values contribute. Entries that
  /// cancel are gone: a row without entries stands for a value that is fixed.
  TraceRow resolved(const TraceRow &row, const dealii::AffineConstraints<double> &supports, double &constant);
} // namespace unilateral
