// How a coarser V_H lies in V_h where the mesh was refined in places.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace unilateral
{
  class CellOperator;

  /// Row i is unknown i in terms of coarse ones; empty for unknowns that are fixed or depend on others.
  struct SparseTransfer
  {
    std::vector<std::uint32_t> row_start = {0}, columns;
    std::vector<float>         weights;
  };

  /// Where a refinement has left some cells as they were. Of each cell of a level, what it has become on the next one.
  struct ChildrenInPlaces
  {
    std::vector<std::uint32_t> first; ///< cell of the next level
    std::vector<bool>          stays; ///< the cell is its own only child

    /// First and end, of @p n_children where it was refined.
    std::pair<std::size_t, std::size_t> of(const std::size_t cell, const unsigned n_children) const
    {
      return {first[cell], first[cell] + (stays[cell] ? 1 : n_children)};
    }
  };

  /// From a level with the operator @p coarse to the next one, whose cells are its @p children. @p to_child: see LevelHierarchy.
  /// @p dofs_of_cells: n_cell_dofs for each of these; @p is_free: of each unknown.
  SparseTransfer transfer_in_places(const CellOperator                     &coarse,
                                    const std::vector<std::vector<double>> &to_child,
                                    const ChildrenInPlaces                 &children,
                                    const std::vector<std::uint32_t>       &dofs_of_cells,
                                    const std::vector<bool>                &is_free);
} // namespace unilateral
