#include "unilateral/discretisation/cells_in_order.h"

#include <algorithm>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Of cells that are no patch and no part of one.
    constexpr int irregular = -1;

    /// Of each cell of each level of the triangulation how many levels down all its descendants lie that are not refined; `irregular` where
    /// they lie at different levels, at more than @p most, or have unknowns that depend on others.
    template <int dim>
    std::vector<std::vector<int>> levels_below(const Problem<dim> &problem, const int most)
    {
      const auto                          &triangulation = *problem.space.mesh.triangulation;
      const auto                          &dof_handler = problem.space.dof_handler;
      std::vector<std::vector<int>>        below(triangulation.n_levels());
      std::vector<bool>                    depends(dof_handler.n_dofs(), false);
      std::vector<types::global_dof_index> dofs(problem.space.fe->n_dofs_per_cell());
      for (const auto &line : problem.space.dirichlet.get_lines())
        depends[line.index] = !line.entries.empty();
      for (unsigned level = triangulation.n_levels(); level-- > 0;)
      {
        below[level].assign(triangulation.n_raw_cells(level), irregular);
        for (const auto &cell : triangulation.cell_iterators_on_level(level))
        {
          int &n = below[level][cell->index()];
          if (cell->is_active())
          {
            typename DoFHandler<dim>::active_cell_iterator(&triangulation, level, cell->index(), &dof_handler)->get_dof_indices(dofs);
            n = std::any_of(dofs.begin(), dofs.end(), [&](const auto dof) { return depends[dof]; }) ? irregular : 0;
            continue;
          }
          const int first = below[level + 1][cell->child_index(0)];
          bool      alike = first != irregular && first < most;
          for (unsigned child = 1; child < cell->n_children(); ++child)
            alike = alike && below[level + 1][cell->child_index(child)] == first;
          n = alike ? first + 1 : irregular;
        }
      }
      return below;
    }
  } // namespace

  template <int dim>
  CellsInOrder<dim>::CellsInOrder(const LevelHierarchy &hierarchy,
                                  const Problem<dim>   &problem,
                                  const bool            follows_another,
                                  const unsigned        most_levels)
    : n(problem.space.mesh.triangulation->n_active_cells()), triangulation(*problem.space.mesh.triangulation),
      depth(triangulation.n_levels() - 1)
  {
    if (follows_another
          ? hierarchy.places.empty() && n == triangulation.n_cells(depth) && n == hierarchy.n_children * hierarchy.finest().n_cells()
          : depth == 0)
      return;
    put_in_order(problem, most_levels);
    if (follows_another)
      find_children(hierarchy);
  }

  template <int dim>
  CellsInOrder<dim>::CellsInOrder(const LevelHierarchy &hierarchy, const Problem<dim> &problem)
    : n(problem.space.mesh.triangulation->n_active_cells()), places(hierarchy.places), triangulation(*problem.space.mesh.triangulation),
      depth(triangulation.n_levels() - 1)
  {
  }

  template <int dim>
  typename DoFHandler<dim>::active_cell_iterator CellsInOrder<dim>::at(const std::size_t k, const DoFHandler<dim> &dof_handler) const
  {
    return places.empty() ? typename DoFHandler<dim>::active_cell_iterator(&triangulation, depth, k, &dof_handler)
                          : typename DoFHandler<dim>::active_cell_iterator(&triangulation, places[k].level, places[k].index, &dof_handler);
  }

  template <int dim>
  void CellsInOrder<dim>::put_in_order(const Problem<dim> &problem, const unsigned most_levels)
  {
    const auto below = levels_below(problem, most_levels);
    // The cells that patches consist of or descend from: by k, irregular ones last; by their own level.
    using Roots = std::vector<std::vector<LevelHierarchy::Place>>;
    std::vector<Roots> roots(most_levels + 2, Roots(depth + 1));
    const auto         collect = [&](const auto &self, const typename Triangulation<dim>::cell_iterator &cell) -> void
    {
      const int  levels = below[cell->level()][cell->index()];
      const auto add = [&](const unsigned group) { roots[group][cell->level()].push_back({cell->level(), cell->index()}); };
      if (levels != irregular)
        return add(most_levels - levels);
      if (cell->is_active())
        return add(most_levels + 1);
      // Children that have come into being together follow each other.
      bool all_active = true;
      for (unsigned child = 0; child < cell->n_children(); ++child)
        all_active = all_active && cell->child(child)->is_active();
      for (unsigned child = 0; child < cell->n_children(); ++child)
        if (all_active)
          roots[most_levels + 1][cell->level() + 1].push_back({cell->level() + 1, cell->child_index(child)});
        else
          self(self, cell->child(child));
    };
    for (const auto &cell : triangulation.cell_iterators_on_level(0))
      collect(collect, cell);

    const auto add_descendants = [&](const auto &self, const typename Triangulation<dim>::cell_iterator &cell) -> void
    {
      if (cell->is_active())
        places.push_back({cell->level(), cell->index()});
      else
        for (unsigned child = 0; child < cell->n_children(); ++child)
          self(self, cell->child(child));
    };
    for (unsigned k = 0; k < roots.size(); ++k)
    {
      std::size_t n_patches = 0;
      for (const auto &of_level : roots[k])
        for (const auto &[level, index] : of_level)
        {
          ++n_patches;
          add_descendants(add_descendants, typename Triangulation<dim>::cell_iterator(&triangulation, level, index));
        }
      const unsigned n_levels = k > most_levels ? 0 : most_levels - k;
      if (n_patches > 0 && !patches.empty() && patches.back().n_levels == n_levels)
        patches.back().n_patches += n_patches;
      else if (n_patches > 0)
        patches.push_back({n_levels, n_patches});
    }
    AssertThrow(places.size() == n, ExcMessage("cells are in one patch each"));
  }

  /// A cell that the level before has, too, stays; any other one is a child of one that it has.
  template <int dim>
  void CellsInOrder<dim>::find_children(const LevelHierarchy &hierarchy)
  {
    constexpr std::uint32_t                 none = -1;
    const std::size_t                       n_before = hierarchy.finest().n_cells();
    std::vector<std::vector<std::uint32_t>> before(triangulation.n_levels());
    for (unsigned level = 0; level < before.size(); ++level)
      before[level].assign(triangulation.n_raw_cells(level), none);
    for (std::uint32_t c = 0; c < n_before; ++c)
      if (hierarchy.places.empty())
        before[hierarchy.refinements_of_all_cells()][c] = c;
      else
        before[hierarchy.places[c].level][hierarchy.places[c].index] = c;
    children.first.assign(n_before, none);
    children.stays.assign(n_before, false);
    for (std::uint32_t k = 0; k < places.size(); ++k)
    {
      const auto [level, index] = places[k];
      if (const auto c = before[level][index]; c != none)
      {
        children.first[c] = k;
        children.stays[c] = true;
        continue;
      }
      const typename Triangulation<dim>::cell_iterator cell(&triangulation, level, index);
      const std::uint32_t                              parent = level > 0 ? before[level - 1][cell->parent_index()] : none;
      AssertThrow(parent != none, ExcMessage("levels are added one by one"));
      children.first[parent] = std::min(children.first[parent], k);
    }
  }

  template class CellsInOrder<1>;
  template class CellsInOrder<2>;
  template class CellsInOrder<3>;
} // namespace unilateral
