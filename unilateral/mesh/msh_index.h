// Where everything stands in a file of Gmsh's format 4.1 or 2.2, and what it is called.
#pragma once

#include "unilateral/mesh/cell_list.h"

#include <cstdint>
#include <string>
#include <vector>

namespace unilateral
{
  /// Nodes of one entity that follow each other in a file, or elements.
  struct MshPiece
  {
    unsigned      block = 0;          ///< of nodes or of elements
    std::uint64_t first = 0, n = 0;   ///< among the nodes, the cells or the faces with a name, in the order of their entities
    std::uint64_t tags_at = 0;        ///< nodes, where their tags come before all coordinates: byte where these begin
    std::uint64_t tags_end = 0;       ///< and end
    std::uint64_t begin = 0, end = 0; ///< bytes of their coordinates, or of the elements
  };

  /// Where everything stands in a .msh file with cells of one kind, in the plane or in space, of order 1 or 2, and what it is called.
  struct MshIndex
  {
    struct Block
    {
      unsigned name = 0;              ///< of cells and faces, in region_names or part_names
      unsigned numbers_of_record = 0; ///< coordinates of a node, with its parameters; nodes of an element
      unsigned numbers_before = 0;    ///< of the record, before these: a tag and the like
    };

    bool                     binary = false;
    unsigned                 bytes_of_integer = sizeof(std::uint64_t); ///< in a binary file
    CellKind                 kind = CellKind::tetrahedron;
    unsigned                 order = 1;
    std::uint64_t            n_nodes = 0, n_cells = 0, n_faces = 0;
    std::vector<std::string> region_names, part_names;
    std::vector<Block>       node_blocks, cell_blocks, face_blocks;
    std::vector<MshPiece>    nodes, cells, faces; ///< faces: those with a name

    unsigned corners_of_cell() const;
    unsigned corners_of_face() const;
    unsigned nodes_of_cell() const;

    template <typename Archive>
    void archive(Archive &bytes);
  };

  template <typename Archive>
  void MshIndex::archive(Archive &bytes)
  {
    for (auto *const number : {&n_nodes, &n_cells, &n_faces})
      bytes(*number);
    bytes(binary);
    bytes(bytes_of_integer);
    bytes(kind);
    bytes(order);
    bytes(region_names);
    bytes(part_names);
    for (auto *const blocks : {&node_blocks, &cell_blocks, &face_blocks})
      bytes(*blocks);
    for (auto *const pieces : {&nodes, &cells, &faces})
      bytes(*pieces);
  }
} // namespace unilateral
