// A .msh file in pieces, beside what Gmsh reads.
#include "unilateral/mesh/gmsh_file.h"
#include "unilateral/mesh/msh_file.h"
#include "unilateral/mesh/msh_pieces.h"

#include "text_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

namespace
{
  using namespace unilateral;

  const std::string test_data = PROJECT_DIR "/tests/data/";

  MeshDescription file(const std::string &name)
  {
    MeshDescription spec;
    spec.source = MeshDescription::Source::file;
    spec.file = name;
    return spec;
  }

  std::string text_of(const std::string &name)
  {
    std::ostringstream text;
    text << std::ifstream(name, std::ios::binary).rdbuf();
    return text.str();
  }

  using Corner = std::array<double, 3>;
  using CellsWithNames = std::vector<std::pair<std::string, std::vector<Corner>>>;

  /// Cells or faces: their corners in ascending order, by the name of the region or part.
  CellsWithNames with_names(const std::vector<std::vector<unsigned>> &cells,
                            const std::vector<std::array<double, 3>> &vertices,
                            const std::vector<unsigned>              &name_of_cell,
                            const std::vector<std::string>           &names)
  {
    CellsWithNames result;
    for (std::size_t k = 0; k < cells.size(); ++k)
    {
      std::vector<Corner> corners;
      for (const unsigned v : cells[k])
        corners.push_back(vertices[v]);
      std::sort(corners.begin(), corners.end());
      result.emplace_back(names[name_of_cell[k]], corners);
    }
    return result;
  }

  CellsWithNames with_names(const MshPieces                    &pieces,
                            const MshIndex                     &index,
                            const std::vector<MshPiece>        &all,
                            const std::vector<MshIndex::Block> &blocks,
                            const unsigned                      n_corners,
                            const std::vector<std::string>     &names)
  {
    MshNodes nodes;
    for (const MshPiece &piece : index.nodes)
      EXPECT_TRUE(pieces.read_nodes(index, piece, nodes));
    std::map<std::uint64_t, Corner> place;
    for (std::size_t k = 0; k < nodes.tags.size(); ++k)
      place[nodes.tags[k]] = nodes.x[k];
    EXPECT_EQ(place.size(), index.n_nodes);
    CellsWithNames result;
    std::uint64_t  n = 0;
    for (const MshPiece &piece : all)
    {
      EXPECT_EQ(piece.first, n);
      n += piece.n;
      const auto                &block = blocks[piece.block];
      std::vector<std::uint64_t> tags;
      EXPECT_TRUE(pieces.read_elements(index, piece, block, tags));
      EXPECT_EQ(tags.size(), piece.n * block.numbers_of_record);
      for (std::size_t k = 0; k < tags.size(); k += block.numbers_of_record)
      {
        std::vector<Corner> corners;
        for (unsigned v = 0; v < n_corners; ++v)
          corners.push_back(place.at(tags[k + v]));
        std::sort(corners.begin(), corners.end());
        result.emplace_back(names[block.name], corners);
      }
    }
    return result;
  }

  void expect_what_gmsh_reads(const std::string &name, const bool simplices = true)
  {
    SCOPED_TRACE(name);
    const auto outline = outline_of_msh(name);
    ASSERT_TRUE(outline.has_value());
    const MeshOutline of_gmsh = gmsh_outline(file(name));
    EXPECT_EQ(outline->dimension, of_gmsh.dimension);
    EXPECT_EQ(outline->part_names, of_gmsh.part_names);
    EXPECT_EQ(outline->region_names, of_gmsh.region_names);
    const CellList list = read_gmsh_file(file(name), simplices);
    for (const unsigned most : {3u, 20000u})
    {
      const auto index = index_of_msh(name, most);
      ASSERT_TRUE(index.has_value());
      EXPECT_EQ(index->kind, list.kind);
      EXPECT_EQ(index->n_cells, list.cells.size());
      EXPECT_EQ(index->part_names, list.part_names);
      EXPECT_EQ(index->region_names, list.region_names);
      const MshPieces pieces(name);
      const auto      cells = with_names(pieces, *index, index->cells, index->cell_blocks, index->corners_of_cell(), index->region_names);
      EXPECT_EQ(cells, with_names(list.cells, list.vertices, list.cell_region, list.region_names));
      const auto faces = with_names(pieces, *index, index->faces, index->face_blocks, index->corners_of_face(), index->part_names);
      EXPECT_EQ(faces, with_names(list.faces, list.vertices, list.face_part, list.part_names));
    }
  }

  /// Whatever became of the file: all of it is read, or it is refused.
  void read_or_refuse(const std::string &name)
  {
    outline_of_msh(name);
    const auto index = index_of_msh(name, 5);
    if (!index)
      return;
    const MshPieces pieces(name);
    MshNodes        nodes;
    for (const MshPiece &piece : index->nodes)
      if (!pieces.read_nodes(*index, piece, nodes))
        return;
    EXPECT_EQ(nodes.tags.size(), index->n_nodes);
    for (const auto &[all, blocks] : {std::pair(&index->cells, &index->cell_blocks), std::pair(&index->faces, &index->face_blocks)})
      for (const MshPiece &piece : *all)
      {
        std::vector<std::uint64_t> tags;
        const auto                &block = (*blocks)[piece.block];
        if (pieces.read_elements(*index, piece, block, tags))
          EXPECT_EQ(tags.size(), piece.n * block.numbers_of_record);
      }
  }
} // namespace

