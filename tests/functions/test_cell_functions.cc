// Functions on cells: exact where they are polynomials of the lattice, by a search that finds every point.
#include "unilateral/functions/cell_functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace unilateral;

namespace
{
  using Coordinates = std::array<double, 3>;
  using Scalar = std::function<double(const Coordinates &)>;

  /// n cells a direction of the unit cube; @p map moves their nodes; simplices cut squares along a diagonal (2-D alone).
  CellNodes unit_cube(const unsigned                                 dim,
                      const bool                                     simplex,
                      const unsigned                                 n,
                      const unsigned                                 degree,
                      const unsigned                                 map_degree,
                      const std::function<Coordinates(Coordinates)> &map)
  {
    CellNodes nodes;
    nodes.dim = dim;
    nodes.simplex = simplex;
    nodes.degree = degree;
    nodes.map_degree = map_degree;
    for (unsigned k = 0; k < (dim > 2 ? n : 1); ++k)
      for (unsigned j = 0; j < (dim > 1 ? n : 1); ++j)
        for (unsigned i = 0; i < n; ++i)
          for (unsigned half = 0; half < (simplex ? 2 : 1); ++half)
            for (const auto &index : nodes.lattice(map_degree))
            {
              Coordinates x{};
              for (unsigned d = 0; d < dim; ++d)
              {
                const double in_cell = double(index[d]) / map_degree;
                x[d] = (std::array<unsigned, 3>{i, j, k}[d] + (half ? 1 - in_cell : in_cell)) / n;
              }
              nodes.map_nodes.push_back(nodes.points.size());
              nodes.points.push_back(map(x));
            }
    return nodes;
  }

  /// The values of @p f at the nodes of functions, which are those of the map.
  std::shared_ptr<const CellFunctions> with_values(CellNodes nodes, const Scalar &f)
  {
    std::vector<double> values;
    for (const std::uint32_t node : nodes.map_nodes)
    {
      nodes.value_nodes.push_back(values.size());
      values.push_back(f(nodes.points[node]));
    }
    return std::make_shared<const CellFunctions>(std::move(nodes), std::map<std::string, std::vector<double>>{{"u", values}});
  }

  void expect_equal(const CellFunctions                           &cells,
                    const unsigned                                 dim,
                    const Scalar                                  &f,
                    const std::function<Coordinates(Coordinates)> &map,
                    const double                                   tolerance)
  {
    const auto                             source = cells.function("u", 2, 1, "it");
    std::mt19937                           random(1);
    std::uniform_real_distribution<double> number(0, 1);
    for (unsigned trial = 0; trial < 200; ++trial)
    {
      Coordinates x{};
      for (unsigned d = 0; d < dim; ++d)
        x[d] = trial < 8 ? (trial >> d) % 2 : number(random);
      x = map(x);
      double      value = 0;
      Coordinates slope{};
      ASSERT_TRUE(source->values({&x, 1}, {&value, 1}, {&slope, 1}));
      EXPECT_NEAR(value, 2 * f(x) + 1, tolerance);
      EXPECT_NEAR(source->value(x[0], x[1], x[2]), value, 1e-15 + 1e-15 * std::abs(value));
      for (unsigned d = 0; d < dim; ++d)
      {
        Coordinates a = x, b = x;
        a[d] += 1e-6;
        b[d] -= 1e-6;
        EXPECT_NEAR(slope[d], 2 * (f(a) - f(b)) / 2e-6, 1e-6 + 100 * tolerance);
      }
    }
  }

  const auto   same = [](const Coordinates x) { return x; };
  const Scalar linear = [](const Coordinates &x) { return 1 + 2 * x[0] - 3 * x[1] + x[2]; };
  const Scalar quadratic = [](const Coordinates &x) { return x[0] * x[0] - 3 * x[0] * x[1] + x[1] * x[1] + x[2] * x[2]; };
} // namespace

TEST(CellFunctions, polynomials_of_the_lattice_are_exact)
{
  for (unsigned dim = 1; dim <= 3; ++dim)
  {
    expect_equal(*with_values(unit_cube(dim, false, 5, 1, 1, same), linear), dim, linear, same, 1e-13);
    expect_equal(*with_values(unit_cube(dim, false, 5, 2, 2, same), quadratic), dim, quadratic, same, 1e-12);
  }
  expect_equal(*with_values(unit_cube(2, true, 6, 1, 1, same), linear), 2, linear, same, 1e-13);
  expect_equal(*with_values(unit_cube(2, true, 6, 2, 2, same), quadratic), 2, quadratic, same, 1e-12);
  expect_equal(*with_values(unit_cube(2, true, 6, 3, 3, same), quadratic), 2, quadratic, same, 1e-12);
}

TEST(CellFunctions, linear_functions_are_exact_on_cells_that_are_no_parallelograms)
{
  const auto sheared = [](const Coordinates x) { return Coordinates{x[0] + 0.2 * x[0] * x[1], x[1] - 0.3 * x[0] * x[1], x[2]}; };
  expect_equal(*with_values(unit_cube(2, false, 4, 1, 1, sheared), linear), 2, linear, sheared, 1e-12);
  expect_equal(*with_values(unit_cube(3, false, 4, 1, 1, sheared), linear), 3, linear, sheared, 1e-12);
  const auto bent = [](const Coordinates x) { return Coordinates{x[0] + 0.1 * x[1] * x[1], x[1], x[2]}; };
  expect_equal(*with_values(unit_cube(2, false, 4, 2, 2, bent), linear), 2, linear, bent, 1e-11);
}

TEST(CellFunctions, outside_of_the_mesh_there_is_no_value)
{
  const auto cells = with_values(unit_cube(2, false, 10, 1, 1, same), linear);
  const auto source = cells->function("u", 1, 0, "it");
  EXPECT_NEAR(source->value(-0.004, 0.5, 0), linear({-0.004, 0.5, 0}), 1e-12); // less than a twentieth of a cell
  EXPECT_THROW(source->value(-0.006, 0.5, 0), std::domain_error);
  EXPECT_THROW(source->value(5, 5, 0), std::domain_error);
  EXPECT_EQ(cells->function("v", 1, 0, "it"), nullptr);
}
