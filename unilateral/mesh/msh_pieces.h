// Files of Gmsh's formats 4.1 and 2.2 that are read in pieces, each by another process: no process needs memory for the whole.
#pragma once

#include "unilateral/mesh/msh_index.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace unilateral
{
  /// Nodes, and what they are called in the file.
  struct MshNodes
  {
    std::vector<std::uint64_t>         tags;
    std::vector<std::array<double, 3>> x;
  };

  /// Reads pieces of a file that has an index. Each returns false where the file is not what its index says.
  class MshPieces
  {
  public:
    explicit MshPieces(const std::string &file);
    ~MshPieces();
    MshPieces(const MshPieces &) = delete;
    MshPieces &operator=(const MshPieces &) = delete;

    /// Appends the nodes of @p piece.
    bool read_nodes(const MshIndex &index, const MshPiece &piece, MshNodes &nodes) const;

    /// Appends the tags of the nodes of elements, in Gmsh's order, one element after the other.
    bool read_elements(const MshIndex &index, const MshPiece &piece, const MshIndex::Block &block, std::vector<std::uint64_t> &nodes) const;

  private:
    bool read_bytes(std::uint64_t begin, std::uint64_t end, std::vector<char> &bytes) const;

    int descriptor = -1;
  };
} // namespace unilateral