TEST(MshPieces, HoldWhatGmshReads)
{
  for (const std::string name : {"triangles-41.msh", "triangles-41-binary.msh", "tetrahedra-41.msh", "triangles-22.msh",
                                 "triangles-22-binary.msh", "tetrahedra-22.msh"})
    expect_what_gmsh_reads(test_data + name);
  for (const std::string name : {"quadrilaterals-41.msh", "hexahedra-41.msh", "quadrilaterals-22.msh", "hexahedra-22.msh"})
    expect_what_gmsh_reads(test_data + name, false);
  expect_what_gmsh_reads(PROJECT_DIR "/examples/data/plate-with-hole.msh");
}

TEST(MshPieces, TextWithReturnsIsTheSame)
{
  std::string text = text_of(test_data + "triangles-41.msh"), with_returns;
  for (const char c : text)
    with_returns += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const TextFile copy(".msh", with_returns);
  const auto     index = index_of_msh(copy.name);
  ASSERT_TRUE(index.has_value());
  EXPECT_EQ(index->n_cells, index_of_msh(test_data + "triangles-41.msh")->n_cells);
}

TEST(MshPieces, OtherFormatsAndKindsAreLeftToGmsh)
{
  for (const std::string name : {"segments-22.msh", "segments-41.msh", "none.msh"})
  {
    EXPECT_FALSE(index_of_msh(test_data + name).has_value()) << name;
    EXPECT_FALSE(outline_of_msh(test_data + name).has_value()) << name;
  }
}

namespace
{
  /// Two squares of two triangles each, in format 2.2; @p elements: lines, without their numbers.
  std::string two_squares(const std::vector<std::string> &elements)
  {
    std::ostringstream text;
    text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 4 \"left\"\n2 2 \"soft\"\n$EndPhysicalNames\n"
            "$Nodes\n6\n10 0 0 0\n20 1 0 0\n30 2 0 0\n40 0 1 0\n50 1 1 0\n60 2 1 0\n$EndNodes\n$Elements\n"
         << elements.size() << '\n';
    for (std::size_t k = 0; k < elements.size(); ++k)
      text << k + 1 << ' ' << elements[k] << '\n';
    text << "$EndElements\n";
    return text.str();
  }
} // namespace

TEST(MshPieces, ElementsOfEntitiesTakeTurnsInFormat2)
{
  // Entity 7 has group 2, entity 5 none: its cells come first.
  const TextFile in_turns(".msh", two_squares({"2 2 2 7 10 20 50", "2 2 0 5 20 30 60", "1 2 4 9 10 40", "2 2 2 7 10 50 40",
                                               "2 2 0 5 20 60 50", "1 2 0 8 30 60", "15 2 0 1 10"}));
  expect_what_gmsh_reads(in_turns.name);
  const auto index = index_of_msh(in_turns.name);
  ASSERT_TRUE(index.has_value());
  EXPECT_EQ(index->cells.size(), 4u);
  EXPECT_EQ(index->region_names, (std::vector<std::string>{"domain", "soft"}));
  EXPECT_EQ(index->part_names, std::vector<std::string>{"left"});
}

TEST(MshPieces, OfFormat2SomeIsLeftToGmsh)
{
  const std::vector<std::string> good = {"2 2 2 7 10 20 50", "2 2 2 7 10 50 40", "2 2 2 7 20 30 60", "2 2 2 7 20 60 50"};
  EXPECT_TRUE(index_of_msh(TextFile(".msh", two_squares(good)).name).has_value());
  const auto expect_refused = [&](const std::string &first)
  {
    auto elements = good;
    elements[0] = first;
    EXPECT_FALSE(index_of_msh(TextFile(".msh", two_squares(elements)).name).has_value()) << first;
  };
  expect_refused("2 2 3 7 10 20 50");          // an entity in two groups
  expect_refused("2 2 -2 7 10 20 50");         // one that is turned around
  expect_refused("2 4 2 7 1 1 10 20 50");      // of a mesh that Gmsh has divided
  expect_refused("3 2 2 7 10 20 50 40");       // cells of two kinds
  expect_refused("9 2 2 7 10 20 50 10 20 50"); // of two orders
  expect_refused("6 2 2 7 10 20 50 40 30 60"); // a wedge
}

TEST(MshPieces, FilesThatEndBeforeAreRefused)
{
  for (const std::string name : {"triangles-41.msh", "triangles-41-binary.msh", "triangles-22.msh", "triangles-22-binary.msh"})
  {
    const std::string text = text_of(test_data + name);
    for (std::size_t length = 0; length + 14 < text.size(); length += 97)
    {
      const TextFile cut(".msh", text.substr(0, length));
      EXPECT_FALSE(index_of_msh(cut.name).has_value()) << name << " " << length;
    }
  }
}

TEST(MshPieces, BytesAndNumbersOfAnyKindAreSurvived)
{
  unsigned   random = 1;
  const auto next = [&random](const std::size_t n)
  {
    random = random * 1664525u + 1013904223u;
    return (random >> 8) % n;
  };
  for (const std::string name :
       {"triangles-41.msh", "triangles-41-binary.msh", "tetrahedra-41.msh", "triangles-22.msh", "triangles-22-binary.msh"})
  {
    const std::string original = text_of(test_data + name);
    for (unsigned k = 0; k < 300; ++k)
    {
      std::string text = original;
      for (unsigned change = 0; change < 1 + k % 4; ++change)
        text[next(text.size())] = k % 2 == 0 ? char(next(256)) : "0123456789 -\n.e"[next(15)];
      const TextFile changed(".msh", text);
      read_or_refuse(changed.name);
    }
  }
}
