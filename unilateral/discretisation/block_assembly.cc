#include "unilateral/discretisation/block_assembly.h"

#include "unilateral/base/sort_unique.h"
#include "unilateral/discretisation/cell_systems.h"

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    bool all_free(const std::vector<types::global_dof_index> &dofs, const AffineConstraints<double> &dirichlet)
    {
      return std::none_of(dofs.begin(), dofs.end(), [&](const auto dof) { return dirichlet.is_constrained(dof); });
    }

    /// Those on which unknowns @p dofs depend, or they themselves, node by node.
    void free_nodes(const std::vector<types::global_dof_index> &dofs,
                    const AffineConstraints<double>            &dirichlet,
                    const unsigned                              block_size,
                    std::vector<std::uint32_t>                 &nodes)
    {
      nodes.clear();
      for (const auto dof : dofs)
        if (!dirichlet.is_constrained(dof))
          nodes.push_back(dof / block_size);
        else
          for (const auto &[master, weight] : *dirichlet.get_constraint_entries(dof))
            nodes.push_back(master / block_size);
      sort_unique(nodes);
    }

    template <int dim>
    SymmetricBlockMatrix with_pattern_of_cells(const Problem<dim> &problem, const unsigned block_size)
    {
      const auto                          &dof_handler = problem.space.dof_handler;
      std::vector<types::global_dof_index> dofs(problem.space.fe->n_dofs_per_cell());
      std::vector<std::size_t>             start = {0};
      std::vector<std::uint32_t>           nodes, of_cell;
      for (const auto &cell : dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        free_nodes(dofs, problem.space.dirichlet, block_size, of_cell);
        nodes.insert(nodes.end(), of_cell.begin(), of_cell.end());
        start.push_back(nodes.size());
      }
      return {block_size, dof_handler.n_dofs() / block_size, start, nodes};
    }
  } // namespace

  template <int dim>
  SymmetricBlockMatrix
  assemble_blocks(const Problem<dim> &problem, const unsigned block_size, const Volumes volumes, dealii::Vector<double> &load)
  {
    const AffineConstraints<double> &dirichlet = problem.space.dirichlet;
    SymmetricBlockMatrix             A = with_pattern_of_cells(problem, block_size);
    std::vector<std::uint32_t>       unknowns;
    for_each_local_system<dim>(
      problem,
      [&](const LocalSystem &local)
      {
        dirichlet.distribute_local_to_global(local.load, local.dofs, load, local.matrix);
        const double *const matrix = &local.matrix(0, 0); // row by row
        if (all_free(local.dofs, dirichlet))
        {
          unknowns.assign(local.dofs.begin(), local.dofs.end());
          A.add(unknowns, matrix);
          return;
        }
        const DenseBlock block = AffineDependence(local.dofs, dirichlet).condense(matrix);
        A.add(block.dofs, block.matrix.data());
        for (unsigned i = 0; i < local.dofs.size(); ++i)
          if (dirichlet.is_constrained(local.dofs[i]))
            A.add_to_diagonal(local.dofs[i], std::abs(local.matrix(i, i)));
      },
      volumes);
    for (const auto &line : dirichlet.get_lines())
      if (!(A.diagonal_entry(line.index) > 0))
        A.add_to_diagonal(line.index, 1.);
    return A;
  }

  template <int dim>
  bool nodes_are_blocks(const Problem<dim> &problem)
  {
    const auto                          &fe = *problem.space.fe;
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      for (unsigned i = 0; i < dofs.size(); ++i)
      {
        const auto [component, shape] = fe.system_to_component_index(i);
        if (dofs[i] % fe.n_components() != component || dofs[fe.component_to_system_index(0, shape)] + component != dofs[i])
          return false;
      }
    }
    return true;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template SymmetricBlockMatrix assemble_blocks(const Problem<dim> &, unsigned, Volumes, dealii::Vector<double> &);                        \
  template bool                 nodes_are_blocks(const Problem<dim> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
