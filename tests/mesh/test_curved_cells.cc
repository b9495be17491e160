// Cells of order 2: where their points lie, before and after refinement, and from files.
#include "unilateral/mesh/curved_cells.h"

#include "unilateral/mesh/make_mesh.h"

#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q_cache.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include "unilateral/spaces/curved_simplex_mapping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include <unistd.h>

using namespace unilateral;
using dealii::Point;
using dealii::Triangulation;

namespace
{
  /// A file that goes with this object.
  class TextFile
  {
  public:
    TextFile(const std::string &ending, const std::string &text)
      : path((std::filesystem::temp_directory_path() / ("curved" + std::to_string(getpid()) + ending)).string())
    {
      std::ofstream(path) << text;
    }
    ~TextFile() { std::filesystem::remove(path); }

    MeshDescription mesh() const
    {
      MeshDescription description;
      description.source = MeshDescription::Source::file;
      description.file = path;
      return description;
    }

    const std::string path;
  };

  const std::string header = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";

  /// One cell of the ring 1 < r < 2, from 0 to @p angle, in Gmsh's order: corners, then middles of lines (then of the cell).
  std::string ring_cell(const double angle, const int type, const bool with_centre)
  {
    const double polar[9][2] = {{1, 0}, {2, 0}, {2, 1}, {1, 1}, {1.5, 0}, {2, 0.5}, {1.5, 1}, {1, 0.5}, {1.5, 0.5}};
    const int    n = with_centre ? 9 : 8;
    std::string  text = header + "$Nodes\n" + std::to_string(n) + "\n", numbers;
    for (int i = 0; i < n; ++i)
    {
      const double r = polar[i][0], phi = polar[i][1] * angle;
      text += std::to_string(i + 1) + " " + std::to_string(r * std::cos(phi)) + " " + std::to_string(r * std::sin(phi)) + " 0\n";
      numbers += " " + std::to_string(i + 1);
    }
    return text + "$EndNodes\n$Elements\n1\n1 " + std::to_string(type) + " 2 1 1" + numbers + "\n$EndElements\n";
  }

  template <int dim>
  double volume(const dealii::Mapping<dim> &mapping, const Triangulation<dim> &triangulation)
  {
    const auto                    cell_type = triangulation.begin_active()->reference_cell();
    const dealii::FE_Nothing<dim> nothing(cell_type);
    dealii::FEValues<dim>         values(mapping, nothing, cell_type.template get_gauss_type_quadrature<dim>(4), dealii::update_JxW_values);
    double                        sum = 0;
    for (const auto &cell : triangulation.active_cell_iterators())
    {
      values.reinit(cell);
      for (const double w : values.get_JxW_values())
        sum += w;
    }
    return sum;
  }

  template <int dim>
  double volume_of_hypercubes(const Mesh<dim> &mesh)
  {
    dealii::MappingQCache<dim> mapping(2);
    mapping.initialize(*mesh.triangulation, [&](const auto &cell) { return mesh.curved_cells->nodes(cell); });
    return volume(mapping, *mesh.triangulation);
  }
} // namespace

TEST(CurvedCells, quadrilaterals_of_both_families_are_read)
{
  const double angle = 0.5, area = 1.5 * angle;
  for (const auto &[type, with_centre] : {std::pair(10, true), std::pair(16, false)})
  {
    const TextFile file(".msh", ring_cell(angle, type, with_centre));
    auto           mesh = make_mesh<2>(file.mesh(), false);
    ASSERT_TRUE(mesh.curved_cells);
    EXPECT_TRUE(mesh.curved);
    EXPECT_NEAR(volume_of_hypercubes(mesh), area, 2e-4 * area) << type;
  }
}

TEST(CurvedCells, refinement_keeps_the_geometry)
{
  const TextFile file(".msh", ring_cell(0.8, 10, true));
  auto           mesh = make_mesh<2>(file.mesh(), false);
  const double   coarse = volume_of_hypercubes(mesh);
  mesh.triangulation->refine_global(1);
  mesh.triangulation->begin_active()->set_refine_flag(); // hanging nodes as well
  mesh.triangulation->execute_coarsening_and_refinement();
  mesh.curved_cells->follow_refinement(*mesh.triangulation);
  EXPECT_NEAR(volume_of_hypercubes(mesh), coarse, 1e-13);
  for (const auto &cell : mesh.triangulation->active_cell_iterators())
    for (const unsigned v : cell->vertex_indices())
      EXPECT_LT(cell->vertex(v).distance(mesh.curved_cells->nodes(cell)[v]), 1e-14);
}

