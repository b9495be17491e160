// The elements of a .msh file: where those of each entity stand.
#pragma once

#include "unilateral/mesh/msh_groups.h"
#include "unilateral/mesh/msh_index.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace unilateral::msh
{
  /// Of Gmsh's element types those that are read here, and points.
  struct KindOfElement
  {
    unsigned                dim, order, n_nodes;
    std::optional<CellKind> cell = {};
  };

  /// Throws NotRead for all others.
  KindOfElement kind_of_element(int type);

  /// Elements of all dimensions, while the file is read.
  class Elements
  {
  public:
    /// @p numbers_before_nodes: of a record.
    unsigned add_block(const KindOfElement &kind, int entity, unsigned numbers_before_nodes);

    /// @p n elements of the block, one behind the other.
    void add_piece(unsigned block, std::uint64_t n, std::uint64_t begin, std::uint64_t end);

    std::size_t n_pieces() const { return pieces.size(); }
    unsigned    dimension() const; ///< the largest

    /// Cells and faces of a mesh of this dimension: entity by entity, in the order of their numbers, as Gmsh goes through a file. Throws
    /// NotRead where they are not all of one kind and order.
    void put_into(MshIndex &index, const Groups &groups, unsigned dim) const;

  private:
    struct Block
    {
      KindOfElement kind;
      int           entity;
      unsigned      numbers_before_nodes;
    };

    std::vector<Block>    blocks;
    std::vector<MshPiece> pieces;
  };
} // namespace unilateral::msh
