// Cells and names as bytes between processes.
#include "unilateral/mesh/mesh_message.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

using namespace unilateral;

namespace
{
  CellList one_triangle()
  {
    CellList list;
    list.kind = CellKind::triangle;
    list.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    list.cells = {{0, 1, 2}};
    list.cell_region = {0};
    list.region_names = {"domain"};
    return list;
  }
} // namespace

TEST(MeshMessage, is_the_same_on_the_other_side_and_refuses_nonsense)
{
  CellList list = one_triangle();
  list.faces = {{0, 1}};
  list.face_part = {0};
  list.part_names = {"bottom"};
  list.warnings = {"a warning"};
  const std::string bytes = to_bytes(list);
  EXPECT_EQ(to_bytes(cells_of_bytes(bytes)), bytes);
  EXPECT_EQ(cells_of_bytes(bytes).part_names, list.part_names);
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_THROW(cells_of_bytes(bytes.substr(0, n)), std::runtime_error) << n;
  EXPECT_THROW(cells_of_bytes(bytes + "x"), std::runtime_error);
  std::string neither_true_nor_false = bytes; // the last byte says whether the cells approximate curves
  neither_true_nor_false.back() = '\x02';
  EXPECT_THROW(cells_of_bytes(neither_true_nor_false), std::runtime_error);
  EXPECT_THROW(cells_of_bytes(std::string(bytes.size(), '\xff')), std::runtime_error);
  list.cells = {{0, 1, 3}};
  EXPECT_THROW(cells_of_bytes(to_bytes(list)), std::runtime_error);
  list.cells = {{0, 1}};
  EXPECT_THROW(cells_of_bytes(to_bytes(list)), std::runtime_error);

  const MeshOutline outline = {2, {"left", "right"}, {"domain"}};
  EXPECT_EQ(outline_of_bytes(to_bytes(outline)).part_names, outline.part_names);
  EXPECT_THROW(outline_of_bytes(to_bytes(MeshOutline{7, {}, {}})), std::runtime_error);
}

TEST(MeshMessage, has_cells_of_a_drawing_and_checks_them)
{
  CellList list = one_triangle();
  list.drawn_degree = 4;
  list.drawn_cells = {0};
  list.drawn_points.resize(15, {1, 2, 0});
  const CellList same = cells_of_bytes(to_bytes(list));
  EXPECT_EQ(same.drawn_degree, 4u);
  EXPECT_EQ(same.drawn_cells, list.drawn_cells);
  EXPECT_EQ(same.drawn_points, list.drawn_points);

  list.drawn_points.resize(14);
  EXPECT_THROW(cells_of_bytes(to_bytes(list)), std::runtime_error);
  list.drawn_points.resize(15);
  list.drawn_cells = {1};
  EXPECT_THROW(cells_of_bytes(to_bytes(list)), std::runtime_error);
  list.drawn_cells = {0};
  list.drawn_degree = 1; // not above the geometry that the cells have anyway
  list.drawn_points.resize(3);
  EXPECT_THROW(cells_of_bytes(to_bytes(list)), std::runtime_error);
  list.drawn_degree = 1000000;
  EXPECT_THROW(cells_of_bytes(to_bytes(list)), std::runtime_error);
}
