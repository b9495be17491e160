// The round surface that facets stand for: found by the corners, and only where they are facets of one.
#include "unilateral/constraints/round_surface.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace unilateral;
  using dealii::Point;

  constexpr double pi = dealii::numbers::PI;

  /// Segments of an arc of a circle, or an ellipse, unevenly long, the body inside or outside.
  std::vector<Facet<2>> arc(const unsigned n, const double angle, const Point<2> &centre, const double ratio = 1, const double sign = 1)
  {
    std::vector<Point<2>> corners;
    for (unsigned i = 0; i <= n; ++i)
    {
      const double phi = angle * (i + 0.2 * std::sin(3. * i)) / n;
      corners.push_back(centre + 2. * Point<2>(std::cos(phi), ratio * std::sin(phi)));
    }
    std::vector<Facet<2>> facets;
    for (unsigned i = 0; i < n; ++i)
    {
      const auto along = corners[i + 1] - corners[i];
      facets.push_back({{corners[i], corners[i + 1]}, sign * dealii::Tensor<1, 2>({along[1], -along[0]}) / along.norm()});
    }
    return facets;
  }

  /// Quadrilaterals of the cylinder of radius 2 about the z axis, or of the sphere.
  std::vector<Facet<3>> zone(const bool sphere)
  {
    constexpr unsigned n = 16, layers = 3;
    const auto         point = [&](const unsigned i, const unsigned k)
    {
      const double phi = 2 * pi * (i + 0.2 * std::sin(3. * (i % n))) / n, height = 0.3 * k - 0.45,
                   radius = sphere ? 2 * std::cos(height) : 2;
      return Point<3>(radius * std::cos(phi), radius * std::sin(phi), sphere ? 2 * std::sin(height) : height);
    };
    std::vector<Facet<3>> facets;
    for (unsigned i = 0; i < n; ++i)
      for (unsigned k = 0; k < layers; ++k)
      {
        Facet<3> facet{{point(i, k), point(i + 1, k), point(i, k + 1), point(i + 1, k + 1)}, {}};
        facet.normal = cross_product_3d(facet.corners[1] - facet.corners[0], facet.corners[2] - facet.corners[0]);
        facet.normal /= facet.normal.norm();
        facets.push_back(facet);
      }
    return facets;
  }
} // namespace

TEST(RoundSurface, of_arcs_has_radial_normals)
{
  for (const double angle : {2 * pi, pi / 2, 0.3})
    for (const auto &centre : {Point<2>(0, 0), Point<2>(1, -3), Point<2>(2e5, 1e5)})
      for (const double sign : {1., -1.})
      {
        const auto surface = round_surface_of(arc(24, angle, centre, 1, sign), {});
        ASSERT_TRUE(surface) << angle << ' ' << centre;
        const Point<2> x = centre + 1.9 * Point<2>(std::cos(0.1), std::sin(0.1));
        const auto     normal = surface->normal(x);
        EXPECT_NEAR(normal[0], sign * std::cos(0.1), 1e-6);
        EXPECT_NEAR(normal[1], sign * std::sin(0.1), 1e-6);
      }
}

TEST(RoundSurface, in_space_is_a_sphere_or_a_cylinder_about_the_given_direction)
{
  const auto sphere = round_surface_of(zone(true), {});
  ASSERT_TRUE(sphere);
  EXPECT_LT((sphere->normal(Point<3>(2, 0, 1)) - Point<3>(2, 0, 1) / std::sqrt(5.)).norm(), 1e-9);
  const std::array<double, 3> z{0, 0, 1}, x{1, 0, 0};
  const auto                  cylinder = round_surface_of(zone(false), z);
  ASSERT_TRUE(cylinder);
  EXPECT_LT((cylinder->normal(Point<3>(0, 2, 1)) - Point<3>(0, 1, 0)).norm(), 1e-9);
  EXPECT_FALSE(round_surface_of(zone(false), {}));
  EXPECT_FALSE(round_surface_of(zone(false), x));
}

TEST(RoundSurface, of_a_ball_beside_a_cylinder_is_a_sphere)
{
  const auto sphere = round_surface_of(zone(true), std::array<double, 3>{0, 0, 1});
  ASSERT_TRUE(sphere);
  EXPECT_EQ(sphere->axis, (std::array<double, 3>{}));
}

TEST(RoundSurface, of_few_facets_is_known_where_refinement_makes_it_round)
{
  EXPECT_FALSE(round_surface_of(arc(4, 2 * pi, {}, 1), {}));
  EXPECT_TRUE(round_surface_of(arc(4, 2 * pi, {}, 1), {}, true));
}

TEST(RoundSurface, is_none_of_other_parts)
{
  EXPECT_FALSE(round_surface_of(arc(24, 2 * pi, {}, 1.001), {})); // an ellipse
  EXPECT_FALSE(round_surface_of(std::vector<Facet<2>>(), {}));
  EXPECT_FALSE(round_surface_of<2>({{{Point<2>(0, 0), Point<2>(1, 0)}, dealii::Tensor<1, 2>({0, -1})}}, {})); // a single facet
  // Straight, in two facets.
  EXPECT_FALSE(round_surface_of<2>(
    {{{Point<2>(0, 0), Point<2>(1, 0)}, dealii::Tensor<1, 2>({0, -1})}, {{Point<2>(1, 0), Point<2>(3, 0)}, dealii::Tensor<1, 2>({0, -1})}},
    {}));
  // The corners of a nut and of a square lie on a circle, too.
  for (const unsigned n : {4, 6})
  {
    std::vector<Facet<2>> nut;
    for (unsigned i = 0; i < n; ++i)
    {
      const double phi = 2 * pi * i / n, next = 2 * pi * (i + 1) / n, middle = 0.5 * (phi + next);
      nut.push_back({{Point<2>(std::cos(phi), std::sin(phi)), Point<2>(std::cos(next), std::sin(next))},
                     dealii::Tensor<1, 2>({std::cos(middle), std::sin(middle)})});
    }
    EXPECT_FALSE(round_surface_of(nut, {})) << n;
  }
}