TEST(CurvedCells, refined_simplices_keep_the_geometry_and_are_located)
{
  Triangulation<3> triangulation;
  dealii::GridGenerator::subdivided_hyper_cube_with_simplices(triangulation, 1);
  PointsByVertices<3> points;
  const auto          bent = [](const Point<3> &x) { return Point<3>(x[0] + 0.1 * x[1] * x[1], x[1], x[2] - 0.2 * x[0] * x[1]); };
  for (const auto &cell : triangulation.active_cell_iterators())
    for (const auto l : cell->line_indices())
    {
      const unsigned a = cell->line(l)->vertex_index(0), b = cell->line(l)->vertex_index(1);
      points[{std::min(a, b), std::max(a, b)}] = bent((cell->line(l)->vertex(0) + cell->line(l)->vertex(1)) / 2);
    }
  dealii::GridTools::transform(bent, triangulation);
  CurvedCells<3> curved(triangulation, points);
  EXPECT_FALSE(curved.straight());
  EXPECT_TRUE(curved.folded_cells(triangulation).empty());
  EXPECT_NEAR(volume(CurvedSimplexMapping<3>(curved), triangulation), 1, 1e-13); // the map keeps volumes

  auto refined = refine_simplices(triangulation);
  curved.follow_refinement(*refined.triangulation, refined.children);
  const CurvedSimplexMapping<3> mapping(curved);
  EXPECT_NEAR(volume(mapping, *refined.triangulation), 1, 1e-13);
  const Point<3> unit(0.2, 0.3, 0.1);
  for (const auto &cell : refined.triangulation->active_cell_iterators())
    EXPECT_LT(curved.unit_point(cell, mapping.transform_unit_to_real_cell(cell, unit)).distance(unit), 1e-11);
}

TEST(CurvedCells, points_are_located_far_from_the_origin)
{
  Triangulation<2> triangulation;
  dealii::GridGenerator::subdivided_hyper_cube_with_simplices(triangulation, 1);
  const dealii::Tensor<1, 2> offset = Point<2>(5e5, 5e6) - Point<2>();
  dealii::GridTools::shift(offset, triangulation);
  PointsByVertices<2> points;
  for (const auto &cell : triangulation.active_cell_iterators())
    for (const auto l : cell->line_indices())
    {
      const unsigned a = cell->line(l)->vertex_index(0), b = cell->line(l)->vertex_index(1);
      points[{std::min(a, b), std::max(a, b)}] = (cell->line(l)->vertex(0) + cell->line(l)->vertex(1)) / 2 + Point<2>(0.1, 0);
    }
  const CurvedCells<2> curved(triangulation, points);
  EXPECT_FALSE(curved.straight());
  const Point<2> unit(0.3, 0.2);
  for (const auto &cell : triangulation.active_cell_iterators())
    EXPECT_LT(curved.unit_point(cell, CurvedSimplexMapping<2>(curved).transform_unit_to_real_cell(cell, unit)).distance(unit), 1e-8);
}

TEST(CurvedCells, cells_that_are_folded_are_straightened_and_named)
{
  // A triangle of order 2 with the middle of a line far outside, beyond the opposite corner.
  const TextFile file(".msh", header + "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0.5 0.9 0\n5 0.5 0.5 0\n6 0 0.5 0\n$EndNodes\n"
                                       "$Elements\n1\n1 9 2 1 1 1 2 3 4 5 6\n$EndElements\n");
  const auto     mesh = make_mesh<2>(file.mesh(), true);
  EXPECT_FALSE(mesh.curved_cells);
  ASSERT_EQ(mesh.warnings.size(), 1u);
  EXPECT_NE(mesh.warnings[0].find("a curved cell is folded over itself near (0.333333, 0.333333)"), std::string::npos) << mesh.warnings[0];
}

TEST(CurvedCells, what_is_straight_is_no_curved_mesh)
{
  const TextFile file(".msh", header + "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0.5 0 0\n5 0.5 0.5 0\n6 0 0.5 0\n$EndNodes\n"
                                       "$Elements\n1\n1 9 2 1 1 1 2 3 4 5 6\n$EndElements\n");
  EXPECT_FALSE(make_mesh<2>(file.mesh(), true).curved_cells);
}

TEST(CurvedCells, drawings_are_meshed_to_their_curves)
{
  const TextFile file(".geo", "SetFactory(\"OpenCASCADE\"); Disk(1) = {0, 0, 0, 1}; Mesh.MeshSizeMax = 0.4; Mesh.MeshSizeMin = 0.4;");
  const double   pi = dealii::numbers::PI;
  for (const bool simplex : {true, false})
  {
    EXPECT_FALSE(make_mesh<2>(file.mesh(), simplex, 1).curved_cells);
    const auto mesh = make_mesh<2>(file.mesh(), simplex, 2);
    ASSERT_TRUE(mesh.curved_cells);
    const double area = simplex ? volume<2>(CurvedSimplexMapping<2>(*mesh.curved_cells), *mesh.triangulation) : volume_of_hypercubes(mesh);
    EXPECT_NEAR(area, pi, 1e-4 * pi); // a polygon with as many corners lacks some per cent
  }
}

