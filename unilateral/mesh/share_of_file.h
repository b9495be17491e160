// What each of several processes reads of a mesh file.
#pragma once

#include "unilateral/base/processes.h"
#include "unilateral/mesh/faces_between_parts.h"
#include "unilateral/mesh/msh_pieces.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  /// Cells as the file has them, one after the other, by the numbers of their nodes there.
  struct CellsOfFile
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

  /// The pieces of a .msh file are dealt out one behind the other. What cannot be read, or has numbers of more than 32 bits, is nothing.
  class ShareOfFile
  {
  public:
    /// The first process makes the index, for all. Collective.
    ShareOfFile(const std::string &file, const Processes &processes);

    /// None where the file has none: on all processes.
    const std::optional<MshIndex> &index() const { return index_of_file; }

    std::optional<MshNodes>               nodes() const;
    std::optional<CellsOfFile>            cells() const;
    std::optional<std::vector<NamedFace>> faces() const;

  private:
    std::vector<MshPiece> own(const std::vector<MshPiece> &all) const;

    const Processes         processes;
    const MshPieces         pieces;
    std::optional<MshIndex> index_of_file;
  };
} // namespace unilateral
