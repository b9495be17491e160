#include "unilateral/constraints/constraint_trace.h"

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  ConstraintTrace::ConstraintTrace(const ConstraintSet<dim> &constraint_set, const AffineConstraints<double> &dirichlet)
  {
    const std::size_t n_points = constraint_set.size();
    if (std::any_of(constraint_set.points.begin(), constraint_set.points.end(), [](const auto &point) { return !point.owned; }))
      for (const auto &point : constraint_set.points)
        owned.push_back(point.owned);
    weights.reinit(n_points);
    obstacle.reinit(n_points);
    row_start.reserve(n_points + 1);
    columns.reserve(n_points);
    values.reserve(n_points);
    TraceRow row;
    for (std::size_t i = 0; i < n_points; ++i)
    {
      const double sign = constraint_set.points[i].sign;
      weights(i) = constraint_set.points[i].weight;
      obstacle(i) = sign * constraint_set.points[i].bound;
      double prescribed = 0;
      resolve(constraint_set.trace[i], dirichlet, row, prescribed);
      obstacle(i) -= sign * prescribed;
      for (std::size_t k = 0; k < row.dofs.size(); ++k)
      {
        columns.push_back(row.dofs[k]);
        values.push_back(sign * row.values[k]);
      }
      const auto own = constraint_set.trace[i];
      const auto depends = [&](const auto dof) { return dirichlet.is_constrained(dof) && !dirichlet.get_constraint_entries(dof)->empty(); };
      if (row.dofs.size() > 1 && std::any_of(own.dofs.begin(), own.dofs.end(), depends))
      {
        auto &on_cell = rows_on_cells[i];
        for (std::size_t k = 0; k < own.dofs.size(); ++k)
        {
          on_cell.columns.push_back(own.dofs[k]);
          on_cell.values.push_back(sign * own.values[k]);
        }
      }
      row_start.push_back(columns.size());
    }
  }

  bool ConstraintTrace::same_rows(const ConstraintTrace &other) const
  {
    return row_start == other.row_start && columns == other.columns && values == other.values &&
           std::equal(weights.begin(), weights.end(), other.weights.begin(), other.weights.end()) && owned == other.owned &&
           rows_on_cells == other.rows_on_cells;
  }

  void ConstraintTrace::apply(Vector &Bu, const Vector &u) const
  {
    for (std::size_t i = 0; i < n_points(); ++i)
    {
      double sum = 0;
      for (std::size_t k = row_start[i]; k < row_start[i + 1]; ++k)
        sum += values[k] * u.local_element(columns[k]);
      Bu.local_element(i) = sum;
    }
  }

  void ConstraintTrace::apply_to_sizes(Vector &sizes, const Vector &u) const
  {
    for (std::size_t i = 0; i < n_points(); ++i)
    {
      double sum = 0;
      for (std::size_t k = row_start[i]; k < row_start[i + 1]; ++k)
        sum += std::abs(values[k] * u.local_element(columns[k]));
      sizes.local_element(i) = sum;
    }
  }

  void ConstraintTrace::apply_transpose(Vector &BtWq, const Vector &q) const
  {
    BtWq = 0.;
    for (std::size_t i = 0; i < n_points(); ++i)
      if (const double wq = weights.local_element(i) * q.local_element(i); wq != 0 && owns(i))
        for (std::size_t k = row_start[i]; k < row_start[i + 1]; ++k)
          BtWq.local_element(columns[k]) += values[k] * wq;
  }

  void ConstraintTrace::add_penalty_product(const Vector &d, Vector &Tv, const Vector &v) const
  {
    for (std::size_t i = 0; i < d.size(); ++i)
      if (d(i) != 0)
      {
        double trace = 0;
        for (std::size_t k = row_start[i]; k < row_start[i + 1]; ++k)
          trace += values[k] * v(columns[k]);
        for (std::size_t k = row_start[i]; k < row_start[i + 1]; ++k)
          Tv(columns[k]) += d(i) * trace * values[k];
      }
  }

  void ConstraintTrace::scale(const Vector &stiffness_diagonal, Vector &compliance, Vector &trace_mass) const
  {
    compliance.reinit(n_points());
    trace_mass.reinit(stiffness_diagonal.size());
    for (std::size_t i = 0; i < n_points(); ++i)
      for (std::size_t k = row_start[i]; k < row_start[i + 1]; ++k)
      {
        const double wBB = weights(i) * values[k] * values[k];
        compliance(i) += wBB / stiffness_diagonal(columns[k]);
        if (owns(i))
          trace_mass(columns[k]) += wBB;
      }
  }

  template ConstraintTrace::ConstraintTrace(const ConstraintSet<1> &, const AffineConstraints<double> &);
  template ConstraintTrace::ConstraintTrace(const ConstraintSet<2> &, const AffineConstraints<double> &);
  template ConstraintTrace::ConstraintTrace(const ConstraintSet<3> &, const AffineConstraints<double> &);
} // namespace unilateral
