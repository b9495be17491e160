// The order of the cells of a level in multigrid.
#pragma once

#include "unilateral/discretisation/problem.h"
#include "unilateral/multigrid/level_hierarchy.h"

#include <cstddef>
#include <vector>

namespace unilateral
{
  /// The cells of the mesh of @p problem. Where that was refined everywhere, they are those of one level of the triangulation, and children
  /// of one cell follow each other. Else they come patch by patch: a patch are the descendants of one cell, k levels below it, where none
  /// of them is refined further and none has unknowns that depend on others, with the largest such k up to @p most_levels; patches with
  /// large k come first, those of cells of one size together, so that 16 of them have one element matrix wherever that is possible.
  template <int dim>
  class CellsInOrder
  {
  public:
    /// Of the level that @p hierarchy is to get next; @p follows_another: a refinement of the one that it ends with.
    CellsInOrder(const LevelHierarchy &hierarchy, const Problem<dim> &problem, bool follows_another, unsigned most_levels);

    /// Of the level that @p hierarchy ends with.
    CellsInOrder(const LevelHierarchy &hierarchy, const Problem<dim> &problem);

    bool all_of_one_level() const { return places.empty(); }

    typename dealii::DoFHandler<dim>::active_cell_iterator at(std::size_t k, const dealii::DoFHandler<dim> &dof_handler) const;

    struct PatchesOfLevels
    {
      unsigned    n_levels; ///< k
      std::size_t n_patches;
    };

    const std::size_t                  n;
    std::vector<LevelHierarchy::Place> places;   ///< empty: all_of_one_level()
    std::vector<PatchesOfLevels>       patches;  ///< in places
    ChildrenInPlaces                   children; ///< of the level before, in places

  private:
    void put_in_order(const Problem<dim> &problem, unsigned most_levels);
    void find_children(const LevelHierarchy &hierarchy);

    const dealii::Triangulation<dim> &triangulation;
    const int                         depth; ///< of its finest level
  };
} // namespace unilateral