namespace
{
  const std::string ring = R"(Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {2, 0, 0}; Point(4) = {0, 1, 0}; Point(5) = {0, 2, 0};
Circle(1) = {2, 1, 4}; Circle(2) = {3, 1, 5}; Line(3) = {2, 3}; Line(4) = {4, 5}; Curve Loop(1) = {3, 2, -4, -1}; Plane Surface(1) = {1};
Transfinite Curve {1, 2} = 7; Transfinite Curve {3, 4} = 3; Transfinite Surface {1};
)",
                    cylinder =
                      "SetFactory(\"OpenCASCADE\"); Cylinder(1) = {0, 0, 0, 0, 0, 1, 1}; Mesh.MeshSizeMax = 0.8; Mesh.MeshSizeMin = 0.8;";

  /// How much the volume of a drawing's tetrahedra or triangles of @p order lacks after @p times refinements.
  template <int dim>
  double missing_volume_of_simplices(const std::string &drawing, const double exact, const unsigned order, const unsigned times)
  {
    const TextFile file(".geo", drawing);
    auto           mesh = make_mesh<dim>(file.mesh(), true, order);
    for (unsigned k = 0; k < times; ++k)
    {
      auto refined = refine_simplices(*mesh.triangulation);
      mesh.triangulation = std::move(refined.triangulation);
      mesh.curved_cells->follow_refinement(*mesh.triangulation, refined.children);
    }
    return std::abs(volume<dim>(CurvedSimplexMapping<dim>(*mesh.curved_cells), *mesh.triangulation) - exact);
  }
} // namespace

// Cells of degree 2 with their nodes on a circle: the area lacks O(h^4). Parts of coarse cells of degree 2 lack what these do.
TEST(CurvedCells, refined_simplices_follow_the_drawing)
{
  const double pi = dealii::numbers::PI, area = 0.75 * pi;
  const double coarse = missing_volume_of_simplices<2>(ring, area, 4, 0), once = missing_volume_of_simplices<2>(ring, area, 4, 1),
               twice = missing_volume_of_simplices<2>(ring, area, 4, 2);
  EXPECT_NEAR(missing_volume_of_simplices<2>(ring, area, 2, 2), coarse, 1e-3 * coarse);
  EXPECT_GT(coarse, 1e-6);
  EXPECT_NEAR(coarse / once, 16, 1.5);
  EXPECT_NEAR(once / twice, 16, 1.5);
  EXPECT_LT(missing_volume_of_simplices<3>(cylinder, pi, 4, 1), missing_volume_of_simplices<3>(cylinder, pi, 2, 1) / 8);
}

TEST(CurvedCells, refined_quadrilaterals_follow_the_drawing_as_long_as_no_node_hangs)
{
  const TextFile file(".geo", ring + "Recombine Surface {1};");
  const double   area = 0.75 * dealii::numbers::PI;
  auto           mesh = make_mesh<2>(file.mesh(), false, 4);
  const auto     missing = [&] { return std::abs(volume_of_hypercubes(mesh) - area); };
  double         before = missing();
  for (unsigned k = 0; k < 2; ++k)
  {
    mesh.triangulation->refine_global(1);
    mesh.curved_cells->follow_refinement(*mesh.triangulation);
    EXPECT_NEAR(before / missing(), 16, 1.5) << k;
    before = missing();
  }
  // Cells beside a hanging node are exactly parts of what they were.
  const double whole = volume_of_hypercubes(mesh);
  mesh.triangulation->begin_active()->set_refine_flag();
  mesh.triangulation->execute_coarsening_and_refinement();
  mesh.curved_cells->follow_refinement(*mesh.triangulation);
  EXPECT_NEAR(volume_of_hypercubes(mesh), whole, 1e-13);
}

// Two sides of a quadrilateral meet smoothly on a circle: there is no polynomial of high degree with a positive Jacobian at that corner.
TEST(CurvedCells, cells_that_the_drawing_would_fold_stay_as_they_are)
{
  const TextFile file(".geo", "SetFactory(\"OpenCASCADE\"); Disk(1) = {0, 0, 0, 1}; Mesh.MeshSizeMax = 1; Mesh.MeshSizeMin = 1;");
  auto           mesh = make_mesh<2>(file.mesh(), false, 4);
  ASSERT_TRUE(mesh.curved_cells);
  for (unsigned k = 0; k < 3; ++k)
  {
    mesh.triangulation->refine_global(1);
    mesh.curved_cells->follow_refinement(*mesh.triangulation);
  }
  EXPECT_TRUE(mesh.curved_cells->folded_cells(*mesh.triangulation).empty());
  EXPECT_NEAR(volume_of_hypercubes(mesh), dealii::numbers::PI, 1e-3);
}
