// Cells that are refused for their form, and those that are not.
#include "unilateral/mesh/mesh_of_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

using namespace unilateral;

namespace
{
  CellList one_cell(const CellKind kind, const std::vector<std::array<double, 3>> &vertices)
  {
    CellList list;
    list.kind = kind;
    list.vertices.assign(vertices.begin(), vertices.end());
    list.cells.emplace_back();
    for (unsigned v = 0; v < vertices.size(); ++v)
      list.cells[0].push_back(v);
    list.cell_region = {0};
    list.region_names = {"domain"};
    return list;
  }

  /// Whatever the order of its vertices.
  template <int dim>
  unsigned n_orders_refused(CellList list)
  {
    unsigned n_refused = 0;
    do
      try
      {
        const auto mesh = mesh_of_cells<dim>(list, {"case.toml", 1, 1});
        EXPECT_GT(mesh.triangulation->begin_active()->measure(), 0);
      }
      catch (const InputError &)
      {
        ++n_refused;
      }
    while (std::next_permutation(list.cells[0].begin(), list.cells[0].end()));
    return n_refused;
  }
} // namespace

TEST(MeshOfCells, SimplicesAreTurnedTheRightWayRound)
{
  EXPECT_EQ(n_orders_refused<1>(one_cell(CellKind::segment, {{0, 0, 0}, {2, 0, 0}})), 0);
  EXPECT_EQ(n_orders_refused<2>(one_cell(CellKind::triangle, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})), 0);
  EXPECT_EQ(n_orders_refused<3>(one_cell(CellKind::tetrahedron, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})), 0);
}

TEST(MeshOfCells, SharpSimplicesPass)
{
  EXPECT_EQ(n_orders_refused<2>(one_cell(CellKind::triangle, {{0, 0, 0}, {1e4, 0, 0}, {0, 1, 0}})), 0);
  EXPECT_EQ(n_orders_refused<3>(one_cell(CellKind::tetrahedron, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1e4}})), 0);
}

TEST(MeshOfCells, SimplicesAreRefusedWhoseVolumeIsLostInRounding)
{
  EXPECT_EQ(n_orders_refused<2>(one_cell(CellKind::triangle, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}})), 6);
  EXPECT_EQ(n_orders_refused<2>(one_cell(CellKind::triangle, {{0, 0, 0}, {1, 0, 0}, {2, 1e-12, 0}})), 6);
  // Seen from the vertex far off, the other three lie in one place.
  EXPECT_EQ(n_orders_refused<3>(one_cell(CellKind::tetrahedron, {{1e9, 1e9, 1e9}, {0, 1, 0}, {2, 1, 0}, {0, 1, 1}})), 24);
}
