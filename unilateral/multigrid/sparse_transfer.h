// How a coarser V_H lies in V_h where the mesh was refined in places.
#pragma once

#include <cstdint>
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

  /// From a level with the operator @p coarse to the next one, whose cells are its children, see LevelHierarchy::Level::first_child.
  /// @p to_child: see LevelHierarchy. @p dofs_of_cells: n_cell_dofs for each of these; @p is_free: of each unknown.
  SparseTransfer transfer_in_places(const CellOperator                     &coarse,
                                    const std::vector<std::vector<double>> &to_child,
                                    const std::vector<std::uint32_t>       &first_child,
                                    const std::vector<std::uint32_t>       &dofs_of_cells,
                                    const std::vector<bool>                &is_free);
} // namespace unilateral
