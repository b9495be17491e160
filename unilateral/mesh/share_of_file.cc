#include "unilateral/mesh/share_of_file.h"

#include "unilateral/base/byte_archive.h"
#include "unilateral/mesh/msh_file.h"

#include <algorithm>

namespace unilateral
{
  namespace
  {
    constexpr std::uint64_t most_bits = 0xffffffff;
  }

  ShareOfFile::ShareOfFile(const std::string &file, const Processes &processes) : processes(processes), pieces(file)
  {
    ByteWriter bytes;
    if (processes.rank() == 0)
      if (auto found = index_of_msh(file))
        found->archive(bytes);
    const auto for_all = processes.gather(bytes.bytes);
    if (for_all.empty())
      return;
    ByteReader reader(for_all);
    index_of_file.emplace().archive(reader);
  }

  std::vector<MshPiece> ShareOfFile::own(const std::vector<MshPiece> &all) const
  {
    const std::size_t n = all.size(), rank = processes.rank(), size = processes.size();
    return {all.begin() + n * rank / size, all.begin() + n * (rank + 1) / size};
  }

  std::optional<MshNodes> ShareOfFile::nodes() const
  {
    MshNodes nodes;
    for (const auto &piece : own(index_of_file->nodes))
      if (!pieces.read_nodes(*index_of_file, piece, nodes))
        return {};
    return nodes;
  }

  std::optional<CellsOfShare> ShareOfFile::cells() const
  {
    CellsOfShare cells;
    for (const auto &piece : own(index_of_file->cells))
    {
      const auto &block = index_of_file->cell_blocks[piece.block];
      if (!pieces.read_elements(*index_of_file, piece, block, cells.nodes))
        return {};
      for (std::uint64_t k = 0; k < piece.n; ++k)
      {
        cells.ids.push_back(piece.first + k);
        cells.regions.push_back(block.name);
      }
    }
    if (std::any_of(cells.nodes.begin(), cells.nodes.end(), [](const auto tag) { return tag >= most_bits; }))
      return {};
    return cells;
  }

  std::optional<std::vector<NamedFace>> ShareOfFile::faces() const
  {
    std::vector<NamedFace> faces;
    const unsigned         n_corners = index_of_file->corners_of_face();
    for (const auto &piece : own(index_of_file->faces))
    {
      const auto                &block = index_of_file->face_blocks[piece.block];
      std::vector<std::uint64_t> nodes;
      if (!pieces.read_elements(*index_of_file, piece, block, nodes))
        return {};
      for (std::uint64_t k = 0; k < piece.n; ++k)
      {
        NamedFace face{{}, block.name, piece.first + k};
        face.vertices.fill(most_bits);
        for (unsigned v = 0; v < n_corners; ++v)
        {
          const std::uint64_t tag = nodes[k * block.numbers_of_record + v];
          if (tag >= most_bits)
            return {};
          face.vertices[v] = tag;
        }
        std::sort(face.vertices.begin(), face.vertices.end());
        faces.push_back(face);
      }
    }
    return faces;
  }
} // namespace unilateral
