#include "unilateral/mesh/msh_elements.h"

#include <algorithm>
#include <numeric>

namespace unilateral::msh
{
  KindOfElement kind_of_element(const int type)
  {
    switch (type)
    {
    case 15:
      return {0, 1, 1};
    case 1:
      return {1, 1, 2};
    case 8:
      return {1, 2, 3};
    case 2:
      return {2, 1, 3, CellKind::triangle};
    case 9:
      return {2, 2, 6, CellKind::triangle};
    case 3:
      return {2, 1, 4, CellKind::quadrilateral};
    case 10:
      return {2, 2, 9, CellKind::quadrilateral};
    case 4:
      return {3, 1, 4, CellKind::tetrahedron};
    case 11:
      return {3, 2, 10, CellKind::tetrahedron};
    case 5:
      return {3, 1, 8, CellKind::hexahedron};
    case 12:
      return {3, 2, 27, CellKind::hexahedron};
    default:
      throw NotRead();
    }
  }

  unsigned Elements::add_block(const KindOfElement &kind, const int entity, const unsigned numbers_before_nodes)
  {
    blocks.push_back({kind, entity, numbers_before_nodes});
    return blocks.size() - 1;
  }

  void Elements::add_piece(const unsigned block, const std::uint64_t n, const std::uint64_t begin, const std::uint64_t end)
  {
    auto &piece = pieces.emplace_back();
    piece.block = block;
    piece.n = n;
    piece.begin = begin;
    piece.end = end;
  }

  unsigned Elements::dimension() const
  {
    unsigned dim = 0;
    for (const Block &block : blocks)
      dim = std::max(dim, block.kind.dim);
    return dim;
  }

  void Elements::put_into(MshIndex &index, const Groups &groups, const unsigned dim) const
  {
    std::vector<unsigned> by_entity(blocks.size());
    std::iota(by_entity.begin(), by_entity.end(), 0u);
    std::stable_sort(by_entity.begin(), by_entity.end(),
                     [&](const unsigned a, const unsigned b) { return blocks[a].entity < blocks[b].entity; });
    const auto is_cell = [&](const Block &block) { return block.kind.dim == dim; };

    std::optional<unsigned>              order;
    std::optional<CellKind>              kind_of_cells, kind_of_faces;
    std::vector<std::optional<unsigned>> number(blocks.size()); ///< among those of cells, or of faces
    for (const unsigned b : by_entity)
    {
      const Block &block = blocks[b];
      require(block.kind.dim <= dim);
      if (block.kind.dim + 1 < dim)
        continue;
      require(order.value_or(block.kind.order) == block.kind.order);
      order = block.kind.order;
      if (block.kind.cell)
      {
        auto &kind = is_cell(block) ? kind_of_cells : kind_of_faces;
        require(kind.value_or(*block.kind.cell) == *block.kind.cell);
        kind = block.kind.cell;
      }
      const std::string name = groups.name_of(block.kind.dim, block.entity);
      if (!is_cell(block) && name.empty())
        continue;
      auto &all = is_cell(block) ? index.cell_blocks : index.face_blocks;
      number[b] = all.size();
      all.push_back(
        {is_cell(block) ? number_of_name(name.empty() ? "domain" : name, index.region_names) : number_of_name(name, index.part_names),
         block.kind.n_nodes, block.numbers_before_nodes});
    }
    require(kind_of_cells && (!kind_of_faces || is_simplex(*kind_of_cells) == is_simplex(*kind_of_faces)));
    index.kind = *kind_of_cells;
    index.order = *order;

    for (const MshPiece &piece : pieces)
      if (number[piece.block])
        (is_cell(blocks[piece.block]) ? index.cells : index.faces).push_back(piece);
    const auto number_pieces = [&](std::vector<MshPiece> &of_kind, std::uint64_t &n)
    {
      for (MshPiece &piece : of_kind)
        piece.block = *number[piece.block];
      std::stable_sort(of_kind.begin(), of_kind.end(), [](const MshPiece &a, const MshPiece &b) { return a.block < b.block; });
      for (MshPiece &piece : of_kind)
      {
        piece.first = n;
        n += piece.n;
      }
    };
    number_pieces(index.cells, index.n_cells);
    number_pieces(index.faces, index.n_faces);
  }
} // namespace unilateral::msh
