#include "unilateral/spaces/linear_subspaces.h"

#include "unilateral/spaces/hanging_nodes.h"

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace unilateral
{
  using namespace dealii;
  using types::global_dof_index;

  namespace
  {
    constexpr global_dof_index none = numbers::invalid_dof_index;

    /// Linear functions on one mesh.
    struct LinearFunctions
    {
      std::vector<global_dof_index> at_vertex; ///< of each unknown, that of V_h with the same vertex and component
      std::vector<global_dof_index> of_dof;    ///< the inverse; none for other unknowns of V_h
      AffineConstraints<double>     hanging;   ///< nodes

      void invert(const std::size_t n_dofs)
      {
        of_dof.assign(n_dofs, none);
        for (global_dof_index j = 0; j < at_vertex.size(); ++j)
          if (at_vertex[j] != none)
            of_dof[at_vertex[j]] = j;
      }
    };

    template <int dim>
    std::unique_ptr<FiniteElement<dim>> linear_element(const FunctionSpace<dim> &space)
    {
      const unsigned n = space.fe->n_components();
      if (space.element.simplex())
        return std::make_unique<FESystem<dim>>(FE_SimplexP<dim>(1), n);
      return std::make_unique<FESystem<dim>>(FE_Q<dim>(1), n);
    }

    /// Adds rows to a prolongation.
    class Rows
    {
    public:
      Rows(OwnSparseRows &rows, const LinearFunctions &functions, const AffineConstraints<double> &dirichlet)
        : rows(rows), functions(functions), dirichlet(dirichlet)
      {
        rows.n_columns = functions.at_vertex.size();
      }

      /// In terms of what conditions leave free. Dirichlet conditions that tie a vertex to a node that is none are left out.
      void add(const global_dof_index unknown, const double value)
      {
        const auto add_entries = [&](const auto &entries, const auto &number)
        {
          for (const auto &[dof, factor] : entries)
            row.emplace_back(number(dof), factor * value);
        };
        if (functions.hanging.is_constrained(unknown))
        {
          for (const auto &[other, factor] : *functions.hanging.get_constraint_entries(unknown))
            add(other, factor * value);
          return;
        }
        const global_dof_index dof = functions.at_vertex[unknown];
        const auto             number = [&](const global_dof_index of_space) { return functions.of_dof[of_space]; };
        if (dirichlet.is_constrained(dof))
        {
          const auto &entries = *dirichlet.get_constraint_entries(dof);
          if (std::all_of(entries.begin(), entries.end(), [&](const auto &entry) { return number(entry.first) != none; }))
            return add_entries(entries, number);
        }
        row.emplace_back(unknown, value);
      }

      void end_row()
      {
        std::sort(row.begin(), row.end());
        for (const auto &[unknown, value] : row)
          if (rows.columns.size() > rows.row_start.back() && rows.columns.back() == unknown)
            rows.values.back() += value;
          else
          {
            rows.columns.push_back(unknown);
            rows.values.push_back(value);
          }
        rows.row_start.push_back(rows.columns.size());
        row.clear();
      }

    private:
      OwnSparseRows                                   &rows;
      const LinearFunctions                           &functions;
      const AffineConstraints<double>                 &dirichlet;
      std::vector<std::pair<global_dof_index, double>> row;
    };

    /// From V_1 to V_h, of a higher degree and on the same mesh.
    template <int dim>
    OwnSparseRows prolongation_to_higher_degree(const FunctionSpace<dim> &space, LinearFunctions &functions)
    {
      const auto     &fe = *space.fe;
      const auto      linear_fe = linear_element(space);
      DoFHandler<dim> linear(*space.mesh.triangulation);
      linear.distribute_dofs(*linear_fe);
      functions.hanging.copy_from(constraints_at_hanging_nodes(linear));
      functions.at_vertex.resize(linear.n_dofs());

      struct Place // a cell at an unknown, and the unknown's number on it
      {
        typename DoFHandler<dim>::active_cell_iterator cell;
        unsigned                                       i = numbers::invalid_unsigned_int;
      };
      std::vector<Place>            places(space.dof_handler.n_dofs());
      std::vector<global_dof_index> dofs(fe.n_dofs_per_cell()), linear_dofs(linear_fe->n_dofs_per_cell());
      auto                          linear_cell = linear.begin_active();
      for (const auto &cell : space.dof_handler.active_cell_iterators())
      {
        for (const unsigned v : cell->vertex_indices())
          for (unsigned c = 0; c < fe.n_components(); ++c)
            functions.at_vertex[linear_cell->vertex_dof_index(v, c)] = cell->vertex_dof_index(v, c);
        cell->get_dof_indices(dofs);
        for (unsigned i = 0; i < dofs.size(); ++i)
          places[dofs[i]] = {linear_cell, i};
        ++linear_cell;
      }
      functions.invert(space.dof_handler.n_dofs());

      OwnSparseRows result;
      Rows          rows(result, functions, space.dirichlet);
      for (global_dof_index dof = 0; dof < places.size(); ++dof)
      {
        if (const auto &[cell, i] = places[dof]; !space.dirichlet.is_constrained(dof))
        {
          cell->get_dof_indices(linear_dofs);
          const unsigned   component = fe.system_to_component_index(i).first;
          const Point<dim> x = fe.unit_support_point(i);
          for (unsigned j = 0; j < linear_dofs.size(); ++j)
            if (const double value = linear_fe->shape_value_component(j, x, component); std::abs(value) > 1e-12)
              rows.add(linear_dofs[j], value);
        }
        rows.end_row();
      }
      return result;
    }

    /// Of V_h of degree 1 itself.
    template <int dim>
    LinearFunctions functions_of(const FunctionSpace<dim> &space)
    {
      LinearFunctions functions;
      functions.at_vertex.resize(space.dof_handler.n_dofs());
      for (global_dof_index dof = 0; dof < functions.at_vertex.size(); ++dof)
        functions.at_vertex[dof] = dof;
      functions.invert(functions.at_vertex.size());
      return functions;
    }

    /// The unknowns of V_h by vertex and component.
    template <int dim>
    std::vector<global_dof_index> dofs_at_vertices(const FunctionSpace<dim> &space)
    {
      const unsigned                n_components = space.fe->n_components();
      std::vector<global_dof_index> result(space.mesh.triangulation->n_vertices() * n_components, none);
      for (const auto &cell : space.dof_handler.active_cell_iterators())
        for (const unsigned v : cell->vertex_indices())
          for (unsigned c = 0; c < n_components; ++c)
            result[cell->vertex_index(v) * n_components + c] = cell->vertex_dof_index(v, c);
      return result;
    }
  } // namespace

  template <int dim>
  LinearSubspaces linear_subspaces(const FunctionSpace<dim> &space)
  {
    LinearSubspaces result;
    LinearFunctions functions;
    if (space.element.degree > 1)
    {
      result.prolongations.push_back(prolongation_to_higher_degree(space, functions));
      result.at_vertex.push_back(functions.at_vertex);
    }
    else
      functions = functions_of(space);

    const auto                    dofs = dofs_at_vertices(space);
    const unsigned                n_components = space.fe->n_components();
    std::vector<global_dof_index> place(space.dof_handler.n_dofs(), none); // in dofs, of each unknown of V_h
    for (std::size_t k = 0; k < dofs.size(); ++k)
      if (dofs[k] != none)
        place[dofs[k]] = k;
    std::size_t n_vertices = space.mesh.triangulation->n_vertices();
    for (auto lines = space.lines_cut_by_refinement.rbegin(); lines != space.lines_cut_by_refinement.rend(); ++lines)
    {
      n_vertices -= lines->size(); // the vertices of the coarser mesh come first
      LinearFunctions coarser;
      coarser.at_vertex.assign(dofs.begin(), dofs.begin() + n_vertices * n_components);
      coarser.invert(space.dof_handler.n_dofs());
      auto &prolongation = result.prolongations.emplace_back();
      Rows  rows(prolongation, coarser, space.dirichlet);
      for (const global_dof_index dof : functions.at_vertex)
      {
        if (dof != none && !space.dirichlet.is_constrained(dof)) // none: no cell has the vertex
        {
          const std::size_t vertex = place[dof] / n_components, component = place[dof] % n_components;
          if (vertex < n_vertices)
            rows.add(place[dof], 1.);
          else
            for (const std::size_t end : {(*lines)[vertex - n_vertices].first, (*lines)[vertex - n_vertices].second})
              rows.add(end * n_components + component, 0.5);
        }
        rows.end_row();
      }
      functions = std::move(coarser);
      result.at_vertex.push_back(functions.at_vertex);
    }
    return result;
  }

  Vector values_at_vertices(const Vector &function, const std::vector<global_dof_index> &at_vertex)
  {
    Vector values(at_vertex.size());
    for (std::size_t j = 0; j < at_vertex.size(); ++j)
      if (at_vertex[j] != none)
        values(j) = function(at_vertex[j]);
    return values;
  }

  template LinearSubspaces linear_subspaces(const FunctionSpace<1> &);
  template LinearSubspaces linear_subspaces(const FunctionSpace<2> &);
  template LinearSubspaces linear_subspaces(const FunctionSpace<3> &);
} // namespace unilateral
