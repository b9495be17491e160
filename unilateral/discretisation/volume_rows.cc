#include "unilateral/discretisation/volume_rows.h"

#include "unilateral/discretisation/element_systems.h"
#include "unilateral/discretisation/vertex_volumes.h"

#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Takes rows in terms of all unknowns and replaces those that are prescribed or depend on others.
    class RowCollector
    {
    public:
      RowCollector(const AffineConstraints<double> &dirichlet, const std::size_t n_unknowns) : dirichlet(dirichlet)
      {
        C.n_columns = n_unknowns;
      }

      /// @p factor times the @p values.
      template <typename Values>
      void add(const std::vector<types::global_dof_index> &dofs, const Values &values, const double factor)
      {
        row.clear();
        double &prescribed = c.emplace_back(0);
        for (std::size_t i = 0; i < dofs.size(); ++i)
          if (const double value = factor * values(i); !dirichlet.is_constrained(dofs[i]))
            row.emplace_back(dofs[i], value);
          else
          {
            prescribed += value * dirichlet.get_inhomogeneity(dofs[i]);
            for (const auto &[other, weight] : *dirichlet.get_constraint_entries(dofs[i]))
              row.emplace_back(other, weight * value);
          }
        std::sort(row.begin(), row.end());
        const std::size_t first = C.columns.size();
        for (const auto &[dof, value] : row)
        {
          if (C.columns.size() == first || C.columns.back() != dof)
          {
            C.columns.push_back(dof);
            C.values.push_back(0);
          }
          C.values.back() += value;
        }
        C.row_start.push_back(C.columns.size());
      }

      std::size_t n_rows() const { return C.size(); }

      VolumeRows take(SharedUnknowns shared, dealii::Vector<double> &load)
      {
        shared.add(c.data());
        for (std::size_t i = 0; i < C.size(); ++i)
          for (std::size_t k = C.row_start[i]; k < C.row_start[i + 1]; ++k)
            load(C.columns[k]) -= c[i] * C.values[k];
        return {std::move(C), std::move(shared)};
      }

    private:
      const AffineConstraints<double>                        &dirichlet;
      OwnSparseRows                                           C;
      std::vector<double>                                     c; ///< of each row
      std::vector<std::pair<types::global_dof_index, double>> row;
    };

    /// Returns which of them are shared.
    template <int dim>
    SharedUnknowns add_rows_of_vertices(const Problem<dim> &problem, RowCollector &collector)
    {
      const VertexVolumes<dim> volumes(problem);
      for (const auto &patch : volumes.patches())
        collector.add(
          patch.dofs, [&](const std::size_t i) { return patch.change[i]; }, std::sqrt(patch.modulus) / patch.volume);
      return volumes.shared();
    }

    /// Cells of one shape are integrated once.
    template <int dim>
    void add_rows_of_cells(const Problem<dim> &problem, RowCollector &collector)
    {
      FEValues<dim>                        values(*problem.space.mapping, *problem.space.fe, problem.cell_quadrature(),
                                                  update_values | update_gradients | update_quadrature_points | update_JxW_values);
      std::vector<types::global_dof_index> dofs(problem.space.fe->n_dofs_per_cell());
      CellShapes<dim>                      shapes = shapes_for_systems(problem);
      std::vector<FullMatrix<double>>      known; // by shape; without rows where the cell has none
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      {
        FullMatrix<double> rows;
        const unsigned     shape = shapes(cell);
        if (shape >= known.size())
        {
          values.reinit(cell);
          if (!problem.form->volume_rows(values, rows))
            rows.reinit(0, 0);
          if (shape != shapes.none)
            known.push_back(rows);
        }
        const FullMatrix<double> &of_cell = shape < known.size() ? known[shape] : rows;
        cell->get_dof_indices(dofs);
        for (unsigned k = 0; k < of_cell.m(); ++k)
          collector.add(
            dofs, [&](const std::size_t i) { return of_cell(k, i); }, 1);
      }
    }
  } // namespace

  template <int dim>
  bool has_volume_rows(const Problem<dim> &problem)
  {
    return problem.form->projects_volume() || VertexVolumes<dim>::any(problem);
  }

  template <int dim>
  VolumeRows volume_rows(const Problem<dim> &problem, dealii::Vector<double> &load)
  {
    RowCollector   collector(problem.space.dirichlet, load.size());
    SharedUnknowns of_vertices;
    if (VertexVolumes<dim>::any(problem))
      of_vertices = add_rows_of_vertices(problem, collector);
    if (problem.form->projects_volume())
      add_rows_of_cells(problem, collector);
    return collector.take(SharedUnknowns(problem.space.processes(), collector.n_rows(), of_vertices.entries()), load);
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template bool       has_volume_rows(const Problem<dim> &);                                                                               \
  template VolumeRows volume_rows(const Problem<dim> &, dealii::Vector<double> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
