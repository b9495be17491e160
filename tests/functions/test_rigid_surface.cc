// Surfaces of rigid obstacles: how far they are, how they are read from STL files, and what is refused.

#include "unilateral/functions/make_rigid_surface.h"
#include "unilateral/functions/stl_file.h"
#include "unilateral/functions/stl_surface.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

using namespace unilateral;

namespace
{
  using Point = std::array<double, 3>;

  Point operator+(const Point &a, const Point &b)
  {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
  }

  Point operator-(const Point &a, const Point &b)
  {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  }

  Point operator*(const double s, const Point &a)
  {
    return {s * a[0], s * a[1], s * a[2]};
  }

  double dot(const Point &a, const Point &b)
  {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  double norm(const Point &a)
  {
    return std::sqrt(dot(a, a));
  }

  Point cross(const Point &a, const Point &b)
  {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }

  Point unit(const Point &a)
  {
    return 1 / norm(a) * a;
  }

  /// Points and directions, the same in every run.
  class Random
  {
  public:
    explicit Random(const unsigned seed) : engine(seed) {}
    double number(const double low, const double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
    Point  point(const double size) { return {number(-size, size), number(-size, size), number(-size, size)}; }
    Point  direction()
    {
      for (;;)
        if (const Point p = point(1); norm(p) > 0.1 && norm(p) < 1)
          return unit(p);
    }

  private:
    std::mt19937 engine;
  };

  SurfaceDescription plane(const std::vector<double> &point, const std::vector<double> &normal)
  {
    SurfaceDescription spec;
    spec.kind = SurfaceDescription::Kind::plane;
    spec.point = point;
    spec.direction = normal;
    return spec;
  }

  SurfaceDescription sphere(const std::vector<double> &center, const double radius, const bool inside = false)
  {
    SurfaceDescription spec;
    spec.kind = SurfaceDescription::Kind::sphere;
    spec.point = center;
    spec.radius = radius;
    spec.inside = inside;
    return spec;
  }

  SurfaceDescription
  cylinder(const std::vector<double> &point, const std::vector<double> &axis, const double radius, const bool inside = false)
  {
    SurfaceDescription spec = sphere(point, radius, inside);
    spec.kind = SurfaceDescription::Kind::cylinder;
    spec.direction = axis;
    return spec;
  }

  SurfaceDescription stl(const std::string &file)
  {
    SurfaceDescription spec;
    spec.kind = SurfaceDescription::Kind::stl;
    spec.file = file;
    spec.where = {"case.toml", 7, 9};
    return spec;
  }

  std::string message_of(const std::function<void()> &action)
  {
    try
    {
      action();
    }
    catch (const InputError &e)
    {
      return e.what();
    }
    return "";
  }

  testing::AssertionResult contains(const std::string &text, const std::string &part)
  {
    if (text.find(part) != std::string::npos)
      return testing::AssertionSuccess();
    return testing::AssertionFailure() << "'" << text << "' does not contain '" << part << "'";
  }

  constexpr double none = std::numeric_limits<double>::infinity();

  /// The distance, or infinity where there is none.
  double distance(const std::shared_ptr<const RigidSurface> &surface, const Point &x, const Point &d)
  {
    return surface->distance(x, d).value_or(none);
  }

  // --- surfaces of triangles ---

  /// [0,1]^3, two triangles a face, normals outward.
  std::vector<StlTriangle> cube()
  {
    const auto               v = [](const int i) { return Point{double(i & 1), double((i >> 1) & 1), double((i >> 2) & 1)}; };
    std::vector<StlTriangle> triangles;
    for (const auto &[a, b, c, d] : {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    {
      triangles.push_back({v(a), v(b), v(c)});
      triangles.push_back({v(a), v(c), v(d)});
    }
    return triangles;
  }

  std::vector<StlTriangle> moved(std::vector<StlTriangle> triangles, const Point &shift)
  {
    for (StlTriangle &triangle : triangles)
      for (Point &vertex : triangle)
        vertex = vertex + shift;
    return triangles;
  }

  std::vector<StlTriangle> turned_inside_out(std::vector<StlTriangle> triangles)
  {
    for (StlTriangle &triangle : triangles)
      std::swap(triangle[1], triangle[2]);
    return triangles;
  }

  std::vector<StlTriangle> together(std::vector<StlTriangle> one, const std::vector<StlTriangle> &other)
  {
    one.insert(one.end(), other.begin(), other.end());
    return one;
  }

  /// The unit sphere: an octahedron, each triangle cut in four @p levels times.
  std::vector<StlTriangle> ball(const unsigned levels)
  {
    std::vector<StlTriangle> triangles;
    for (const double x : {-1., 1.})
      for (const double y : {-1., 1.})
        for (const double z : {-1., 1.})
        {
          StlTriangle t = {Point{x, 0, 0}, Point{0, y, 0}, Point{0, 0, z}};
          if (x * y * z < 0)
            std::swap(t[1], t[2]);
          triangles.push_back(t);
        }
    for (unsigned level = 0; level < levels; ++level)
    {
      std::vector<StlTriangle> finer;
      for (const auto &[a, b, c] : triangles)
      {
        const Point ab = unit(a + b), bc = unit(b + c), ca = unit(c + a);
        finer.insert(finer.end(), {StlTriangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
      }
      triangles = std::move(finer);
    }
    return triangles;
  }

  /// z = @p height on the unit square, @p n squares a side, seen from above.
  std::vector<StlTriangle> relief(const unsigned n, const std::function<double(double, double)> &height)
  {
    const auto v = [&](const unsigned i, const unsigned j)
    {
      const double x = double(i) / n, y = double(j) / n;
      return Point{x, y, height(x, y)};
    };
    std::vector<StlTriangle> triangles;
    for (unsigned i = 0; i < n; ++i)
      for (unsigned j = 0; j < n; ++j)
      {
        triangles.push_back({v(i, j), v(i + 1, j), v(i + 1, j + 1)});
        triangles.push_back({v(i, j), v(i + 1, j + 1), v(i, j + 1)});
      }
    return triangles;
  }

  double flat(double, double)
  {
    return 0;
  }

  std::string text_stl(const std::vector<StlTriangle> &triangles)
  {
    std::string text = "solid the name of it\n";
    for (const StlTriangle &triangle : triangles)
    {
      text += "  facet normal 0 0 0\n    outer loop\n";
      for (const Point &vertex : triangle)
      {
        char line[100];
        std::snprintf(line, sizeof line, "      vertex %.17g %.17g %.17g\n", vertex[0], vertex[1], vertex[2]);
        text += line;
      }
      text += "    endloop\n  endfacet\n";
    }
    return text + "endsolid the name of it\n";
  }

  void append(std::string &bytes, const std::uint32_t number)
  {
    for (unsigned i = 0; i < 4; ++i)
      bytes += static_cast<char>(number >> (8 * i));
  }

  std::string binary_stl(const std::vector<StlTriangle> &triangles, std::string header = "made by a test")
  {
    header.resize(80, '\0');
    append(header, static_cast<std::uint32_t>(triangles.size()));
    for (const StlTriangle &triangle : triangles)
    {
      for (unsigned i = 0; i < 3; ++i)
        append(header, 0);
      for (const Point &vertex : triangle)
        for (const double coordinate : vertex)
          append(header, std::bit_cast<std::uint32_t>(static_cast<float>(coordinate)));
      header += std::string(2, '\0');
    }
    return header;
  }

  class Files : public testing::Test
  {
  protected:
    Files() : folder(std::filesystem::temp_directory_path() / ("unilateral_rigid_surface_" + std::to_string(::getpid())))
    {
      std::filesystem::create_directories(folder);
    }
    ~Files() override { std::filesystem::remove_all(folder); }

    std::string file(const std::string &name) const { return (folder / name).string(); }

    std::string write(const std::string &name, const std::string &bytes) const
    {
      std::ofstream(file(name), std::ios::binary) << bytes;
      return file(name);
    }

    std::string message_for(const std::string &bytes) const
    {
      const std::string path = write("wrong.stl", bytes);
      return message_of([&] { make_rigid_surface(stl(path)); });
    }

    const std::filesystem::path folder;
  };

  /// Where the line x + t d passes through the inner part of the box [a,b]^3: entrance and exit, or nothing.
  std::optional<std::pair<double, double>> pass_through_box(const Point &x, const Point &d, const double a, const double b)
  {
    double in = -none, out = none;
    for (unsigned i = 0; i < 3; ++i)
      if (d[i] == 0)
      {
        if (x[i] <= a || x[i] >= b)
          return {};
      }
      else
      {
        in = std::max(in, std::min((a - x[i]) / d[i], (b - x[i]) / d[i]));
        out = std::min(out, std::max((a - x[i]) / d[i], (b - x[i]) / d[i]));
      }
    return in < out ? std::optional(std::pair(in, out)) : std::nullopt;
  }

  /// Checks the surface of [0,1]^3 on lines in all 26 lattice directions from the points of a lattice: most of them meet edges and
  /// vertices. Lines that only touch the cube may count as touching it or as missing it; with @p rough faces they may touch anywhere.
  void
  expect_cube(const std::shared_ptr<const RigidSurface> &surface, const double tolerance, const double spacing, const bool rough = false)
  {
    const int n = static_cast<int>(std::lround(3 / spacing));
    for (int direction = 0; direction < 27; ++direction)
    {
      const Point lattice = {double(direction % 3 - 1), double(direction / 3 % 3 - 1), double(direction / 9 - 1)};
      if (norm(lattice) == 0)
        continue;
      const Point d = unit(lattice);
      for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
          for (int k = 0; k <= n; ++k)
          {
            const Point  x = {-1 + spacing * i, -1 + spacing * j, -1 + spacing * k};
            const double t = distance(surface, x, d);
            const auto   inner = pass_through_box(x, d, 1e-5, 1 - 1e-5), hull = pass_through_box(x, d, -1e-5, 1 + 1e-5);
            const auto   where = testing::Message()
                               << x[0] << ' ' << x[1] << ' ' << x[2] << " along " << lattice[0] << ' ' << lattice[1] << ' ' << lattice[2];
            if (inner)
            {
              const auto [in, out] = *pass_through_box(x, d, 0, 1);
              if (out > tolerance)
                EXPECT_NEAR(t, in, tolerance) << where;
              else
                EXPECT_TRUE(t == none || (out > -tolerance && std::abs(t - in) < tolerance)) << where << ": " << t;
            }
            else if (hull)
              EXPECT_TRUE(t == none || (t > hull->first - 1e-4 && t < (rough ? hull->second : hull->first) + 1e-4)) << where << ": " << t;
            else
              EXPECT_EQ(t, none) << where;
          }
    }
  }
} // namespace

// --- plane ---

TEST(PlaneSurface, IsAsFarAsTheFormulaSays)
{
  Random random(1);
  for (int i = 0; i < 200; ++i)
  {
    const Point  p = random.point(2), n = random.direction(), x = random.point(5), d = random.direction();
    const double length = random.number(0.1, 10);
    const auto   surface = make_rigid_surface(plane({p[0], p[1], p[2]}, {length * n[0], length * n[1], length * n[2]}));
    const double t = distance(surface, x, d);
    if (dot(d, n) > -1e-3)
    {
      EXPECT_TRUE(dot(d, n) < 0 || t == none);
      continue;
    }
    EXPECT_NEAR(dot(x + t * d - p, n), 0, 1e-12 * (1 + std::abs(t)));
    EXPECT_EQ(t > 0, dot(x - p, n) > 0);
  }
}

TEST(PlaneSurface, HasSignsInTheForm)
{
  const auto ground = make_rigid_surface(plane({0, -1}, {0, 2}));
  EXPECT_DOUBLE_EQ(distance(ground, {7, 2, 0}, {0, -1, 0}), 3);
  EXPECT_DOUBLE_EQ(distance(ground, {7, -1, 0}, {0, -1, 0}), 0);
  EXPECT_DOUBLE_EQ(distance(ground, {7, -1.25, 0}, {0, -1, 0}), -0.25);
  const double s = std::numbers::sqrt2 / 2;
  EXPECT_NEAR(distance(ground, {7, 2, 0}, {s, -s, 0}), 3 * std::numbers::sqrt2, 1e-14);
}

TEST(PlaneSurface, IsMissedAlongItAndAwayFromIt)
{
  const auto ground = make_rigid_surface(plane({0, 0, 0}, {0, 0, 1}));
  for (const Point &d : {Point{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.6, 0, 0.8}, {1, 0, -1e-13}})
    for (const double z : {-1., 0., 1.})
      EXPECT_EQ(distance(ground, {0.3, 0.4, z}, d), none);
  EXPECT_LT(distance(ground, {0, 0, 1}, {1, 0, -1e-11}), none);
}

TEST(PlaneSurface, TakesNormalsOfAnyLength)
{
  for (const double length : {1e-200, 1e-3, 1., 1e8, 1e200})
    EXPECT_NEAR(distance(make_rigid_surface(plane({0, 0}, {length, length})), {1, 1, 0}, {-1, 0, 0}), 2, 1e-14);
}

// --- sphere and circle ---

TEST(SphereSurface, IsEnteredAtItsSurface)
{
  Random random(2);
  int    n_hits = 0, n_misses = 0, n_inside = 0;
  for (int i = 0; i < 5000; ++i)
  {
    const Point  c = random.point(1), x = random.point(2), d = random.direction();
    const double radius = random.number(0.1, 2);
    const double t = distance(make_rigid_surface(sphere({c[0], c[1], c[2]}, radius)), x, d);
    const double across = norm(cross(x - c, d));
    if (dot(x - c, d) >= 0 || across > radius)
    {
      EXPECT_EQ(t, none);
      ++n_misses;
      continue;
    }
    ++n_hits;
    n_inside += t < 0;
    EXPECT_NEAR(norm(x + t * d - c), radius, 1e-12);
    EXPECT_LE(dot(x + t * d - c, d), 1e-12); // in, not out
    EXPECT_EQ(t < 0, norm(x - c) < radius);
  }
  EXPECT_GT(n_hits, 200);
  EXPECT_GT(n_misses, 200);
  EXPECT_GT(n_inside, 50);
}

TEST(SphereSurface, IsACircleInThePlane)
{
  const auto   circle = make_rigid_surface(sphere({0, -1}, 1));
  const double s = std::numbers::sqrt2 / 2;
  EXPECT_DOUBLE_EQ(distance(circle, {0, 2, 0}, {0, -1, 0}), 2);
  EXPECT_DOUBLE_EQ(distance(circle, {0, 0, 0}, {0, -1, 0}), 0);
  EXPECT_DOUBLE_EQ(distance(circle, {0, -0.5, 0}, {0, -1, 0}), -0.5);
  EXPECT_DOUBLE_EQ(distance(circle, {0.6, 1, 0}, {0, -1, 0}), 1.2);
  EXPECT_NEAR(distance(circle, {2, 1, 0}, {-s, -s, 0}), 2 * std::numbers::sqrt2 - 1, 1e-14);
  EXPECT_DOUBLE_EQ(distance(circle, {1, 3, 0}, {0, -1, 0}), 4); // touches
  EXPECT_EQ(distance(circle, {1.0000001, 3, 0}, {0, -1, 0}), none);
  EXPECT_EQ(distance(circle, {0, 2, 0}, {0, 1, 0}), none);
  EXPECT_EQ(distance(circle, {0, -1, 0}, {0, 1, 0}), none); // from the centre every way leads out
}

TEST(SphereSurface, HoldsABodyInside)
{
  const auto hollow = make_rigid_surface(sphere({1, 0, 0}, 2, true));
  EXPECT_DOUBLE_EQ(distance(hollow, {1, 0, 0}, {0, 0, 1}), 2);
  EXPECT_DOUBLE_EQ(distance(hollow, {2, 0, 0}, {1, 0, 0}), 1);
  EXPECT_DOUBLE_EQ(distance(hollow, {2, 0, 0}, {-1, 0, 0}), 3);
  EXPECT_DOUBLE_EQ(distance(hollow, {3, 0, 0}, {1, 0, 0}), 0);
  EXPECT_DOUBLE_EQ(distance(hollow, {3.5, 0, 0}, {1, 0, 0}), -0.5);
  EXPECT_EQ(distance(hollow, {1, 0, 2.5}, {1, 0, 0}), none);

  Random random(3);
  for (int i = 0; i < 1000; ++i)
  {
    const Point  x = random.point(3) + Point{1, 0, 0}, d = random.direction(), m = x - Point{1, 0, 0};
    const double t = distance(hollow, x, d);
    if (norm(cross(m, d)) > 2)
    {
      EXPECT_EQ(t, none);
      continue;
    }
    EXPECT_NEAR(norm(m + t * d), 2, 1e-12);
    EXPECT_GE(dot(m + t * d, d), -1e-12); // out, not in
    EXPECT_TRUE(norm(m) >= 2 || t > 0);
  }
}

// A gap of the size of round-off of the radius, far from the centre of coordinates of neither: the roots of the textbook formula would
// have no digit left.
TEST(SphereSurface, KeepsSmallGapsNextToLargeRadii)
{
  for (const double gap : {1e-6, 1e-9, -1e-6, -1e-9})
  {
    const double radius = 1048576; // representable with gap to 1e-10
    const Point  c = {0, -radius, 0};
    for (const double slope : {0., 0.5, 3.})
    {
      const Point       d = unit({slope, -1, 0});
      const double      t = distance(make_rigid_surface(sphere({c[0], c[1]}, radius)), {0, gap, 0}, d);
      const long double y = static_cast<long double>(gap) + radius, dx = d[0], dy = d[1], length = std::sqrt(dx * dx + dy * dy);
      const long double b = y * dy / length, product = (y - radius) * (y + radius), exact = product / (-b + std::sqrt(b * b - product));
      EXPECT_NEAR(t, static_cast<double>(exact), 4e-10 * (1 + slope)) << gap << ' ' << slope;
    }
  }
  const double tiny = std::ldexp(1., -50);
  EXPECT_DOUBLE_EQ(distance(make_rigid_surface(sphere({0, 0}, 1)), {1 + tiny, 0, 0}, {-1, 0, 0}), tiny);
  EXPECT_DOUBLE_EQ(distance(make_rigid_surface(sphere({0, 0}, 1, true)), {1 - tiny, 0, 0}, {1, 0, 0}), tiny);
}

// --- cylinder ---

TEST(CylinderSurface, IsTheCircleAlongItsAxis)
{
  Random     random(4);
  const auto circle = make_rigid_surface(sphere({1, 2}, 1.5)), hollow_circle = make_rigid_surface(sphere({1, 2}, 1.5, true));
  for (const double length : {1., -7.})
  {
    const auto tube = make_rigid_surface(cylinder({1, 2, 55}, {0, 0, length}, 1.5));
    const auto hollow = make_rigid_surface(cylinder({1, 2, 55}, {0, 0, length}, 1.5, true));
    for (int i = 0; i < 500; ++i)
    {
      const Point  x = random.point(4), d = random.direction(), flat_d = unit({d[0], d[1], 0});
      const double share = std::hypot(d[0], d[1]);
      for (const auto &[round, along] : {std::pair(circle, tube), std::pair(hollow_circle, hollow)})
      {
        const double t = distance(along, x, d), t_circle = distance(round, {x[0], x[1], 0}, flat_d);
        if (t_circle == none)
          EXPECT_EQ(t, none);
        else
          EXPECT_NEAR(t, t_circle / share, 1e-9 / share);
      }
    }
  }
}

TEST(CylinderSurface, IsEnteredAtItsSurface)
{
  Random random(5);
  for (int i = 0; i < 1000; ++i)
  {
    const Point  p = random.point(1), a = random.direction(), x = random.point(4), d = random.direction();
    const double t = distance(make_rigid_surface(cylinder({p[0], p[1], p[2]}, {2 * a[0], 2 * a[1], 2 * a[2]}, 0.8)), x, d);
    if (t != none && norm(cross(d, a)) > 1e-2)
    {
      EXPECT_NEAR(norm(cross(x + t * d - p, a)), 0.8, 1e-11);
      EXPECT_EQ(t < 0, norm(cross(x - p, a)) < 0.8);
    }
  }
}

TEST(CylinderSurface, IsMissedAlongItsAxis)
{
  for (const bool inside : {false, true})
  {
    const auto tube = make_rigid_surface(cylinder({0, 0, 0}, {1, 1, 0}, 1, inside));
    EXPECT_EQ(distance(tube, {0.1, 0.2, 0.3}, unit({1, 1, 0})), none);
    EXPECT_EQ(distance(tube, {0.1, 0.2, 0.3}, unit({-1, -1, 0})), none);
  }
}

TEST(RigidSurfaces, RefuseWhatCannotBe)
{
  const auto message = [](SurfaceDescription spec)
  {
    spec.where = {"case.toml", 3, 5};
    return message_of([&] { make_rigid_surface(spec); });
  };
  EXPECT_EQ(message(plane({0, 0}, {0, 0})), "case.toml:3:5: error: the normal of the plane is zero; give it a direction [out-of-range]");
  EXPECT_TRUE(contains(message(cylinder({0, 0, 0}, {0, 0, 0}, 1)), "axis"));
  EXPECT_TRUE(contains(message(cylinder({0, 0, 0}, {0, 0, 1}, 0)), "positive"));
  EXPECT_TRUE(contains(message(sphere({0, 0}, -1)), "the radius of the sphere must be positive, it is -1"));
  EXPECT_TRUE(contains(message(sphere({0, 0, 0, 0}, 1)), "3 coordinates at most"));
}

// --- surfaces of triangles ---

TEST(StlSurface, OfACubeThroughEdgesAndVertices)
{
  expect_cube(make_stl_surface(cube()), 1e-12, 0.25);
}

// A third is not a number of the machine: the lines miss the edges by rounding.
TEST(StlSurface, OfACubeNextToEdgesAndVertices)
{
  expect_cube(make_stl_surface(cube()), 1e-12, 1. / 3);
}

TEST(StlSurface, OfACubeAlongItsSides)
{
  // Down onto the rim of its top, all four edges and the corners alike, and a little beyond; not further away.
  const auto  surface = make_stl_surface(cube());
  const Point down = {0, 0, -1};
  for (const double a : {0., 0.25, 0.5, 1.})
    for (const Point &x : {Point{a, 0, 3}, Point{a, 1, 3}, Point{0, a, 3}, Point{1, a, 3}, Point{a, -1e-8, 3}, Point{1 + 1e-8, a, 3}})
      EXPECT_NEAR(distance(surface, x, down), 2, 1e-12) << x[0] << " " << x[1];
  for (const Point &x : {Point{-1e-4, 0.5, 3}, Point{1 + 1e-4, 0.5, 3}, Point{0.5, -1e-4, 3}, Point{0.5, 1 + 1e-4, 3}})
    EXPECT_EQ(distance(surface, x, down), none) << x[0] << " " << x[1];
}

TEST(StlSurface, OfATurnedCubeThroughEdgesAndVertices)
{
  const Point a = unit({1, 2, 3}), b = unit(cross(a, {0, 0, 1})), c = cross(a, b);
  const auto  turn = [&](const Point &p) { return p[0] * a + p[1] * b + p[2] * c; };
  auto        triangles = cube();
  for (StlTriangle &triangle : triangles)
    for (Point &vertex : triangle)
      vertex = turn(vertex);
  const auto surface = make_stl_surface(triangles);
  // To every vertex, and to points of all edges, diagonals of faces included.
  for (const StlTriangle &triangle : triangles)
    for (unsigned i = 0; i < 3; ++i)
      for (const double s : {0., 0.25, 0.5})
      {
        const Point edge = (1 - s) * triangle[i] + s * triangle[(i + 1) % 3], centre = turn({0.5, 0.5, 0.5});
        const Point outside = edge + 2 * (edge - centre), d = unit(centre - outside);
        EXPECT_NEAR(distance(surface, outside, d), norm(edge - outside), 1e-12);
        EXPECT_NEAR(distance(surface, centre, d), -norm(edge - centre), 1e-12);
        EXPECT_EQ(distance(surface, outside, -1 * d), none);
      }
}

TEST(StlSurface, OfABallIsNearlyASphere)
{
  const auto triangles = ball(4);
  const auto surface = make_stl_surface(triangles);
  Random     random(6);
  for (int i = 0; i < 3000; ++i)
  {
    const Point x = random.point(2), d = random.direction();
    if (const double across = norm(cross(x, d)); across > 0.9 && across < 1.001)
      continue;
    const auto   exact = make_rigid_surface(sphere({0, 0, 0}, 1))->distance(x, d);
    const double t = distance(surface, x, d);
    if (exact)
      EXPECT_NEAR(t, *exact, 0.02);
    else
      EXPECT_TRUE(t == none || norm(x) < 1);
  }
}

// A closed surface has no holes: not at its vertices, nor at its edges, from wherever one looks.
TEST(StlSurface, ClosedHasNoHoles)
{
  const auto triangles = ball(3);
  const auto surface = make_stl_surface(triangles);
  Random     random(7);
  for (const StlTriangle &triangle : triangles)
    for (const double s : {0., 0.5, random.number(0, 1)})
    {
      const Point target = (1 - s) * triangle[0] + s * triangle[1];
      const Point x = 3 * unit(target + random.point(0.3)), d = unit(target - x);
      EXPECT_NEAR(distance(surface, x, d), norm(target - x), 1e-12);
      const Point behind = x + 6 * d;
      EXPECT_EQ(distance(surface, behind, d), none);
      EXPECT_NEAR(distance(surface, 0.5 * target, -1 * unit(target)), -norm(0.5 * target), 1e-12); // penetration
    }
}

TEST(StlSurface, ByOrderOfTheVertices)
{
  // Turned inside out, a cube is a hollow in an obstacle that fills space.
  const auto hollow = make_stl_surface(turned_inside_out(cube()));
  EXPECT_DOUBLE_EQ(distance(hollow, {0.5, 0.25, 0.25}, {1, 0, 0}), 0.5);
  EXPECT_DOUBLE_EQ(distance(hollow, {0.5, 0.25, 0.25}, {0, -1, 0}), 0.25);
  EXPECT_DOUBLE_EQ(distance(hollow, {1.125, 0.25, 0.25}, {1, 0, 0}), -0.125);
  EXPECT_EQ(distance(hollow, {1.125, 2, 0.25}, {1, 0, 0}), none);
}

TEST(StlSurface, StandingOnIt)
{
  const auto surface = make_stl_surface(cube());
  EXPECT_NEAR(distance(surface, {0.3, 0.2, 1}, {0, 0, -1}), 0, 1e-14);
  EXPECT_EQ(distance(surface, {0.3, 0.2, 1}, {0, 0, 1}), none);  // moves away
  EXPECT_EQ(distance(surface, {0.3, 0.2, 0}, {0, 0, -1}), none); // has just left it
  EXPECT_NEAR(distance(surface, {0.3, 0.2, 1 - 1e-9}, {0, 0, -1}), -1e-9, 1e-14);
  EXPECT_NEAR(distance(surface, {0.3, 0.2, 1 + 1e-9}, {0, 0, -1}), 1e-9, 1e-14);
}

TEST(StlSurface, OpenReliefIsSunkThrough)
{
  const auto bumps = [](const double x, const double y) { return 0.25 * x + 0.125 * y; };
  const auto surface = make_stl_surface(relief(8, bumps));
  Random     random(8);
  for (int i = 0; i < 500; ++i)
  {
    const double x = random.number(0, 1), y = random.number(0, 1), z = random.number(-1, 1);
    EXPECT_NEAR(distance(surface, {x, y, z}, {0, 0, -1}), z - bumps(x, y), 1e-13);
    EXPECT_EQ(distance(surface, {x, y, z}, {0, 0, 1}), none);
    EXPECT_EQ(distance(surface, {x + 1.01, y, z}, {0, 0, -1}), none);
  }
}

// Points of a body whose rim lies above that of the relief, rounded to single precision or not.
TEST(StlSurface, OpenReliefReachesItsRim)
{
  for (const unsigned n : {1u, 2u, 7u})
  {
    const auto surface = make_stl_surface(relief(n, flat));
    for (const double off : {0., 1e-16, 1e-12, 1e-7, -1e-7})
      for (unsigned i = 0; i <= 14; ++i)
        for (const Point &rim : {Point{i / 14., -off, 0.5}, {i / 14., 1 + off, 0.5}, {-off, i / 14., 0.5}, {1 + off, i / 14., 0.5}})
        {
          EXPECT_NEAR(distance(surface, rim, {0, 0, -1}), 0.5, 1e-6) << rim[0] << ' ' << rim[1] << ' ' << n;
          EXPECT_NEAR(distance(surface, rim - Point{0, 0, 1}, {0, 0, -1}), -0.5, 1e-6);
        }
    for (const double off : {1e-7, -1e-7})
      for (const Point &corner : {Point{-off, -off, 1}, {1 + off, -off, 1}, {1 + off, 1 + off, 1}, {-off, 1 + off, 1}})
        EXPECT_NEAR(distance(surface, corner, {0, 0, -1}), 1, 1e-6);
    EXPECT_EQ(distance(surface, {-1e-4, 0.5, 1}, {0, 0, -1}), none);
  }
}

TEST(StlSurface, AlongItsTrianglesMissesThem)
{
  const auto surface = make_stl_surface(relief(4, flat));
  for (const Point &d : {Point{1, 0, 0}, {0, -1, 0}, unit({1, 1, 0}), unit({1, 3, 0})})
    for (const double z : {-0.5, 0., 0.5})
      EXPECT_EQ(distance(surface, {0.25, 0.5, z}, d), none);
}

TEST(StlSurface, HealsCracksOfRounding)
{
  // Every triangle rounds its vertices in its own way, so none shares an edge.
  Random random(9);
  auto   triangles = cube();
  for (StlTriangle &triangle : triangles)
    for (Point &vertex : triangle)
      vertex = vertex + random.point(1e-7);
  expect_cube(make_stl_surface(triangles), 1e-5, 0.25, true);
}

// Just outside an edge that its two facets do not share to the last digit.
TEST(StlSurface, IsMissedNextToACrackedEdge)
{
  Random random(13);
  auto   triangles = cube();
  for (StlTriangle &triangle : triangles)
    for (Point &vertex : triangle)
      vertex = vertex + random.point(1e-9);
  const auto   surface = make_stl_surface(triangles);
  const double s = std::numbers::sqrt2 / 2;
  for (const double off : {3e-7, 1e-6, 1e-3})
    for (const double y : {0.2, 0.5, 0.8})
      for (const double t : {-2., -0.1, 0.1, 2.})
        EXPECT_EQ(distance(surface, {1 + off - t * s, y, 1 + off + t * s}, {s, 0, -s}), none) << off << ' ' << y << ' ' << t;
}

// Lines that pass a vertex by less than rounding resolves: the side on which they pass an edge must be known exactly.
TEST(StlSurface, ClosedHasNoHolesWithinRoundOff)
{
  Random random(14);
  for (int surface_number = 0; surface_number < 20; ++surface_number)
  {
    // A fan of eight triangles about a vertex, closed by a point below.
    const Point              top = random.point(1), bottom = top - Point{0, 0, 3};
    std::vector<StlTriangle> triangles;
    std::vector<Point>       rim;
    for (int i = 0; i < 8; ++i)
    {
      const double angle = i * std::numbers::pi / 4 + random.number(0, 0.7);
      rim.push_back(top + Point{std::cos(angle), std::sin(angle), random.number(-1.5, -0.5)});
    }
    for (int i = 0; i < 8; ++i)
    {
      triangles.push_back({top, rim[i], rim[(i + 1) % 8]});
      triangles.push_back({bottom, rim[(i + 1) % 8], rim[i]});
    }
    const auto surface = make_stl_surface(triangles);
    for (int i = 0; i < 2000; ++i)
    {
      const Point target = top + random.point(std::ldexp(1., -52)), d = unit({random.number(-0.4, 0.4), random.number(-0.4, 0.4), -1});
      const Point x = target - 2 * d;
      EXPECT_NEAR(distance(surface, x, d), 2, 1e-14);
      EXPECT_NEAR(distance(surface, target + 0.25 * d, d), -0.25, 1e-14);
    }
  }
}

TEST(StlSurface, OfTwoBodiesThatTouch)
{
  const auto surface = make_stl_surface(together(cube(), moved(cube(), {0, 0, -1})));
  EXPECT_NEAR(distance(surface, {0.5, 0.25, 3}, {0, 0, -1}), 2, 1e-14);
  EXPECT_NEAR(distance(surface, {0.5, 0.25, 0.75}, {0, 0, -1}), -0.25, 1e-14);
  EXPECT_EQ(distance(surface, {0.5, 0.25, -1.5}, {0, 0, -1}), none);
}

TEST(StlSurface, OfTwoBodiesApart)
{
  const auto surface = make_stl_surface(together(cube(), moved(cube(), {0, 0, -3})));
  EXPECT_NEAR(distance(surface, {0.5, 0.5, -0.5}, {0, 0, -1}), 1.5, 1e-14); // between: the next one
  EXPECT_NEAR(distance(surface, {0.5, 0.5, -2.25}, {0, 0, -1}), -0.25, 1e-14);
}

TEST(StlSurface, OfASheetWithTwoSides)
{
  const auto sheet = relief(3, flat);
  const auto surface = make_stl_surface(together(sheet, turned_inside_out(sheet)));
  for (const double side : {-1., 1.})
  {
    EXPECT_NEAR(distance(surface, {0.4, 0.3, side}, {0, 0, -side}), 1, 1e-14);
    EXPECT_EQ(distance(surface, {0.4, 0.3, side}, {0, 0, side}), none);
  }
}

TEST(StlSurface, SkipsTrianglesWithoutArea)
{
  auto triangles = relief(2, flat);
  triangles.push_back({Point{0, 0, 0.5}, Point{0, 0, 0.5}, Point{1, 1, 0.5}});
  triangles.push_back({Point{0, 0.5, 0.5}, Point{0.5, 0.5, 0.5}, Point{1, 0.5, 0.5}});
  triangles.push_back({Point{1, 1, 1}, Point{1, 1, 1}, Point{1, 1, 1}});
  const auto surface = make_stl_surface(triangles);
  for (const Point &x : {Point{0.5, 0.5, 1}, {0.25, 0.25, 1}, {0.75, 0.5, 1}, {1, 1, 1}})
    EXPECT_NEAR(distance(surface, x, {0, 0, -1}), 1, 1e-14);
  EXPECT_EQ(make_stl_surface({triangles.end() - 3, triangles.end()}), nullptr);
}

// Degenerate triangles tie a long edge to two short ones: the surface stays closed.
TEST(StlSurface, StaysClosedAtHangingVertices)
{
  auto triangles = cube();
  // The edge from (0,0,1) to (1,0,1) is cut at its middle on one side only.
  std::vector<StlTriangle> finer;
  const Point              a = {0, 0, 1}, b = {1, 0, 1}, m = {0.5, 0, 1};
  for (const StlTriangle &t : triangles)
  {
    bool cut = false;
    for (unsigned i = 0; i < 3 && !cut; ++i)
      if (t[i] == a && t[(i + 1) % 3] == b)
      {
        finer.push_back({a, m, t[(i + 2) % 3]});
        finer.push_back({m, b, t[(i + 2) % 3]});
        cut = true;
      }
    if (!cut)
      finer.push_back(t);
  }
  EXPECT_EQ(finer.size(), 13u);
  expect_cube(make_stl_surface(finer), 1e-6, 0.25);
}

// The tree of boxes finds what trying every triangle finds.
TEST(StlSurface, OfAnySoupOfTriangles)
{
  Random                   random(10);
  std::vector<StlTriangle> soup;
  for (int i = 0; i < 400; ++i)
  {
    const Point p = random.point(1);
    soup.push_back({p, p + random.point(0.3), p + random.point(0.3)});
  }
  const auto surface = make_stl_surface(soup);
  int        n_found = 0;
  for (int i = 0; i < 2000; ++i)
  {
    const Point x = random.point(1.2), d = i % 10 == 0 ? Point{0, i % 20 == 0 ? 1. : -1., 0} : random.direction();
    double      enter_ahead = none, leave_ahead = none, enter_behind = -none, leave_behind = -none;
    for (const auto &[a, b, c] : soup)
    {
      const Point  n = cross(b - a, c - a);
      const double rate = dot(n, d);
      if (rate == 0)
        continue;
      const double t = dot(n, a - x) / rate;
      const Point  p = x + t * d;
      if (dot(cross(b - a, p - a), n) < 0 || dot(cross(c - b, p - b), n) < 0 || dot(cross(a - c, p - c), n) < 0)
        continue;
      double &nearest = t > 0 ? (rate < 0 ? enter_ahead : leave_ahead) : (rate < 0 ? enter_behind : leave_behind);
      nearest = t > 0 ? std::min(nearest, t) : std::max(nearest, t);
    }
    double expected = none;
    if (enter_ahead < leave_ahead)
      expected = enter_ahead;
    else if ((leave_ahead < none || enter_behind > leave_behind) && enter_behind > -none)
      expected = enter_behind;
    n_found += expected != none;
    const double t = distance(surface, x, d);
    if (expected == none)
      EXPECT_EQ(t, none);
    else
      EXPECT_NEAR(t, expected, 1e-10);
  }
  EXPECT_GT(n_found, 500);
}

TEST(StlSurface, FarFromTheOrigin)
{
  const Point shift = {1e6, -2e6, 3e6};
  const auto  surface = make_stl_surface(moved(cube(), shift));
  EXPECT_NEAR(distance(surface, shift + Point{0.5, 0.25, 2}, {0, 0, -1}), 1, 1e-9);
  EXPECT_NEAR(distance(surface, shift + Point{0.5, 0.25, 1}, {0, 0, -1}), 0, 1e-9);
  EXPECT_NEAR(distance(surface, shift + Point{0.5, 0.5, 0.75}, {0, 0, -1}), -0.25, 1e-9);
  EXPECT_NEAR(distance(surface, shift + Point{0.5, 0.5, 1000}, {0, 0, -1}), 999, 1e-9);
}

TEST(StlSurface, OfASingleTriangle)
{
  const auto surface = make_stl_surface({{Point{0, 0, 0}, Point{1, 0, 0}, Point{0, 1, 0}}});
  EXPECT_DOUBLE_EQ(distance(surface, {0.25, 0.25, 2}, {0, 0, -1}), 2);
  EXPECT_EQ(distance(surface, {0.75, 0.75, 2}, {0, 0, -1}), none);
}

// --- STL files ---

TEST_F(Files, BothFormatsAreTheSameSurface)
{
  const auto from_text = make_rigid_surface(stl(write("text.stl", text_stl(cube()))));
  const auto from_bytes = make_rigid_surface(stl(write("binary.stl", binary_stl(cube()))));
  // The header may say what it likes.
  const auto misleading = make_rigid_surface(stl(write("misleading.stl", binary_stl(cube(), "solid but binary\nfacet normal"))));
  expect_cube(from_text, 1e-12, 0.5);
  expect_cube(from_bytes, 1e-12, 0.5);
  expect_cube(misleading, 1e-12, 0.5);
}

TEST_F(Files, BallsAgreeToSinglePrecision)
{
  const auto from_text = make_rigid_surface(stl(write("text.stl", text_stl(ball(3)))));
  const auto from_bytes = make_rigid_surface(stl(write("binary.stl", binary_stl(ball(3)))));
  Random     random(11);
  for (int i = 0; i < 500; ++i)
  {
    const Point x = 2 * random.direction(), d = unit(random.point(0.5) - x);
    EXPECT_NEAR(distance(from_text, x, d), distance(from_bytes, x, d), 1e-6);
  }
}

TEST_F(Files, TextInAnySpacing)
{
  const std::string triangle = text_stl(relief(1, flat));
  std::string       dos, mac, shouting;
  for (const char c : triangle)
  {
    dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
    mac += c == '\n' ? '\r' : c;
    shouting += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  for (const std::string &text : {triangle, dos, mac, shouting, "\xef\xbb\xbf" + triangle, "\n  " + triangle, triangle + triangle,
                                  triangle.substr(0, triangle.rfind("the name"))})
    EXPECT_EQ(read_stl(write("spacing.stl", text)).size() % 2, 0u);
  const auto signs =
    read_stl(write("signs.stl", "solid\nfacet normal nan nan nan\nouter loop\nvertex +1 -2.5e-1 .5\nvertex 1E2 0 1e-400\nvertex 0 0 0\n"
                                "endloop\nendfacet\nendsolid"));
  EXPECT_EQ(signs[0][0], (Point{1, -0.25, 0.5}));
  EXPECT_EQ(signs[0][1], (Point{100, 0, 0}));
}

TEST_F(Files, ScaleComesBeforeShift)
{
  for (const std::string &bytes : {text_stl(cube()), binary_stl(cube())})
  {
    SurfaceDescription spec = stl(write("cube.stl", bytes));
    spec.scale = 0.5;
    spec.shift = {10, 20, 30};
    const auto surface = make_rigid_surface(spec);
    EXPECT_NEAR(distance(surface, {10.25, 20.25, 32}, {0, 0, -1}), 1.5, 1e-13);
    EXPECT_NEAR(distance(surface, {10.25, 20.25, 30.25}, {1, 0, 0}), -0.25, 1e-13);
    EXPECT_EQ(distance(surface, {10.75, 20.25, 32}, {0, 0, -1}), none);
  }
}

TEST_F(Files, ScaleMustMakeSense)
{
  SurfaceDescription spec = stl(write("cube.stl", text_stl(cube())));
  for (const double scale : {0., -1.})
  {
    spec.scale = scale;
    EXPECT_TRUE(contains(message_of([&] { make_rigid_surface(spec); }), "the scale must be positive"));
  }
  spec.scale = 1e300;
  EXPECT_TRUE(contains(message_of([&] { make_rigid_surface(spec); }), "out of bounds"));
  spec.scale = 1e-300;
  EXPECT_TRUE(contains(message_of([&] { make_rigid_surface(spec); }), "no triangle with an area"));
}

TEST_F(Files, MissingOrNoFiles)
{
  EXPECT_EQ(message_of([&] { make_rigid_surface(stl("/nowhere/tool.stl")); }),
            "case.toml:7:9: error: STL file '/nowhere/tool.stl' does not exist [file-not-found]");
  EXPECT_TRUE(contains(message_of([&] { make_rigid_surface(stl(folder.string())); }), "is not a file"));
  EXPECT_TRUE(contains(message_for(""), "is empty"));
}

TEST_F(Files, TextThatIsWrongIsNamedWithItsLine)
{
  const std::string head = "solid x\nfacet normal 0 0 1\nouter loop\n", tail = "endloop\nendfacet\nendsolid x\n";
  EXPECT_TRUE(contains(message_for("solid x\nendsolid x\n"), "'wrong.stl' has no triangles"));
  EXPECT_TRUE(contains(message_for(head + "vertex 0 0 zero\nvertex 1 0 0\nvertex 0 1 0\n" + tail),
                       "case.toml:7:9: error: STL file 'wrong.stl' line 4: a coordinate, a finite number, expected, found 'zero'"));
  EXPECT_TRUE(contains(message_for(head + "vertex 0 0 nan\nvertex 1 0 0\nvertex 0 1 0\n" + tail), "line 4: a coordinate"));
  EXPECT_TRUE(contains(message_for(head + "vertex 0 0 1e999\nvertex 1 0 0\nvertex 0 1 0\n" + tail), "line 4: a coordinate"));
  EXPECT_TRUE(contains(message_for(head + "vertex 0 0 0\nvertex 1 0\nvertex 0 1 0\n" + tail), "line 6: a coordinate"));
  EXPECT_TRUE(
    contains(message_for(head + "vertex 0 0 0\nvertex 1 0 0\n" + tail), "line 6: 'vertex', of which a facet has three, expected"));
  EXPECT_TRUE(contains(message_for(head + "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 1 1 1\n" + tail), "line 7: 'endloop' after"));
  EXPECT_TRUE(contains(message_for(head + "vertex 0 0 0\nvertex 1 0 0\n"), "cut short: it ends at line 6"));
  EXPECT_TRUE(contains(message_for("solid x\nfacet up 0 0 1\n"), "line 2: 'normal' expected, found 'up'"));
  EXPECT_TRUE(contains(message_for("solid x\nfaces\n"), "line 2: 'facet' or 'endsolid' expected"));
  EXPECT_TRUE(contains(message_for("solid x\n" + std::string(500, '\x01')), "'????????????????????????...'"));
  EXPECT_TRUE(contains(message_for(head + "vertex 0 0 0\nvertex 1 1 1\nvertex 2 2 2\n" + tail), "no triangle with an area"));
}

TEST_F(Files, BinaryThatIsWrongIsNamed)
{
  const std::string good = binary_stl(cube());
  EXPECT_TRUE(contains(message_for(good.substr(0, 600)), "of the 12 triangles that it announces has 684 bytes, this 600"));
  EXPECT_TRUE(contains(message_for(good + "x"), "has 684 bytes, this 685"));
  EXPECT_TRUE(contains(message_for("v 0 0 0\nf 1 2 3\n"), "is damaged or not STL"));
  EXPECT_TRUE(contains(message_for(binary_stl({})), "has no triangles"));
  auto broken = cube();
  broken[4][1][2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(contains(message_for(binary_stl(broken)), "triangle 5 of 12 has a vertex that is not finite"));
  EXPECT_TRUE(contains(message_for(binary_stl({{Point{0, 0, 0}, Point{1, 1, 1}, Point{2, 2, 2}}})), "no triangle with an area"));
}

// Whatever is done to a file, it is read or refused.
TEST_F(Files, GarbageIsRefused)
{
  std::mt19937      random(12);
  const std::string text = text_stl(relief(1, flat)), binary = binary_stl(relief(1, flat));
  for (std::size_t length = 0; length < text.size() - 25; ++length)
    EXPECT_NE(message_for(text.substr(0, length)), "") << length;
  for (std::size_t length = 0; length < binary.size(); ++length)
    EXPECT_NE(message_for(binary.substr(0, length)), "") << length;
  for (int i = 0; i < 1000; ++i)
  {
    std::string damaged = i % 2 ? text : binary;
    for (unsigned n = 1 + random() % 4; n > 0; --n)
      damaged[random() % damaged.size()] = static_cast<char>(random());
    try
    {
      const auto surface = make_rigid_surface(stl(write("damaged.stl", damaged)));
      surface->distance({0.3, 0.4, 5}, {0, 0, -1});
    }
    catch (const InputError &)
    {
    }
  }
  for (int i = 0; i < 300; ++i)
  {
    std::string noise(random() % 400, ' ');
    for (char &c : noise)
      c = static_cast<char>(random());
    EXPECT_NE(message_for(noise), "");
    EXPECT_NE(message_for("solid " + noise), "");
  }
}
