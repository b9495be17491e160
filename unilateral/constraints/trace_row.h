// Rows of B: the value at a point as a combination of unknowns.
#pragma once

#include <deal.II/base/types.h>
#include <deal.II/lac/affine_constraints.h>

#include <span>
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

    void clear();
  };

  /// The same numbers where they are kept elsewhere.
  struct TraceRowView
  {
    std::span<const dealii::types::global_dof_index> dofs;
    std::span<const double>                          values, direction;

    TraceRowView(const TraceRow &row) : dofs(row.dofs), values(row.values), direction(row.direction) {}
    TraceRowView(std::span<const dealii::types::global_dof_index> dofs, std::span<const double> values, std::span<const double> direction)
      : dofs(dofs), values(values), direction(direction)
    {
    }

    /// Component of the direction in which entry k moves; 1 for a scalar.
    double direction_of(const std::size_t k) const { return direction.empty() ? 1 : direction[k]; }
  };

  /// Rows one behind the other in common arrays: points are many and see few unknowns each. All have directions, or none has.
  class TraceRows
  {
  public:
    std::size_t size() const { return row_start.size() - 1; }

    TraceRowView operator[](const std::size_t i) const
    {
      const std::size_t begin = row_start[i], n = row_start[i + 1] - begin;
      return {{dofs.data() + begin, n}, {values.data() + begin, n}, {directions.data() + begin, directions.empty() ? 0 : n}};
    }

    void push_back(const TraceRowView &row);

  private:
    std::vector<std::size_t>                     row_start = {0};
    std::vector<dealii::types::global_dof_index> dofs;
    std::vector<double>                          values, directions;
  };

  /// The row in terms of the unknowns that @p supports leave free; @p constant is what the prescribed values contribute. Entries that
  /// cancel are gone: a row without entries stands for a value that is fixed. @p result has no directions.
  void resolve(const TraceRowView &row, const dealii::AffineConstraints<double> &supports, TraceRow &result, double &constant);
} // namespace unilateral
