#include "unilateral/constraints/trace_row.h"

#include <algorithm>
#include <cmath>

namespace unilateral
{
  void TraceRow::clear()
  {
    dofs.clear();
    values.clear();
    direction.clear();
  }

  void TraceRows::push_back(const TraceRowView &row)
  {
    Assert(size() == 0 || row.direction.empty() == directions.empty(), dealii::ExcMessage("rows with and without directions"));
    dofs.insert(dofs.end(), row.dofs.begin(), row.dofs.end());
    values.insert(values.end(), row.values.begin(), row.values.end());
    directions.insert(directions.end(), row.direction.begin(), row.direction.end());
    row_start.push_back(dofs.size());
  }

  void resolve(const TraceRowView &row, const dealii::AffineConstraints<double> &supports, TraceRow &result, double &constant)
  {
    result.clear();
    constant = 0;
    double     largest = 0;
    const auto add = [&](const dealii::types::global_dof_index dof, const double value)
    {
      const auto it = std::find(result.dofs.begin(), result.dofs.end(), dof);
      if (it != result.dofs.end())
        result.values[it - result.dofs.begin()] += value;
      else
      {
        result.dofs.push_back(dof);
        result.values.push_back(value);
      }
    };
    for (std::size_t k = 0; k < row.dofs.size(); ++k)
    {
      largest = std::max(largest, std::abs(row.values[k]));
      if (!supports.is_constrained(row.dofs[k]))
      {
        add(row.dofs[k], row.values[k]);
        continue;
      }
      constant += row.values[k] * supports.get_inhomogeneity(row.dofs[k]);
      for (const auto &[dof, factor] : *supports.get_constraint_entries(row.dofs[k]))
        add(dof, row.values[k] * factor);
    }
    std::size_t n_kept = 0;
    for (std::size_t k = 0; k < result.dofs.size(); ++k)
      if (std::abs(result.values[k]) > 1e-10 * largest)
      {
        result.dofs[n_kept] = result.dofs[k];
        result.values[n_kept++] = result.values[k];
      }
    result.dofs.resize(n_kept);
    result.values.resize(n_kept);
  }
} // namespace unilateral
