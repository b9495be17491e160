// Coarse cells as polynomials of higher degree.
#include "unilateral/mesh/drawn_cells.h"

#include <gtest/gtest.h>

using namespace unilateral;
using dealii::Point;

namespace
{
  Point<2> bent(const Point<2> &x)
  {
    return {x[0] + 0.1 * x[1] * x[1] * x[1], x[1] - 0.2 * x[0] * x[0] * x[1]};
  }

  DrawnCells<2> bent_cell(const bool simplex, const double size = 1)
  {
    DrawnCells<2>         cells(simplex, 4);
    std::vector<Point<2>> nodes;
    for (const Point<2> &unit : cells.unit_nodes())
      nodes.push_back(size * bent(unit));
    cells.add(7, nodes);
    return cells;
  }
} // namespace

TEST(DrawnCells, polynomials_of_their_degree_are_exact)
{
  for (const bool simplex : {true, false})
  {
    const auto cells = bent_cell(simplex);
    EXPECT_TRUE(cells.contain(7));
    EXPECT_FALSE(cells.contain(0));
    for (const Point<2> &x : {Point<2>(0.2, 0.3), Point<2>(0.6, 0.1), Point<2>(0, 0.9)})
      EXPECT_LT(cells.position(7, x).distance(bent(x)), 1e-14) << simplex;
    EXPECT_TRUE(cells.folded_cells().empty());
    EXPECT_EQ(bent_cell(simplex, 1e-9).folded_cells().size(), 0u);
  }
}

TEST(DrawnCells, folded_ones_are_found)
{
  auto                  cells = bent_cell(true);
  std::vector<Point<2>> nodes;
  for (const Point<2> &unit : cells.unit_nodes())
    nodes.emplace_back(unit[0] - 2 * unit[0] * unit[0], unit[1]);
  cells.add(3, nodes);
  EXPECT_EQ(cells.folded_cells(), std::vector<unsigned>{3});
  for (std::size_t n = 0; n < nodes.size(); ++n)
    cells.move_node(3, n, cells.unit_nodes()[n]);
  EXPECT_TRUE(cells.folded_cells().empty());
}
