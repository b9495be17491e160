// How the cells of a patch share its unknowns.
#pragma once

#include <cstdint>
#include <vector>

namespace unilateral
{
  constexpr unsigned most_patch_dofs = 6600; ///< 3 components on 13^3 nodes: two cells of Q6 in each direction

  /// How cells lie in a patch, which has at most most_patch_dofs unknowns.
  struct PatchShape
  {
    unsigned                   n_cell_dofs = 0, n_patch_dofs = 0, n_cells = 1;
    std::vector<std::uint16_t> cell_dofs; ///< entry [cell * n_cell_dofs + i]: which of the patch's unknowns is number i of the cell
  };
} // namespace unilateral
