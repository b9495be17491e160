// What each of several processes reads of a mesh file.
#pragma once

#include "unilateral/base/processes.h"
#include "unilateral/mesh/share_of_mesh.h"

#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  /// The pieces of a .msh file are dealt out one behind the other. What cannot be read, or has numbers of more than 32 bits, is nothing.
  class ShareOfFile : public ShareOfMesh
  {
  public:
    /// The first process makes the index, for all. Collective.
    ShareOfFile(const std::string &file, const Processes &processes);

    /// None where the file has none: on all processes.
    const std::optional<MshIndex> &index() const override { return index_of_file; }

    std::optional<MshNodes>               nodes() const override;
    std::optional<CellsOfShare>           cells() const override;
    std::optional<std::vector<NamedFace>> faces() const override;

  private:
    std::vector<MshPiece> own(const std::vector<MshPiece> &all) const;

    const Processes         processes;
    const MshPieces         pieces;
    std::optional<MshIndex> index_of_file;
  };
} // namespace unilateral
