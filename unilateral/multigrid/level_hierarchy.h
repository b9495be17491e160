// A on every level of a mesh that was refined, as a whole or in places, and how each V_h lies in the next.
#pragma once

#include "unilateral/base/shared_unknowns.h"
#include "unilateral/multigrid/cell_operator.h"
#include "unilateral/multigrid/convection_operator.h"
#include "unilateral/multigrid/patch_sweep.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace unilateral
{
  /// Level 0 is the coarse mesh. Every level covers all of the domain: where a refinement leaves a cell as it is, the cell is its own only
  /// child. Children of cell c of a level are the cells c n_children, ..., (c + 1) n_children - 1 of the next one when that has refined
  /// all cells, else those that Level::children_in_places has.
  struct LevelHierarchy
  {
    struct Level
    {
      std::unique_ptr<CellOperator> stiffness;
      std::unique_ptr<PatchSweep>   sweep;              ///< A in single precision, and how the next coarser V_H lies in V_h
      SharedUnknowns                shared;             ///< with other processes
      ChildrenInPlaces              children_in_places; ///< of the level before, on this one; empty: all cells were refined
    };
    std::vector<Level> levels;
    unsigned           n_children = 0;
    unsigned           n_components = 1; ///< unknowns of a cell come node by node, these at each
    /// P_c for each child c of a cell: the cell's functions in terms of the child's, n_cell_dofs^2 numbers, row by row.
    std::vector<std::vector<double>> to_child;

    /// Where each process goes on with a part of the mesh: `level` is its part of what the level before it is as a whole, which all
    /// processes of a group have. With many processes that is a part, too, of a level before.
    struct Cut
    {
      unsigned                   level;
      Processes                  group;    ///< one process for each part of this whole
      std::vector<std::uint32_t> to_whole; ///< unknown of the part -> of the whole
      std::vector<std::uint32_t> cells;    ///< cell of the part -> of the whole
      std::vector<std::uint32_t>
        contributed; ///< those of its unknowns that this process puts into sums of the group: no process before it has them
    };
    std::vector<Cut> cuts; ///< by level

    const Cut *cut_at(const unsigned level) const
    {
      const auto cut = std::find_if(cuts.begin(), cuts.end(), [&](const Cut &cut) { return cut.level == level; });
      return cut == cuts.end() ? nullptr : &*cut;
    }
    unsigned level_of_last_cut() const { return cuts.empty() ? 0 : cuts.back().level; }

    /// Cell @p c of the level before @p level: which cells are its children.
    std::pair<std::size_t, std::size_t> children(const unsigned level, const std::size_t c) const
    {
      const auto &in_places = levels[level].children_in_places;
      return in_places.first.empty() ? std::pair(c * n_children, (c + 1) * n_children) : in_places.of(c, n_children);
    }

    /// How often the mesh of the finest level was refined as a whole, since it was cut where it is a part of one: n_children^k cells of
    /// that level, from a multiple of this number on, are the descendants of one cell for k up to this.
    unsigned refinements_of_all_cells() const { return places.empty() ? levels.size() - 1 - level_of_last_cut() : 0; }

    /// Where the cells of the finest level are in the triangulation, patch by patch; empty: they are all cells of one level of it, in its
    /// order.
    struct Place
    {
      int level, index;
    };
    std::vector<Place> places;

    /// Of the finest level, besides its stiffness, which is then the symmetric part of A; none where A is symmetric.
    std::unique_ptr<ConvectionOperator> convection;

    const Processes    &processes() const { return levels.back().shared.processes(); }
    const CellOperator &finest() const { return *levels.back().stiffness; }
  };
} // namespace unilateral
