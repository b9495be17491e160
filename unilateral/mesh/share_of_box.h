// What each of several processes makes of a box.
#pragma once

#include "unilateral/base/processes.h"
#include "unilateral/mesh/mesh_description.h"
#include "unilateral/mesh/share_of_mesh.h"

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace unilateral
{
  /// The cells of box_mesh() in its order, and the nodes row by row: each process counts off as many as the others.
  template <int dim>
  class ShareOfBox : public ShareOfMesh
  {
  public:
    ShareOfBox(const MeshDescription &spec, bool simplices, const Processes &processes);

    /// None where the description is not that of a box, or there are 2^32 nodes: on all processes.
    const std::optional<MshIndex> &index() const override { return index_of_box; }

    std::optional<MshNodes>               nodes() const override;
    std::optional<CellsOfShare>           cells() const override;
    std::optional<std::vector<NamedFace>> faces() const override;

    /// Bisected again and again between layers of cells, across the direction with most of them. Empty where a part would come to more
    /// than 1.05 times the mean.
    std::vector<unsigned> owners(const std::vector<std::uint32_t> &ids) const override;

  private:
    using Place = std::array<std::uint64_t, dim>; ///< of a node or of a block of cells, in each direction

    /// Calls visit(number, cell) for each own cell, a list of the places of its corners, in deal.II's order.
    template <typename Visit>
    void for_own_cells(const Visit &visit) const;

    std::uint64_t number_of(const Place &node) const;

    /// The blocks from begin to end in each direction, and the processes that share them.
    struct BlockRange
    {
      Place    begin, end;
      unsigned first_process, n_processes;

      /// In two, by a cut between layers of direction @p across, which it sets.
      std::pair<BlockRange, BlockRange> halves(unsigned &across) const;
      std::uint64_t                     largest_part() const;
    };

    const Processes         processes;
    std::array<double, dim> lower{}, upper{};
    Place                   n_blocks{};                                       ///< in each direction; a block is a cell, or some simplices
    std::vector<std::vector<std::vector<std::array<unsigned, dim>>>> pattern; ///< [parity of the block][cell][corner], within the block
    std::optional<MshIndex>                                          index_of_box;
  };
} // namespace unilateral
