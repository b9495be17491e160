#include "unilateral/spaces/interpolation_to_refined_cells.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// A value at a node of a fine cell is a sum over values on siblings of its parent.
    struct Term
    {
      unsigned sibling, dof; ///< the sibling's number among the children of the cell they come from, the unknown in it
      double   weight;
    };

    constexpr double negligible = 1e-14;

    /// Degrees up to this one are doubled: between more nodes, polynomials oscillate where the function is not smooth.
    constexpr unsigned largest_degree_to_double = 2;

    template <int dim>
    std::vector<std::vector<std::vector<Term>>> interpolation_in_parent(const FiniteElement<dim> &fe)
    {
      constexpr unsigned                          n_children = GeometryInfo<dim>::max_children_per_cell;
      std::vector<std::vector<std::vector<Term>>> rows(n_children);
      for (unsigned c = 0; c < n_children; ++c)
      {
        const auto &P = fe.get_prolongation_matrix(c);
        rows[c].resize(fe.n_dofs_per_cell());
        for (unsigned i = 0; i < fe.n_dofs_per_cell(); ++i)
          for (unsigned j = 0; j < fe.n_dofs_per_cell(); ++j)
            if (std::abs(P(i, j)) > negligible)
              rows[c][i].push_back({0, j, P(i, j)});
      }
      return rows;
    }

    /// For [sibling][child] the polynomial of twice the degree on all siblings, whose nodes are theirs.
    template <int dim>
    std::vector<std::vector<std::vector<Term>>> interpolation_in_siblings(const FiniteElement<dim> &fe)
    {
      using Cell = GeometryInfo<dim>;
      constexpr unsigned n_children = Cell::max_children_per_cell;
      const unsigned     n = fe.n_dofs_per_cell();
      Assert(fe.degree <= largest_degree_to_double, ExcMessage("nodes of higher degree are not equidistant"));
      const FE_Q<dim> wide(QIterated<1>(QTrapezoid<1>(), 2 * fe.degree));

      // Who has a value at each node of the wide element: of the siblings that share it, the first.
      std::vector<std::vector<Term>> at_node(wide.n_dofs_per_cell());
      for (unsigned k = 0; k < wide.n_dofs_per_cell(); ++k)
        for (unsigned component = 0; component < fe.n_components(); ++component)
          for (unsigned s = 0; s < n_children && at_node[k].size() == component; ++s)
            for (unsigned i = 0; i < n; ++i)
              if (fe.system_to_component_index(i).first == component &&
                  Cell::child_to_cell_coordinates(fe.unit_support_point(i), s).distance(wide.unit_support_point(k)) < 1e-8)
                at_node[k].push_back({s, i, 1.});

      std::vector<std::vector<std::vector<Term>>> rows(n_children * n_children);
      for (unsigned s = 0; s < n_children; ++s)
        for (unsigned c = 0; c < n_children; ++c)
        {
          auto &of_cell = rows[s * n_children + c];
          of_cell.resize(n);
          for (unsigned i = 0; i < n; ++i)
          {
            const Point<dim> x = Cell::child_to_cell_coordinates(Cell::child_to_cell_coordinates(fe.unit_support_point(i), c), s);
            const unsigned   component = fe.system_to_component_index(i).first;
            for (unsigned k = 0; k < wide.n_dofs_per_cell(); ++k)
              if (const double weight = wide.shape_value(k, x); std::abs(weight) > negligible)
                of_cell[i].push_back({at_node[k][component].sibling, at_node[k][component].dof, weight});
          }
        }
      return rows;
    }
  } // namespace

  template <int dim>
  InterpolationToRefinedCells<dim>::InterpolationToRefinedCells(const DoFHandler<dim>         &coarse,
                                                                const std::vector<VectorType> &functions,
                                                                const bool                     smoothly)
    : cell_values(functions.size())
  {
    const auto &triangulation = coarse.get_triangulation();
    number.resize(triangulation.n_levels());
    for (unsigned level = 0; level < number.size(); ++level)
      number[level].assign(triangulation.n_raw_cells(level), none);
    unsigned n_cells = 0;
    for (const auto &cell : coarse.active_cell_iterators())
      number[cell->level()][cell->index()] = n_cells++;

    if (smoothly && coarse.get_fe().n_dofs_per_vertex() > 0 && coarse.get_fe().degree <= largest_degree_to_double)
    {
      family.assign(n_cells, none);
      child_of_family.resize(n_cells);
      for (unsigned level = 0; level + 1 < number.size(); ++level)
        for (const auto &parent : triangulation.cell_iterators_on_level(level))
        {
          if (parent->is_active())
            continue;
          Siblings siblings;
          for (unsigned s = 0; s < n_children; ++s)
            siblings[s] = number[level + 1][parent->child_index(s)];
          if (std::find(siblings.begin(), siblings.end(), none) != siblings.end())
            continue;
          for (unsigned s = 0; s < n_children; ++s)
          {
            family[siblings[s]] = families.size();
            child_of_family[siblings[s]] = s;
          }
          families.push_back(siblings);
        }
    }
    const unsigned                       n = coarse.get_fe().n_dofs_per_cell();
    std::vector<types::global_dof_index> dofs(n);
    for (auto &values : cell_values)
      values.resize(n_cells * std::size_t(n));
    std::size_t place = 0;
    for (const auto &cell : coarse.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      for (unsigned i = 0; i < n; ++i, ++place)
        for (std::size_t f = 0; f < functions.size(); ++f)
          cell_values[f][place] = functions[f](dofs[i]);
    }
  }

  template <int dim>
  void InterpolationToRefinedCells<dim>::keep_cells(const std::vector<unsigned> &cells)
  {
    kept = cells;
  }

  template <int dim>
  void InterpolationToRefinedCells<dim>::interpolate(const DoFHandler<dim> &fine, std::vector<VectorType> &functions) const
  {
    const auto    &fe = fine.get_fe();
    const unsigned n = fe.n_dofs_per_cell();
    const auto     in_parent = interpolation_in_parent(fe), in_siblings = families.empty() ? in_parent : interpolation_in_siblings(fe);
    for (auto &function : functions)
      function.reinit(fine.n_dofs());
    std::vector<types::global_dof_index> dofs(n);
    std::vector<char>                    known(fine.n_dofs(), false); // cells that share an unknown agree on it
    for (const auto &cell : fine.active_cell_iterators())
    {
      const auto number_of = [&](const unsigned level, const unsigned index)
      {
        if (!kept.empty())
          return level == 0 ? kept[index] : none;
        return level < number.size() && index < number[level].size() ? number[level][index] : none;
      };
      cell->get_dof_indices(dofs);
      const unsigned same = number_of(cell->level(), cell->index());
      if (same != none)
      {
        for (unsigned i = 0; i < n; ++i)
          if (!std::exchange(known[dofs[i]], true))
            for (std::size_t f = 0; f < functions.size(); ++f)
              functions[f](dofs[i]) = cell_values[f][std::size_t(same) * n + i];
        continue;
      }
      const auto     parent = cell->parent();
      const unsigned coarse = number_of(parent->level(), parent->index());
      AssertThrow(coarse != none, ExcMessage("a cell of the finer mesh lies in no cell of the coarser one"));
      unsigned child = cell->index() % n_children;
      if (parent->child_index(child) != cell->index())
        for (child = 0; parent->child_index(child) != cell->index();)
          ++child;
      Siblings    siblings{coarse};
      const auto *rows = &in_parent;
      if (!family.empty() && family[coarse] != none)
      {
        siblings = families[family[coarse]];
        child += child_of_family[coarse] * n_children;
        rows = &in_siblings;
      }
      for (unsigned i = 0; i < n; ++i)
      {
        if (std::exchange(known[dofs[i]], true))
          continue;
        for (std::size_t f = 0; f < functions.size(); ++f)
        {
          double sum = 0;
          for (const Term &term : (*rows)[child][i])
            sum += term.weight * cell_values[f][std::size_t(siblings[term.sibling]) * n + term.dof];
          functions[f](dofs[i]) = sum;
        }
      }
    }
  }

  template class InterpolationToRefinedCells<1>;
  template class InterpolationToRefinedCells<2>;
  template class InterpolationToRefinedCells<3>;
} // namespace unilateral
