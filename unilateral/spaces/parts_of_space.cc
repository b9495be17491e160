// How V_h on a mesh becomes V_h on a part of it, and on another part.
#include "unilateral/base/byte_archive.h"
#include "unilateral/mesh/division.h"
#include "unilateral/mesh/sent_part.h"
#include "unilateral/spaces/cell_mapping.h"
#include "unilateral/spaces/function_space.h"
#include "unilateral/spaces/neighbor_parts.h"
#include "unilateral/spaces/simplex_element.h"

#include <deal.II/fe/fe_q.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// One cell after the other.
    template <int dim>
    std::vector<double> values_by_cell(const DoFHandler<dim> &dof_handler, const LinearAlgebra::distributed::Vector<double> &function)
    {
      std::vector<double>                  values;
      std::vector<types::global_dof_index> dofs(dof_handler.get_fe().n_dofs_per_cell());
      for (const auto &cell : dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        for (const auto dof : dofs)
          values.push_back(function(dof));
      }
      return values;
    }

    /// @p own_cells: for each active cell of the part its number in the whole, which has @p values_in_whole.
    template <int dim>
    LinearAlgebra::distributed::Vector<double>
    function_of_part(const DoFHandler<dim> &part, const std::vector<unsigned> &own_cells, const std::vector<double> &values_in_whole)
    {
      LinearAlgebra::distributed::Vector<double> function(part.n_dofs());
      std::vector<types::global_dof_index>       dofs(part.get_fe().n_dofs_per_cell());
      for (const auto &cell : part.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        for (unsigned i = 0; i < dofs.size(); ++i)
          function(dofs[i]) = values_in_whole[std::size_t(own_cells[cell->active_cell_index()]) * dofs.size() + i];
      }
      return function;
    }

    /// Linear functions: their unknowns are the vertices.
    template <int dim>
    std::unique_ptr<DoFHandler<dim>> vertices_of(const Triangulation<dim> &triangulation, const bool simplex)
    {
      auto linear = std::make_unique<DoFHandler<dim>>(triangulation);
      if (simplex)
        linear->distribute_dofs(*make_simplex_element<dim>(1));
      else
        linear->distribute_dofs(FE_Q<dim>(1));
      return linear;
    }
  } // namespace

  template <int dim>
  void FunctionSpace<dim>::keep_own_part(DirichletData<dim> &data,
                                         const Processes    &processes,
                                         Division            division,
                                         const unsigned      n_alike,
                                         Functions          &functions,
                                         const bool          refined_next)
  {
    if constexpr (dim > 1)
    {
      NeighborParts neighbors;
      if (subdomain)
      {
        const auto linear = vertices_of(*mesh.triangulation, element.simplex());
        neighbors = find_neighbor_parts(*linear, shared(*linear), division.owner);
      }
      std::vector<std::vector<double>> by_cell;
      if (element.simplex() || hermite() || !refined_next || division.owner.size() < mesh.triangulation->n_active_cells())
        for (const auto &function : functions)
          by_cell.push_back(values_by_cell(dof_handler, function));
      else if (!functions.empty())
        carried_to_part = std::make_unique<InterpolationToRefinedCells<dim>>(dof_handler, functions, /*smoothly=*/true);
      dof_handler.clear();
      subdomain = cut_out_subdomain(mesh, level, processes, std::move(division), std::move(subdomain), neighbors);
      subdomain->n_alike = n_alike;
      if (carried_to_part)
        carried_to_part->keep_cells(subdomain->own_cells);
      if (!corner_orders.empty())
      {
        std::vector<CornerOrder> orders_of_part;
        for (const unsigned cell : subdomain->own_cells)
          orders_of_part.push_back(corner_orders[cell]);
        corner_orders = std::move(orders_of_part);
      }
      lines_cut_by_refinement.clear();
      data.conditions.resize(mesh.part_names.size());
      place_cells(*mapping, mesh);
      distribute_dofs(data);
      for (std::size_t k = 0; k < by_cell.size(); ++k)
        functions[k] = function_of_part(dof_handler, subdomain->own_active_cells, by_cell[k]);
    }
  }

  template <int dim>
  bool FunctionSpace<dim>::can_be_divided_anew() const
  {
    if constexpr (dim == 1)
      return false;
    else
    {
      const bool ties_nodes = !couplings.rigid_parts.empty() || !couplings.periodic.empty();
      return subdomain && subdomain->n_alike == 1 && (element.simplex() || level == 0) &&
             !processes().any(ties_nodes || !can_be_sent(mesh));
    }
  }

  namespace
  {
    /// For each active cell of the own part who is to have it, by bisection of all of them on the first process.
    template <int dim>
    std::vector<unsigned> owners_by_weight(const Triangulation<dim> &part, const std::vector<double> &weights, const Processes &processes)
    {
      struct Cell
      {
        std::array<double, dim> center;
        double                  weight;
      };
      std::vector<Cell> own;
      for (const auto &cell : part.active_cell_iterators())
      {
        auto            &entry = own.emplace_back();
        const Point<dim> center = cell->center();
        for (unsigned d = 0; d < dim; ++d)
          entry.center[d] = center[d];
        entry.weight = weights[cell->active_cell_index()];
      }
      const auto bytes_of = [](const auto &list)
      {
        ByteWriter writer;
        writer(list);
        return std::move(writer.bytes);
      };
      std::vector<std::vector<char>> to_each(processes.size());
      to_each[0] = bytes_of(own);
      const auto from_each = processes.exchange(std::move(to_each));
      to_each.assign(processes.size(), {});
      if (processes.rank() == 0)
      {
        std::vector<Point<dim>>  centers;
        std::vector<double>      weight_of_cell;
        std::vector<std::size_t> end;
        for (const auto &bytes : from_each)
        {
          std::vector<Cell> cells;
          ByteReader        reader(bytes);
          reader(cells);
          for (const Cell &cell : cells)
          {
            auto &center = centers.emplace_back();
            for (unsigned d = 0; d < dim; ++d)
              center[d] = cell.center[d];
            weight_of_cell.push_back(cell.weight);
          }
          end.push_back(centers.size());
        }
        const std::vector<unsigned> owner = bisect(centers, processes.size(), weight_of_cell);
        for (unsigned rank = 0; rank < processes.size(); ++rank)
          to_each[rank] = bytes_of(std::vector<unsigned>(owner.begin() + (rank == 0 ? 0 : end[rank - 1]), owner.begin() + end[rank]));
      }
      std::vector<unsigned> owner;
      const auto            answers = processes.exchange(std::move(to_each));
      ByteReader            reader(answers[0]);
      reader(owner);
      return owner;
    }

    bool all_have_cells(const std::vector<unsigned> &owner, const Processes &processes)
    {
      std::vector<std::uint64_t> n_cells(processes.size(), 0);
      for (const unsigned rank : owner)
        ++n_cells[rank];
      processes.sum(n_cells.data(), n_cells.size());
      return std::find(n_cells.begin(), n_cells.end(), 0) == n_cells.end();
    }
  } // namespace

  template <int dim>
  bool FunctionSpace<dim>::divide_anew(const DirichletData<dim>  &data,
                                       const std::vector<double> &weights,
                                       Functions                 &functions,
                                       std::vector<bool>         &marks)
  {
    if constexpr (dim > 1)
    {
      const Processes all = processes();
      const auto      owner = owners_by_weight(*mesh.triangulation, weights, all);
      if (!all_have_cells(owner, all))
        return false;
      std::vector<std::vector<char>> cells(all.size()), values(all.size());
      {
        const auto                       linear = vertices_of(*mesh.triangulation, element.simplex());
        const auto                       neighbors = find_neighbor_parts(*linear, shared(*linear), owner);
        const PartsToSend<dim>           parts(mesh, *subdomain, all.sum_of_lower_ranks(owner.size()), owner, neighbors);
        const unsigned                   n = fe->n_dofs_per_cell();
        std::vector<std::vector<double>> by_cell;
        for (const auto &function : functions)
          by_cell.push_back(values_by_cell(dof_handler, function));
        for (unsigned rank = 0; rank < all.size(); ++rank)
        {
          cells[rank] = parts.bytes_for(rank);
          ByteWriter writer;
          for (const unsigned cell : parts.cells_for(rank))
          {
            writer(char(marks.empty() ? false : marks[cell]));
            for (const auto &values_of_function : by_cell)
              writer(std::vector<double>(values_of_function.begin() + std::size_t(cell) * n,
                                         values_of_function.begin() + std::size_t(cell + 1) * n));
          }
          values[rank] = std::move(writer.bytes);
        }
      }
      dof_handler.clear();
      auto part = unpack_part<dim>(all.exchange(std::move(cells)), all);
      part.subdomain->level = level;
      mesh = std::move(part.mesh);
      subdomain = std::move(part.subdomain);
      lines_cut_by_refinement.clear();
      if (!corner_orders.empty())
        corner_orders = orders_by_shortest_diagonal(*mesh.triangulation);
      mapping = make_mapping<dim>(element, mesh);
      place_cells(*mapping, mesh);
      distribute_dofs(data);

      const bool                       has_marks = !marks.empty();
      std::vector<unsigned>            in_sequence_of_cells;
      std::vector<std::vector<double>> by_cell(functions.size());
      marks.clear();
      for (const auto &bytes : all.exchange(std::move(values)))
        for (ByteReader reader(bytes); !reader.at_end();)
        {
          char mark = false;
          reader(mark);
          if (has_marks)
            marks.push_back(mark);
          for (auto &values_of_function : by_cell)
          {
            std::vector<double> values_on_cell;
            reader(values_on_cell);
            values_of_function.insert(values_of_function.end(), values_on_cell.begin(), values_on_cell.end());
          }
          in_sequence_of_cells.push_back(in_sequence_of_cells.size());
        }
      for (std::size_t k = 0; k < by_cell.size(); ++k)
        functions[k] = function_of_part(dof_handler, in_sequence_of_cells, by_cell[k]);
    }
    return true;
  }

  template void FunctionSpace<1>::keep_own_part(DirichletData<1> &, const Processes &, Division, unsigned, Functions &, bool);
  template void FunctionSpace<2>::keep_own_part(DirichletData<2> &, const Processes &, Division, unsigned, Functions &, bool);
  template void FunctionSpace<3>::keep_own_part(DirichletData<3> &, const Processes &, Division, unsigned, Functions &, bool);
  template bool FunctionSpace<1>::can_be_divided_anew() const;
  template bool FunctionSpace<2>::can_be_divided_anew() const;
  template bool FunctionSpace<3>::can_be_divided_anew() const;
  template bool FunctionSpace<1>::divide_anew(const DirichletData<1> &, const std::vector<double> &, Functions &, std::vector<bool> &);
  template bool FunctionSpace<2>::divide_anew(const DirichletData<2> &, const std::vector<double> &, Functions &, std::vector<bool> &);
  template bool FunctionSpace<3>::divide_anew(const DirichletData<3> &, const std::vector<double> &, Functions &, std::vector<bool> &);
} // namespace unilateral
