// What each of several processes has of a mesh at first: cells and nodes one after the other, as they come.
#pragma once

#include "unilateral/mesh/faces_between_parts.h"
#include "unilateral/mesh/msh_index.h"
#include "unilateral/mesh/msh_pieces.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace unilateral
{
  /// Cells one after the other, by the numbers of their nodes, which stand in Gmsh's order.
  struct CellsOfShare
  {
    std::vector<std::uint32_t> ids, regions;
    std::vector<std::uint64_t> nodes;

    template <typename Archive>
    void archive(Archive &bytes)
    {
      bytes(ids);
      bytes(regions);
      bytes(nodes);
    }
  };

  /// Every node, cell and face with a name is in the share of one process. Nothing: what the source has is damaged.
  class ShareOfMesh
  {
  public:
    virtual ~ShareOfMesh() = default;

    /// Kind, order, how many of all there are, and names: the same on all processes.
    virtual const std::optional<MshIndex> &index() const = 0;

    virtual std::optional<MshNodes>               nodes() const = 0;
    virtual std::optional<CellsOfShare>           cells() const = 0;
    virtual std::optional<std::vector<NamedFace>> faces() const = 0;

    /// The processes that are to have the cells with these ids, where that is plain from the numbers; empty: on all processes.
    virtual std::vector<unsigned> owners(const std::vector<std::uint32_t> & /*ids*/) const { return {}; }
  };
} // namespace unilateral
