#include "unilateral/uniform_refinement.h"

#include <deal.II/fe/fe.h>

#include <cmath>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  InterpolationToRefinedCells<dim>::InterpolationToRefinedCells(const DoFHandler<dim> &coarse, const std::vector<VectorType> &functions)
    : cell_values(functions.size())
  {
    const auto &triangulation = coarse.get_triangulation();
    Assert(triangulation.n_active_cells() == triangulation.n_cells(triangulation.n_levels() - 1), ExcMessage("cells of several levels"));
    const unsigned                       n = coarse.get_fe().n_dofs_per_cell();
    std::vector<types::global_dof_index> dofs(n);
    for (auto &values : cell_values)
      values.resize(triangulation.n_active_cells() * std::size_t(n));
    for (const auto &cell : coarse.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      for (std::size_t f = 0; f < functions.size(); ++f)
        for (unsigned i = 0; i < n; ++i)
          cell_values[f][cell->index() * std::size_t(n) + i] = functions[f](dofs[i]);
    }
  }

  template <int dim>
  void InterpolationToRefinedCells<dim>::interpolate(const DoFHandler<dim> &fine, std::vector<VectorType> &functions) const
  {
    const auto                                                        &fe = fine.get_fe();
    const unsigned                                                     n = fe.n_dofs_per_cell();
    constexpr unsigned                                                 n_children = GeometryInfo<dim>::max_children_per_cell;
    std::vector<std::vector<std::vector<std::pair<unsigned, double>>>> rows(n_children);
    for (unsigned c = 0; c < n_children; ++c)
    {
      rows[c].resize(n);
      const auto &P = fe.get_prolongation_matrix(c);
      for (unsigned i = 0; i < n; ++i)
        for (unsigned j = 0; j < n; ++j)
          if (std::abs(P(i, j)) > 1e-14)
            rows[c][i].emplace_back(j, P(i, j));
    }
    for (auto &function : functions)
      function.reinit(fine.n_dofs());
    std::vector<types::global_dof_index> dofs(n);
    std::vector<char>                    known(fine.n_dofs(), false); // cells that share an unknown agree on it
    for (const auto &cell : fine.active_cell_iterators())
    {
      const auto parent = cell->parent();
      unsigned   child = cell->index() % n_children;
      if (parent->child_index(child) != cell->index())
        for (child = 0; parent->child_index(child) != cell->index();)
          ++child;
      cell->get_dof_indices(dofs);
      for (unsigned i = 0; i < n; ++i)
      {
        if (std::exchange(known[dofs[i]], true))
          continue;
        for (std::size_t f = 0; f < functions.size(); ++f)
        {
          const double *const values = cell_values[f].data() + parent->index() * std::size_t(n);
          double              sum = 0;
          for (const auto &[j, weight] : rows[child][i])
            sum += weight * values[j];
          functions[f](dofs[i]) = sum;
        }
      }
    }
  }

  template class InterpolationToRefinedCells<1>;
  template class InterpolationToRefinedCells<2>;
  template class InterpolationToRefinedCells<3>;
} // namespace unilateral
