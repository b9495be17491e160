#include "unilateral/report/scene.h"

#include "unilateral/base/diagnostics.h"
#include "unilateral/output/vtu_file.h"
#include "unilateral/output/vtu_reader.h"
#include "unilateral/report/feature_edges.h"
#include "unilateral/report/image.h"
#include "unilateral/report/picture.h"
#include "unilateral/report/section.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace
{
  using namespace unilateral;

  /// n x n quadrilaterals on [0, 2] x [0, 1]; u = x + 2 y, pressure = max(0, x - 1).
  VtuGrid plane_grid(const int n)
  {
    VtuGrid             grid;
    std::vector<double> u, pressure;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
      {
        const double x = 2. * i / n, y = double(j) / n;
        grid.points.push_back({x, y, 0});
        u.push_back(x + 2 * y);
        pressure.push_back(std::max(0., x - 1));
      }
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
      {
        const int a = j * (n + 1) + i;
        grid.connectivity.insert(grid.connectivity.end(), {a, a + 1, a + n + 2, a + n + 1});
        grid.offsets.push_back(std::int32_t(grid.connectivity.size()));
        grid.cell_types.push_back(9);
      }
    grid.point_arrays = {{"u", u}, {"contact_pressure", pressure}};
    return grid;
  }

  /// n^3 hexahedra on the unit cube.
  VtuGrid cube_grid(const int n)
  {
    VtuGrid    grid;
    const auto at = [n](const int i, const int j, const int k) { return (k * (n + 1) + j) * (n + 1) + i; };
    for (int k = 0; k <= n; ++k)
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
          grid.points.push_back({double(i) / n, double(j) / n, double(k) / n});
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
        {
          grid.connectivity.insert(grid.connectivity.end(),
                                   {at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k), at(i, j, k + 1),
                                    at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)});
          grid.offsets.push_back(std::int32_t(grid.connectivity.size()));
          grid.cell_types.push_back(12);
        }
    grid.point_arrays = {{"u", std::vector<double>(3 * grid.points.size(), 0.5), 3}};
    return grid;
  }

  ResultsFolder folder_with(VtuGrid grid)
  {
    ResultsFolder folder;
    folder.solution = std::move(grid);
    return folder;
  }

  double area_of(const Scene &scene)
  {
    double area = 0;
    for (const auto &t : scene.triangles)
    {
      double a[3], b[3];
      for (unsigned d = 0; d < 3; ++d)
      {
        a[d] = scene.points[t[1]][d] - scene.points[t[0]][d];
        b[d] = scene.points[t[2]][d] - scene.points[t[0]][d];
      }
      area += std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]) / 2;
    }
    return area;
  }

  /// The bytes of a VTU in a file of its own.
  struct VtuInFile
  {
    explicit VtuInFile(const std::string &bytes) : path((std::filesystem::temp_directory_path() / "test_scene.vtu").string())
    {
      std::ofstream(path, std::ios::binary) << bytes;
    }
    ~VtuInFile() { std::filesystem::remove(path); }
    std::string path;
  };

  TEST(VtuReader, ReadsWhatWasWritten)
  {
    const VtuGrid   grid = plane_grid(3);
    const VtuInFile file(to_vtu(grid));
    const VtuGrid   read = read_vtu(file.path);
    EXPECT_EQ(read.points, grid.points);
    EXPECT_EQ(read.connectivity, grid.connectivity);
    EXPECT_EQ(read.offsets, grid.offsets);
    EXPECT_EQ(read.cell_types, grid.cell_types);
    ASSERT_EQ(read.point_arrays.size(), 2);
    EXPECT_EQ(read.point_arrays[1].name, "contact_pressure");
    EXPECT_EQ(read.point_arrays[1].values, grid.point_arrays[1].values);
  }

  TEST(VtuReader, RefusesWhatIsCutOrChanged)
  {
    const std::string bytes = to_vtu(plane_grid(2));
    for (std::size_t length = 0; length + 60 < bytes.size(); length += 7)
    {
      const VtuInFile file(bytes.substr(0, length));
      EXPECT_THROW(read_vtu(file.path), InputError) << length;
    }
    for (std::size_t at = 0; at < bytes.size(); at += 3)
    {
      std::string changed = bytes;
      changed[at] = char(changed[at] ^ 0x55);
      const VtuInFile file(changed);
      try
      {
        const VtuGrid grid = read_vtu(file.path);
        for (const auto p : grid.connectivity)
          EXPECT_TRUE(p >= 0 && std::size_t(p) < grid.points.size());
      }
      catch (const InputError &)
      {
      }
    }
  }

  TEST(VtuReader, RefusesArraysOfCellsWhereThereAreNone)
  {
    VtuGrid grid = plane_grid(2);
    grid.cell_arrays.push_back({.name = "region", .values = std::vector<std::int32_t>(grid.cell_types.size(), 0)});
    const VtuInFile whole(to_vtu(grid));
    EXPECT_NO_THROW(read_vtu(whole.path));
    grid.connectivity.clear();
    grid.offsets.clear();
    grid.cell_types.clear();
    const VtuInFile without_cells(to_vtu(grid));
    EXPECT_THROW(read_vtu(without_cells.path), InputError);
  }

  TEST(Scene, HasTheCellsOfAPlaneMesh)
  {
    const Scene scene = make_scene(folder_with(plane_grid(4)));
    EXPECT_EQ(scene.dimension, 2);
    EXPECT_FALSE(scene.vector);
    EXPECT_EQ(scene.triangles.size(), 2 * 16);
    EXPECT_EQ(scene.lines.size(), 2 * 4 * 5);
    EXPECT_NEAR(area_of(scene), 2, 1e-6);
    EXPECT_EQ(scene.find("u")->max, 4);
  }

  TEST(Scene, HasTheSurfaceOfASolidMesh)
  {
    const Scene scene = make_scene(folder_with(cube_grid(3)));
    EXPECT_EQ(scene.dimension, 3);
    EXPECT_TRUE(scene.vector);
    EXPECT_EQ(scene.triangles.size(), 6 * 9 * 2);
    EXPECT_EQ(scene.points.size(), 4 * 4 * 4 - 2 * 2 * 2);
    EXPECT_NEAR(area_of(scene), 6, 1e-6);
  }

  /// @p grid twice, the second time to the right of the first, with points of its own where the two meet, in the same place but for
  /// rounding.
  VtuGrid two_pieces(VtuGrid grid, const double width)
  {
    const std::size_t n = grid.points.size(), n_corners = grid.connectivity.size(), n_cells = grid.offsets.size();
    for (std::size_t i = 0; i < n; ++i)
      grid.points.push_back({grid.points[i][0] + width * (1 + 1e-15), grid.points[i][1], grid.points[i][2]});
    for (std::size_t k = 0; k < n_corners; ++k)
      grid.connectivity.push_back(grid.connectivity[k] + std::int32_t(n));
    for (std::size_t c = 0; c < n_cells; ++c)
    {
      grid.offsets.push_back(grid.offsets[c] + std::int32_t(n_corners));
      grid.cell_types.push_back(grid.cell_types[c]);
    }
    return grid;
  }

  TEST(Scene, OfSeveralPiecesHasNoSurfaceBetweenThem)
  {
    VtuGrid grid = two_pieces(cube_grid(3), 1);
    grid.point_arrays = {{"u", std::vector<double>(3 * grid.points.size(), 0.5), 3}};
    const Scene scene = make_scene(folder_with(grid));
    EXPECT_EQ(scene.triangles.size(), 2 * 5 * 9 * 2);
    EXPECT_NEAR(area_of(scene), 10, 1e-6);
    EXPECT_EQ(feature_edges(scene.points, scene.triangles).size(), 3 * (8 + 4 * 2)) << "none where the pieces meet";
  }

  TEST(Scene, KeepsPointsApartWhereAFunctionJumps)
  {
    VtuGrid             grid = two_pieces(plane_grid(4), 2);
    const std::size_t   n = grid.points.size() / 2;
    std::vector<double> smooth, jumps;
    for (std::size_t i = 0; i < 2 * n; ++i)
    {
      smooth.push_back(grid.points[i][0]);
      jumps.push_back(i < n ? 1 : 2);
    }
    grid.point_arrays = {{"u", smooth}};
    EXPECT_EQ(make_scene(folder_with(grid)).points.size(), 9 * 5);
    grid.point_arrays = {{"u", smooth}, {"stress", jumps}};
    EXPECT_EQ(make_scene(folder_with(grid)).points.size(), 2 * 5 * 5);
  }

  TEST(Scene, OfManyTrianglesKeepsFewAndItsOutline)
  {
    const Scene plane = make_scene(folder_with(plane_grid(100)), {.triangles = 2000, .lines = 0, .cloud = 0});
    EXPECT_LE(plane.triangles.size(), 2000);
    EXPECT_GE(plane.triangles.size(), 500);
    EXPECT_EQ(plane.n_triangles_in_all, 20000);
    EXPECT_NEAR(area_of(plane), 2, 0.02);
    for (std::size_t i = 0; i < plane.points.size(); ++i) // values are those of points of the mesh
      EXPECT_NEAR(plane.find("u")->values[i], plane.points[i][0] + 2 * plane.points[i][1], 1e-5);
    const Scene cube = make_scene(folder_with(cube_grid(30)), {.triangles = 2000, .lines = 0, .cloud = 0});
    EXPECT_LE(cube.triangles.size(), 2000);
    EXPECT_NEAR(area_of(cube), 6, 0.1);
  }

  TEST(FeatureEdges, OfACubeAreItsEdges)
  {
    // Each face of the cube as two triangles, the last one turned the other way round.
    std::vector<std::array<float, 3>> points;
    for (unsigned k = 0; k < 8; ++k)
      points.push_back({float(k & 1), float((k >> 1) & 1), float(k >> 2)});
    const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                                                 {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {7, 1, 5}};
    EXPECT_EQ(feature_edges(points, triangles).size(), 12u);
    EXPECT_EQ(feature_edges(points, {{0, 1, 3}, {0, 3, 2}}).size(), 4u) << "of a square its rim";
  }

  TEST(Section, IsExactForLinearFunctions)
  {
    const Scene   scene = make_scene(folder_with(plane_grid(7)));
    const Section section = section_along(scene, {0, 0.1}, {2, 0.9});
    ASSERT_GT(section.s.size(), 8);
    const double length = std::hypot(2., 0.8);
    for (std::size_t k = 0; k < section.s.size(); ++k)
    {
      const double t = section.s[k] / length;
      EXPECT_EQ(section.values[0].first, "u");
      EXPECT_NEAR(section.values[0].second[k], 2 * t + 2 * (0.1 + 0.8 * t), 1e-5);
    }
  }

  TEST(Section, GoesThroughTheLargestPressure)
  {
    const Scene scene = make_scene(folder_with(plane_grid(8)));
    const auto [a, b] = default_section_line(scene);
    EXPECT_EQ(a[0], 0);
    EXPECT_EQ(b[0], 2);
    EXPECT_EQ(a[1], b[1]);
  }

  TEST(Picture, IsDrawnAndNamesItsFields)
  {
    const Scene scene = make_scene(folder_with(plane_grid(8)));
    const auto  svg = picture_svg(scene, "a <b> title");
    EXPECT_NE(svg.find("contact_pressure"), std::string::npos);
    EXPECT_NE(svg.find("data:image/png;base64,"), std::string::npos);
    EXPECT_NE(svg.find("a &lt;b&gt; title"), std::string::npos);
    EXPECT_NE(picture_svg(scene, "", {.field = "u"}).find(">u<"), std::string::npos);
    EXPECT_THROW(picture_svg(scene, "", {.field = "nothing"}), InputError);
    EXPECT_EQ(picture_svg(Scene(), ""), "");
  }

  TEST(Picture, ShowsSmallDisplacementsLargerByARoundFactor)
  {
    Scene scene = make_scene(folder_with(cube_grid(2)));
    EXPECT_EQ(deformation_factor(scene), 1);
    for (auto &field : scene.fields)
      for (float &value : field.values)
        value = 1e-4F;
    scene.fields[0].max = 1e-4F;
    EXPECT_EQ(deformation_factor(scene), 500);
  }

  /// A triangle with z up, and the same one turned so that y is, or x.
  TEST(Picture, is_the_same_whichever_axis_is_up)
  {
    const Image::Points upright = {{0, 0, 0}, {1, 0.2F, 0.1F}, {0.3F, 0.7F, 2}};
    Image::Points       with_y_up, with_x_up;
    for (const auto &x : upright)
    {
      with_y_up.push_back({x[0], x[2], -x[1]});
      with_x_up.push_back({x[2], x[0], x[1]});
    }
    const auto picture = [](const Image::Points &points, const unsigned upward_axis)
    {
      Image image(60, 40, Image::View::oblique, upward_axis);
      image.fit(points);
      image.draw(points, {{0, 1, 2}}, {0, 1, 2}, 0, 2, false);
      return image.png();
    };
    EXPECT_TRUE(picture(with_y_up, 1) == picture(upright, 2));
    EXPECT_TRUE(picture(with_x_up, 0) == picture(upright, 2));
    EXPECT_FALSE(picture(with_y_up, 2) == picture(upright, 2));
  }

  TEST(Scene, knows_the_axis_that_is_up)
  {
    ResultsFolder folder = folder_with(cube_grid(1));
    EXPECT_EQ(make_scene(folder).upward_axis, 2u);
    folder.results.emplace()["mesh"]["up"] = "y";
    EXPECT_EQ(make_scene(folder).upward_axis, 1u);
    folder.solution = plane_grid(1);
    EXPECT_EQ(make_scene(folder).upward_axis, 2u);
  }
} // namespace
