// Meshes that lie over themselves are found, others are let pass.
#include "unilateral/mesh/mesh_of_cells.h"
#include "unilateral/mesh/overlapping_cells.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

using namespace unilateral;

namespace
{
  /// n x n squares, each one quadrilateral or cut into two triangles, in lexicographic order.
  CellList square(const unsigned n, const bool triangles)
  {
    CellList list;
    list.kind = triangles ? CellKind::triangle : CellKind::quadrilateral;
    for (unsigned j = 0; j <= n; ++j)
      for (unsigned i = 0; i <= n; ++i)
        list.vertices.push_back({double(i) / n, double(j) / n, 0});
    for (unsigned j = 0; j < n; ++j)
      for (unsigned i = 0; i < n; ++i)
      {
        const unsigned a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
        if (triangles)
          list.cells.insert(list.cells.end(), {{a, b, c}, {b, d, c}});
        else
          list.cells.push_back({a, b, c, d});
      }
    list.cell_region.assign(list.cells.size(), 0);
    list.region_names = {"domain"};
    return list;
  }

  /// n x n x n cubes, each one hexahedron or cut into six tetrahedra around a diagonal.
  CellList cube(const unsigned n, const bool tetrahedra)
  {
    CellList list;
    list.kind = tetrahedra ? CellKind::tetrahedron : CellKind::hexahedron;
    const unsigned step[3] = {1, n + 1, (n + 1) * (n + 1)};
    for (unsigned k = 0; k <= n; ++k)
      for (unsigned j = 0; j <= n; ++j)
        for (unsigned i = 0; i <= n; ++i)
          list.vertices.push_back({double(i) / n, double(j) / n, double(k) / n});
    for (unsigned k = 0; k < n; ++k)
      for (unsigned j = 0; j < n; ++j)
        for (unsigned i = 0; i < n; ++i)
        {
          const unsigned a = i * step[0] + j * step[1] + k * step[2];
          if (!tetrahedra)
          {
            list.cells.emplace_back();
            for (unsigned v = 0; v < 8; ++v)
              list.cells.back().push_back(a + (v & 1 ? step[0] : 0) + (v & 2 ? step[1] : 0) + (v & 4 ? step[2] : 0));
            continue;
          }
          for (const std::array<unsigned, 3> &way :
               {std::array<unsigned, 3>{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}})
          {
            const unsigned b = a + step[way[0]], c = b + step[way[1]], d = c + step[way[2]];
            list.cells.push_back({a, b, c, d});
          }
        }
    list.cell_region.assign(list.cells.size(), 0);
    list.region_names = {"domain"};
    return list;
  }

  void move_inside(CellList &list, const double distance, std::mt19937 &random, const unsigned dim)
  {
    std::uniform_real_distribution<double> move(-distance, distance);
    for (auto &x : list.vertices)
    {
      bool inside = true;
      for (unsigned d = 0; d < dim; ++d)
        inside = inside && x[d] > 1e-9 && x[d] < 1 - 1e-9;
      for (unsigned d = 0; d < dim && inside; ++d)
        x[d] += move(random);
    }
  }

  template <int dim>
  std::string refusal(const CellList &list)
  {
    try
    {
      mesh_of_cells<dim>(list, {"case.toml", 1, 1});
    }
    catch (const InputError &e)
    {
      return e.what();
    }
    return "";
  }
} // namespace

TEST(OverlappingCells, irregular_meshes_pass_wherever_they_lie)
{
  std::mt19937 random(5);
  for (const bool simplices : {false, true})
    for (const double shift : {0., 1e6})
    {
      CellList plane = square(8, simplices), space = cube(4, simplices);
      move_inside(plane, 0.2 / 8, random, 2);
      move_inside(space, 0.1 / 4, random, 3);
      for (CellList *const list : {&plane, &space})
        for (auto &x : list->vertices)
          x[0] += shift;
      EXPECT_EQ(refusal<2>(plane), "");
      EXPECT_EQ(refusal<3>(space), "");
    }
}

TEST(OverlappingCells, a_vertex_pulled_over_its_neighbours_folds_the_mesh)
{
  CellList plane = square(6, true);
  plane.vertices[3 * 7 + 3] = {0.5 + 0.3, 0.5 + 0.03, 0};
  EXPECT_NE(refusal<2>(plane).find("lie over each other"), std::string::npos) << refusal<2>(plane);
  CellList space = cube(4, true);
  space.vertices[2 * 25 + 2 * 5 + 2] = {0.9, 0.55, 0.45};
  EXPECT_NE(refusal<3>(space).find("lie over each other"), std::string::npos) << refusal<3>(space);
}

