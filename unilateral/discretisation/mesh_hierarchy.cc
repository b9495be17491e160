#include "unilateral/discretisation/mesh_hierarchy.h"

#include "unilateral/discretisation/cell_numbering.h"
#include "unilateral/discretisation/cell_systems.h"
#include "unilateral/discretisation/cells_in_order.h"
#include "unilateral/discretisation/vertex_volumes.h"
#include "unilateral/mesh/box_around.h"

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// The V-cycle knows nothing of convection. Up to here GMRES makes up for it in about as much time as algebraic multigrid takes.
    constexpr double largest_peclet_number = 100;

    /// |b| L / k where it is largest on the mesh at hand, L the length of the domain. Collective.
    template <int dim>
    double peclet_number(const Problem<dim> &problem)
    {
      double largest = 0;
      if (problem.symmetric())
        return largest;
      for (const auto &cell : problem.space.mesh.triangulation->active_cell_iterators())
        for (const unsigned v : cell->vertex_indices())
          largest = std::max(largest, problem.form->convection_to_diffusion(cell->material_id(), cell->vertex(v)));
      const Processes &processes = problem.space.processes();
      const auto [low, high] = box_around(*problem.space.mesh.triangulation, processes);
      return processes.max(largest) * low.distance(high);
    }

    /// Those of obstacle_to_multigrid() that triangles and tetrahedra have.
    template <int dim>
    std::string obstacle_of_simplices(const Problem<dim> &problem)
    {
      if (dim == 3)
        return "the mesh is made of tetrahedra";
      if (problem.space.mesh.curved || problem.space.mesh.curved_cells)
        return "its triangles have curved sides";
      if (!problem.statement.mesh.local.empty() || problem.statement.mesh.adapt)
        return "its triangles are refined in places";
      if (VertexVolumes<dim>::any(problem))
        return "changes of volume are averaged at vertices";
      return "";
    }
  } // namespace

  template <int dim>
  std::string obstacle_to_multigrid(const Problem<dim> &problem)
  {
    if (dim == 1)
      return "the mesh is one-dimensional";
    if (problem.space.element.family != ElementName::Family::Q && problem.space.element.family != ElementName::Family::P)
      return "it needs Lagrange elements";
    if (const std::string obstacle = problem.space.element.simplex() ? obstacle_of_simplices(problem) : ""; !obstacle.empty())
      return obstacle;
    if (!problem.space.couplings.periodic.empty())
      return "periodic parts tie unknowns across the mesh";
    if (!problem.space.couplings.rigid_parts.empty())
      return "a rigid part ties the unknowns of all its nodes";
    if (problem.space.element.degree > 6)
      return "the degree of the elements is above 6";
    if (problem.form->order() != 1)
      return "the problem is not of second order";
    if (problem.form->volume_to_shape_stiffness() > 1000)
      return "the material is as good as incompressible, no matter for its smoother";
    if (peclet_number(problem) > largest_peclet_number)
      return "convection is far stronger than diffusion";
    if (!problem.symmetric() && (!problem.statement.mesh.local.empty() || problem.statement.mesh.adapt))
      return "convection on a mesh that is refined in places";
    return "";
  }

  namespace
  {
    /// P_c for each child of a cell.
    template <int dim>
    void set_children(LevelHierarchy &hierarchy, const FiniteElement<dim> &fe, const CellNumbering<dim> &numbering)
    {
      hierarchy.to_child = prolongations_to_children(fe, numbering);
      hierarchy.n_children = hierarchy.to_child.size();
      hierarchy.n_components = numbering.n_components;
    }

    /// Matrices and load of a level, cell by cell in the order of the hierarchy.
    template <int dim>
    class LevelAssembly
    {
    public:
      LevelAssembly(const Problem<dim> &problem, const CellNumbering<dim> &numbering, const CellsInOrder<dim> &cells)
        : problem(problem), numbering(numbering), cells(cells), dirichlet(problem.space.dirichlet), n(numbering.size()),
          n_dofs(problem.space.dof_handler.n_dofs()), kind(n_dofs, free), load(n_dofs), systems(problem, numbering),
          dofs_of_cells(cells.n * n), matrix_of_cell(cells.n)
      {
        for (const auto &line : dirichlet.get_lines())
        {
          fixed.push_back(line.index);
          kind[line.index] = line.entries.empty() ? prescribed : dependent;
        }
      }

      /// @p n_children: of each cell of the level before.
      void integrate_cells(const unsigned n_children)
      {
        std::vector<types::global_dof_index> dofs(n), ordered(n);
        for (std::size_t k = 0; k < cells.n; ++k)
        {
          const auto cell = cells.at(k, problem.space.dof_handler);
          AssertThrow(!cells.all_of_one_level() || cell->level() == 0 ||
                        (cell->parent_index() == int(k / n_children) && cell->parent()->child_index(k % n_children) == int(k)),
                      ExcMessage("children do not follow each other"));
          cell->get_dof_indices(dofs);
          const auto &index = numbering.element_index(problem.space.corner_order(cell));
          bool        is_dependent = false;
          for (unsigned i = 0; i < n; ++i)
          {
            dofs_of_cells[k * n + i] = ordered[i] = dofs[index[i]];
            is_dependent |= kind[ordered[i]] == dependent;
          }
          matrix_of_cell[k] = systems.integrate(cell);
          if (is_dependent)
            add_dependent_cell(k, ordered);
          else
            add_load(matrix_of_cell[k], ordered);
        }
      }

      /// Springs, loads on boundary faces and at points.
      void add_systems_outside_cells()
      {
        for_each_local_system_outside_cells<dim>(
          problem,
          [&](const LocalSystem &local)
          {
            std::vector<double> matrix;
            for (unsigned i = 0; i < local.dofs.size(); ++i)
              for (unsigned j = 0; j < local.dofs.size(); ++j)
                matrix.push_back(local.matrix(i, j));
            const AffineDependence dependence(local.dofs, dirichlet);
            dependence.add_load(matrix.data(), local.load, load);
            auto block = dependence.condense(matrix.data());
            if (std::any_of(block.matrix.begin(), block.matrix.end(), [](const double a) { return a != 0; }))
              blocks.push_back(std::move(block));
          });
      }

      /// The sum over all processes, 0 where values are prescribed.
      Vector take_load()
      {
        problem.space.shared().add(load.begin());
        for (const auto dof : fixed)
          load(dof) = 0;
        return std::move(load);
      }

      /// None where A is symmetric. Before take_stiffness().
      std::unique_ptr<ConvectionOperator> take_convection()
      {
        if (systems.convection.empty())
          return nullptr;
        return std::make_unique<ConvectionOperator>(n_dofs, n, dofs_of_cells, matrix_of_cell, std::move(systems.convection), fixed);
      }

      /// A on patches of @p n_levels of refinement where the cells are all of one level.
      std::unique_ptr<CellOperator> take_stiffness(const unsigned n_levels)
      {
        std::vector<CellOperator::PatchGroup> groups;
        if (cells.all_of_one_level())
        {
          groups.push_back({patch_shape(numbering, n_levels), 0});
          groups.back().n_patches = cells.n / groups.back().shape.n_cells;
        }
        for (const auto &patches : cells.patches)
          groups.push_back({patch_shape(numbering, patches.n_levels), patches.n_patches});
        // The patches are asked for one after the other.
        std::size_t group = 0, end_of_group = groups[0].n_patches, next_cell = 0;
        const auto  patch_dofs = [&](const std::size_t patch, std::uint32_t *const dofs)
        {
          if (patch == end_of_group)
            end_of_group += groups[++group].n_patches;
          const PatchShape &shape = groups[group].shape;
          for (unsigned k = 0; k < shape.n_cells * n; ++k)
            dofs[shape.cell_dofs[k]] = dofs_of_cells[next_cell * n + k];
          next_cell += shape.n_cells;
        };
        return std::make_unique<CellOperator>(n_dofs, groups, patch_dofs, matrix_of_cell, systems.matrices, std::move(dependent_cells),
                                              std::move(blocks), std::move(fixed));
      }

      /// From the level before, where that was refined in places.
      SparseTransfer transfer_to_cells(const LevelHierarchy &hierarchy) const
      {
        std::vector<bool> is_free(n_dofs);
        std::transform(kind.begin(), kind.end(), is_free.begin(), [](const char k) { return k == free; });
        return transfer_in_places(hierarchy.finest(), hierarchy.to_child, cells.children, dofs_of_cells, is_free);
      }

    private:
      /// Of an unknown.
      enum Kind : char
      {
        free,
        prescribed,
        dependent ///< on others
      };

      void add_dependent_cell(const std::size_t k, const std::vector<types::global_dof_index> &dofs)
      {
        Assert(systems.convection.empty(), ExcInternalError()); // see obstacle_to_multigrid()
        const double *const    matrix = systems.matrices.data() + std::size_t(matrix_of_cell[k]) * n * n;
        const AffineDependence dependence(dofs, dirichlet);
        dependence.add_load(matrix, systems.load(), load);
        dependent_cells.push_back({std::uint32_t(k), dependence, {matrix, matrix + n * n}});
        matrix_of_cell[k] = -1;
      }

      /// f - A g of the cell that was integrated last, g the prescribed values.
      void add_load(const std::size_t number_of_matrix, const std::vector<types::global_dof_index> &dofs)
      {
        for (unsigned i = 0; i < n; ++i)
          load(dofs[i]) += systems.load()[i];
        const auto          place = number_of_matrix * n * n;
        const double *const matrix = systems.matrices.data() + place;
        const double *const convection = systems.convection.empty() ? nullptr : systems.convection.data() + place;
        for (unsigned j = 0; j < n; ++j)
          if (kind[dofs[j]] == prescribed)
            if (const double g = dirichlet.get_inhomogeneity(dofs[j]); g != 0)
              for (unsigned i = 0; i < n; ++i)
                load(dofs[i]) -= (matrix[i * n + j] + (convection ? convection[i * n + j] : 0.)) * g;
      }

      const Problem<dim>              &problem;
      const CellNumbering<dim>        &numbering;
      const CellsInOrder<dim>         &cells;
      const AffineConstraints<double> &dirichlet;
      const unsigned                   n; ///< unknowns of a cell
      const std::size_t                n_dofs;
      std::vector<std::uint32_t>       fixed; ///< prescribed and dependent unknowns
      std::vector<Kind>                kind;
      Vector                           load;
      CellSystems<dim>                 systems;
      std::vector<std::uint32_t>       dofs_of_cells;
      std::vector<std::int32_t>        matrix_of_cell;
      std::vector<DependentCell>       dependent_cells;
      std::vector<DenseBlock>          blocks;
    };

    /// The next level, with a transfer from the one before unless that has the same cells; returns f.
    template <int dim>
    Vector append_level(LevelHierarchy &hierarchy, const Problem<dim> &problem, const bool with_transfer)
    {
      const CellNumbering<dim> numbering(*problem.space.fe, problem.space.element.degree);
      constexpr unsigned       as_many_as_fit = 100;
      CellsInOrder<dim>        cells(hierarchy, problem, with_transfer, levels_of_patch(numbering, as_many_as_fit));
      if (hierarchy.levels.empty())
        set_children(hierarchy, *problem.space.fe, numbering);

      LevelAssembly<dim> assembly(problem, numbering, cells);
      assembly.integrate_cells(hierarchy.n_children);
      assembly.add_systems_outside_cells();
      Vector load = assembly.take_load();
      hierarchy.convection.reset(); // before the next one takes memory
      hierarchy.convection = assembly.take_convection();

      const unsigned refinements = hierarchy.levels.size() - hierarchy.level_of_last_cut();

      LevelHierarchy::Level level;
      level.shared = problem.space.shared();
      level.stiffness = assembly.take_stiffness(levels_of_patch(numbering, refinements));
      level.stiffness->complete_diagonal(level.shared);
      const auto running = problem.time_by_part.run("transfer");
      if (cells.all_of_one_level() || !with_transfer)
        level.sweep =
          std::make_unique<PatchSweep>(*level.stiffness, with_transfer ? hierarchy.levels.back().sweep.get() : nullptr, hierarchy.to_child);
      else
        level.sweep = std::make_unique<PatchSweep>(*level.stiffness, *hierarchy.levels.back().sweep, assembly.transfer_to_cells(hierarchy));
      level.children_in_places = std::move(cells.children);
      hierarchy.places = std::move(cells.places);
      hierarchy.levels.push_back(std::move(level));
      return load;
    }
  } // namespace

  template <int dim>
  Vector add_level(LevelHierarchy &hierarchy, const Problem<dim> &problem)
  {
    return append_level(hierarchy, problem, !hierarchy.levels.empty());
  }

  template <int dim>
  Vector load_on_finest(const LevelHierarchy &hierarchy, const Problem<dim> &problem)
  {
    const CellsInOrder<dim>  cells(hierarchy, problem);
    const CellNumbering<dim> numbering(*problem.space.fe, problem.space.element.degree);
    LevelAssembly<dim>       assembly(problem, numbering, cells);
    assembly.integrate_cells(hierarchy.n_children);
    assembly.add_systems_outside_cells();
    return assembly.take_load();
  }

  namespace
  {
    /// For each active cell its number on the finest level of @p hierarchy.
    template <int dim>
    std::vector<std::uint32_t> positions_of_active_cells(const LevelHierarchy &hierarchy, const Triangulation<dim> &triangulation)
    {
      std::vector<std::uint32_t> position(triangulation.n_active_cells());
      for (std::size_t k = 0; k < hierarchy.places.size(); ++k)
      {
        const typename Triangulation<dim>::cell_iterator cell(&triangulation, hierarchy.places[k].level, hierarchy.places[k].index);
        position[cell->active_cell_index()] = k;
      }
      if (hierarchy.places.empty())
        std::iota(position.begin(), position.end(), 0);
      return position;
    }
  } // namespace

  namespace
  {
    /// Those that no process with a lower rank of the same group has; its ranks among all are @p ranks_before and up.
    std::vector<std::uint32_t> first_of_group(const SharedUnknowns &shared, const std::size_t n_dofs, const unsigned ranks_before)
    {
      std::vector<char> is_first(n_dofs, true);
      for (const auto &neighbor : shared.all_neighbors())
        if (neighbor.rank >= ranks_before && neighbor.rank < shared.processes().rank())
          for (const auto dof : neighbor.dofs)
            is_first[dof] = false;
      std::vector<std::uint32_t> first;
      for (std::uint32_t dof = 0; dof < n_dofs; ++dof)
        if (is_first[dof])
          first.push_back(dof);
      return first;
    }
  } // namespace

  template <int dim>
  void add_own_part(LevelHierarchy &hierarchy, const Problem<dim> &problem, const Processes &group)
  {
    const auto &subdomain = *problem.space.subdomain;
    const auto  position = positions_of_active_cells(hierarchy, *subdomain.whole.triangulation);
    auto       &cut = hierarchy.cuts.emplace_back();
    cut.level = hierarchy.levels.size();
    cut.group = group;
    append_level(hierarchy, problem, false);
    cut.cells.resize(subdomain.own_active_cells.size());
    const auto position_in_part = positions_of_active_cells(hierarchy, *problem.space.mesh.triangulation);
    for (std::size_t k = 0; k < cut.cells.size(); ++k)
      cut.cells[position_in_part[k]] = position[subdomain.own_active_cells[k]];
    const auto &whole = *hierarchy.levels[cut.level - 1].stiffness, &part = hierarchy.finest();
    cut.to_whole.resize(part.n_dofs());
    std::vector<std::uint32_t> in_whole(part.n_cell_dofs()), in_part(part.n_cell_dofs());
    for (std::size_t cell = 0; cell < part.n_cells(); ++cell)
    {
      whole.cell_dofs(cut.cells[cell], in_whole.data());
      part.cell_dofs(cell, in_part.data());
      for (unsigned i = 0; i < in_part.size(); ++i)
        cut.to_whole[in_part[i]] = in_whole[i];
    }
    const SharedUnknowns &shared = hierarchy.levels.back().shared;
    cut.contributed = first_of_group(shared, part.n_dofs(), shared.processes().rank() - group.rank());
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::string obstacle_to_multigrid(const Problem<dim> &);                                                                        \
  template Vector      add_level(LevelHierarchy &, const Problem<dim> &);                                                                  \
  template Vector      load_on_finest(const LevelHierarchy &, const Problem<dim> &);                                                       \
  template void        add_own_part(LevelHierarchy &, const Problem<dim> &, const Processes &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
