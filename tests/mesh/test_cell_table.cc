// Faces of cells, each with the cells that share it, and cells that are there twice.
#include "unilateral/mesh/box_tree.h"
#include "unilateral/mesh/cell_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

using namespace unilateral;

namespace
{
  /// n x n x n cubes, each cut into six tetrahedra, in an order without rule.
  CellTable tetrahedra(const unsigned n, std::mt19937 &random)
  {
    const unsigned                     step[3] = {1, n + 1, (n + 1) * (n + 1)};
    std::vector<std::vector<unsigned>> cells;
    for (unsigned k = 0; k < n; ++k)
      for (unsigned j = 0; j < n; ++j)
        for (unsigned i = 0; i < n; ++i)
        {
          std::array<unsigned, 3> way = {0, 1, 2};
          do
          {
            const unsigned a = i * step[0] + j * step[1] + k * step[2], b = a + step[way[0]], c = b + step[way[1]];
            cells.push_back({a, b, c, c + step[way[2]]});
          } while (std::next_permutation(way.begin(), way.end()));
        }
    std::shuffle(cells.begin(), cells.end(), random);
    CellTable table{dealii::ReferenceCells::Tetrahedron, {}};
    for (const auto &cell : cells)
      table.vertices.insert(table.vertices.end(), cell.begin(), cell.end());
    return table;
  }
} // namespace

TEST(CellTable, every_face_comes_once_with_its_cells)
{
  std::mt19937   random(3);
  const unsigned n = 4;
  const auto     cells = tetrahedra(n, random);
  const auto     faces = faces_of(cells);
  const unsigned n_boundary = 6 * n * n * 2;
  EXPECT_EQ(faces.size(), (4 * cells.size() + n_boundary) / 2);
  EXPECT_EQ(std::count_if(faces.begin(), faces.end(), [](const auto &face) { return face.at_boundary(); }), n_boundary);
  const auto corners = corners_of_faces(cells.reference);
  for (std::size_t f = 0; f < faces.size(); ++f)
  {
    EXPECT_EQ(faces[f].vertices[3], no_number);
    EXPECT_TRUE(std::is_sorted(faces[f].vertices.begin(), faces[f].vertices.end()));
    if (f > 0)
    {
      EXPECT_LT(faces[f - 1].vertices, faces[f].vertices);
    }
    for (unsigned k = 0; k < faces[f].n_cells; ++k)
      for (unsigned v = 0; v < 3; ++v)
      {
        const auto cell = cells[faces[f].cells[k]];
        EXPECT_NE(std::find(cell.begin(), cell.end(), faces[f].vertices[v]), cell.end());
      }
    std::vector<unsigned> by_number;
    for (const unsigned v : corners[faces[f].number])
      by_number.push_back(cells[faces[f].cells[0]][v]);
    EXPECT_TRUE(std::is_permutation(by_number.begin(), by_number.end(), faces[f].vertices.begin()));
  }
}

TEST(CellTable, a_face_of_three_cells_is_counted)
{
  const CellTable cells{dealii::ReferenceCells::Triangle, {0, 1, 2, 1, 0, 3, 4, 0, 1}};
  const auto      faces = faces_of(cells);
  EXPECT_EQ(faces.size(), 7);
  EXPECT_EQ(faces[0].n_cells, 3);
  EXPECT_EQ(faces[0].cells, (std::array<unsigned, 2>{0, 1}));
}

TEST(CellTable, cells_are_repeated_whatever_the_order_of_their_vertices)
{
  CellTable cells{dealii::ReferenceCells::Quadrilateral, {0, 1, 2, 3, 2, 3, 4, 5, 3, 2, 0, 1, 5, 4, 3, 2, 4, 5, 6, 7, 0, 1, 2, 3}};
  EXPECT_EQ(repeated_cells(cells), (std::vector<char>{false, false, true, true, false, true}));
  cells.vertices.clear();
  EXPECT_TRUE(repeated_cells(cells).empty());
  EXPECT_TRUE(faces_of(cells).empty());
}

TEST(BoxTree, finds_the_boxes_that_meet_another)
{
  std::mt19937                           random(4);
  std::uniform_real_distribution<double> place(0, 1), size(0, 0.1);
  std::vector<BoxTree<2>::Box>           boxes;
  const auto                             box = [&]
  {
    const dealii::Point<2> lower(place(random), place(random));
    return BoxTree<2>::Box(lower, dealii::Point<2>(lower[0] + size(random), lower[1] + size(random)));
  };
  for (unsigned k = 0; k < 500; ++k)
    boxes.push_back(box());
  const BoxTree<2> tree(boxes);
  for (unsigned t = 0; t < 100; ++t)
  {
    const auto         other = box();
    std::set<unsigned> found, expected;
    EXPECT_FALSE(tree.any(other, [&](const unsigned k) { return !found.insert(k).second; }));
    for (unsigned k = 0; k < boxes.size(); ++k)
      if (boxes[k].first[0] <= other.second[0] && other.first[0] <= boxes[k].second[0] && boxes[k].first[1] <= other.second[1] &&
          other.first[1] <= boxes[k].second[1])
        expected.insert(k);
    EXPECT_EQ(found, expected);
  }
  EXPECT_FALSE(BoxTree<2>({}).any(box(), [](const unsigned) { return true; }));
}