TEST(OverlappingCells, pieces_that_lie_in_each_other_are_found_and_pieces_that_touch_are_not)
{
  for (const bool simplices : {false, true})
    for (const double shift : {1., 0.9})
    {
      const auto twice = [&](const CellList &one)
      {
        CellList       both = one;
        const unsigned n = one.vertices.size();
        for (auto x : one.vertices)
          both.vertices.push_back({x[0] + shift, x[1] + 0.013, x[2]});
        for (auto cell : one.cells)
        {
          for (unsigned &v : cell)
            v += n;
          both.cells.push_back(cell);
        }
        both.cell_region.assign(both.cells.size(), 0);
        return both;
      };
      const std::string in_plane = refusal<2>(twice(square(5, simplices))), in_space = refusal<3>(twice(cube(3, simplices)));
      EXPECT_EQ(in_plane == "", shift == 1) << in_plane;
      EXPECT_EQ(in_space == "", shift == 1) << in_space;
    }
}

TEST(OverlappingCells, a_small_piece_deep_in_a_large_one_is_found)
{
  for (const bool simplices : {false, true})
  {
    CellList   plane = square(16, simplices), space = cube(8, simplices);
    const auto put_inside = [](CellList &list, const CellList &piece)
    {
      const unsigned n = list.vertices.size();
      const bool     is_flat = dimension(piece.kind) == 2;
      for (const auto &x : piece.vertices)
        list.vertices.push_back({0.47 + 0.13 * x[0], 0.43 + 0.13 * x[1], is_flat ? 0 : 0.45 + 0.1 * x[2]});
      for (auto cell : piece.cells)
      {
        for (unsigned &v : cell)
          v += n;
        list.cells.push_back(cell);
        list.cell_region.push_back(0);
      }
    };
    put_inside(plane, square(2, simplices));
    put_inside(space, cube(2, simplices));
    EXPECT_NE(refusal<2>(plane).find("lie over each other"), std::string::npos) << refusal<2>(plane);
    EXPECT_NE(refusal<3>(space).find("lie over each other"), std::string::npos) << refusal<3>(space);
  }
}

TEST(OverlappingCells, a_ring_that_goes_round_twice_is_found_though_neighbours_fit)
{
  CellList       list;
  const unsigned n = 24;
  list.kind = CellKind::quadrilateral;
  for (unsigned k = 0; k <= n; ++k)
    for (const double r : {1., 1.5})
      list.vertices.push_back({r * std::cos(4 * 3.14159265358979 * k / n), r * std::sin(4 * 3.14159265358979 * k / n), 0});
  for (unsigned k = 0; k < n; ++k)
    list.cells.push_back({2 * k, 2 * k + 1, 2 * k + 2, 2 * k + 3});
  list.cell_region.assign(n, 0);
  list.region_names = {"domain"};
  EXPECT_NE(refusal<2>(list), "");
}

TEST(OverlappingCells, triangles_that_go_round_an_inner_vertex_twice_are_found)
{
  for (const unsigned times : {1, 2})
  {
    CellList       list;
    const unsigned n = 10;
    list.kind = CellKind::triangle;
    list.vertices.push_back({0, 0, 0});
    for (unsigned k = 0; k < n; ++k)
      list.vertices.push_back({std::cos(times * 2 * 3.14159265358979 * k / n), std::sin(times * 2 * 3.14159265358979 * k / n), 0});
    for (unsigned k = 0; k < n; ++k)
      list.cells.push_back({0, k + 1, (k + 1) % n + 1});
    list.cell_region.assign(n, 0);
    list.region_names = {"domain"};
    EXPECT_EQ(refusal<2>(list) == "", times == 1) << refusal<2>(list);
  }
}

TEST(OverlappingCells, a_face_of_three_cells_is_refused)
{
  CellList list = cube(1, true);
  list.vertices.push_back({0.3, 0.4, 0.2});
  const auto cell = list.cells[0];
  list.cells.push_back({cell[1], cell[2], cell[3], unsigned(list.vertices.size() - 1)});
  list.cell_region.assign(list.cells.size(), 0);
  EXPECT_NE(refusal<3>(list), "");
}

TEST(OverlappingCells, segments_that_lie_over_each_other_are_found)
{
  const auto line = [](const std::vector<double> &x, const std::vector<std::vector<unsigned>> &cells)
  {
    CellList list;
    for (const double coordinate : x)
      list.vertices.push_back({coordinate, 0, 0});
    list.cells = cells;
    list.cell_region.assign(cells.size(), 0);
    list.region_names = {"domain"};
    return list;
  };
  EXPECT_EQ(refusal<1>(line({0, 2, 1, 3}, {{1, 2}, {0, 2}, {3, 1}})), "");
  EXPECT_EQ(refusal<1>(line({0, 1, 1, 2}, {{0, 1}, {2, 3}})), "") << "two pieces";
  EXPECT_NE(refusal<1>(line({0, 1, 0.5}, {{0, 1}, {2, 1}})), "") << "folded back";
  EXPECT_NE(refusal<1>(line({0, 3, 1, 2}, {{0, 1}, {2, 3}})), "") << "one in another";
}

TEST(OverlappingCells, cells_of_another_dimension_make_no_mesh)
{
  EXPECT_NE(refusal<1>(square(2, true)), "");
  EXPECT_NE(refusal<2>(cube(2, false)), "");
  EXPECT_NE(refusal<2>(cube(2, true)), "");
  EXPECT_NE(refusal<3>(square(2, false)), "");
}
