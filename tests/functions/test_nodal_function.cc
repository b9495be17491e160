// Functions by nodal values: exact for what the shape functions hold, found on every cell, absent outside.

#include "unilateral/functions/nodal_function.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace unilateral;

namespace
{
  /// The unit square as one distorted quadrilateral beside another, or as triangles.
  std::shared_ptr<NodalMesh> square(const bool triangles)
  {
    auto mesh = std::make_shared<NodalMesh>();
    mesh->points = {{0, 0, 0}, {0.6, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 1, 0}, {1, 1, 0}};
    if (triangles)
      mesh->cells = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
    else
      mesh->cells = {{0, 1, 3, 4}, {1, 2, 4, 5}};
    return mesh;
  }

  double linear(const std::array<double, 3> &x)
  {
    return 2 + 3 * x[0] - 5 * x[1] + 7 * x[2];
  }

  std::vector<double> at_points(const NodalMesh &mesh)
  {
    std::vector<double> values;
    for (const auto &x : mesh.points)
      values.push_back(linear(x));
    return values;
  }
} // namespace

TEST(NodalFunction, ReproducesLinearFunctionsAndTheirGradients)
{
  for (const bool triangles : {false, true})
  {
    const auto          mesh = square(triangles);
    const FieldFunction f(nodal_function(mesh, at_points(*mesh)), {});
    for (double x = 0; x <= 1; x += 0.125)
      for (double y = 0; y <= 1; y += 0.125)
      {
        EXPECT_NEAR(f.value(dealii::Point<2>(x, y)), linear({x, y, 0}), 1e-11) << x << ' ' << y;
        const auto slope = f.gradient(dealii::Point<2>(x, y));
        EXPECT_NEAR(slope[0], 3, 1e-9);
        EXPECT_NEAR(slope[1], -5, 1e-9);
      }
  }
}

TEST(NodalFunction, InOneAndThreeDimensions)
{
  auto line = std::make_shared<NodalMesh>();
  line->dim = 1;
  line->points = {{2, 0, 0}, {1, 0, 0}, {0, 0, 0}};
  line->cells = {{1, 0}, {2, 1}};
  const FieldFunction on_line(nodal_function(line, {0, 1, 0}), {});
  EXPECT_NEAR(on_line.value(dealii::Point<1>(0.25)), 0.25, 1e-14);
  EXPECT_NEAR(on_line.gradient(dealii::Point<1>(1.5))[0], -1, 1e-12);

  for (const bool simplices : {false, true})
  {
    auto cube = std::make_shared<NodalMesh>();
    cube->dim = 3;
    for (unsigned k = 0; k < 8; ++k)
      cube->points.push_back({double(k & 1), double(k >> 1 & 1), double(k >> 2)});
    if (simplices)
      cube->cells = {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}};
    else
      cube->cells = {{0, 1, 2, 3, 4, 5, 6, 7}};
    const FieldFunction f(nodal_function(cube, at_points(*cube)), {});
    EXPECT_NEAR(f.value(dealii::Point<3>(0.2, 0.7, 0.4)), linear({0.2, 0.7, 0.4}), 1e-12);
    EXPECT_NEAR(f.gradient(dealii::Point<3>(0.2, 0.7, 0.4))[2], 7, 1e-9);
  }
}

TEST(NodalFunction, EndsWithTheMesh)
{
  const auto          mesh = square(true);
  const FieldFunction f(nodal_function(mesh, at_points(*mesh)), {"a.toml", 3, 1});
  EXPECT_NEAR(f.value(dealii::Point<2>(1 + 1e-9, 0.5)), linear({1, 0.5, 0}), 1e-7);
  EXPECT_THROW(f.value(dealii::Point<2>(1.01, 0.5)), InputError);
  EXPECT_THROW(nodal_function(mesh, {1, 2}), std::runtime_error);
}
