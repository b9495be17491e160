// Cells of order 2: where their points lie, before and after refinement, and from files.
#include "unilateral/mesh/curved_cells.h"

#include "unilateral/mesh/make_mesh.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q_cache.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include "unilateral/spaces/curved_simplex_mapping.h"

#include "text_file.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

#include <unistd.h>

using namespace unilateral;
using dealii::Point;
using dealii::Triangulation;

namespace
{
  struct MeshFile : TextFile
  {
    using TextFile::TextFile;

    MeshDescription mesh() const
    {
      MeshDescription description;
      description.source = MeshDescription::Source::file;
      description.file = name;
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
    const MeshFile file(".msh", ring_cell(angle, type, with_centre));
    auto           mesh = make_mesh<2>(file.mesh(), false);
    ASSERT_TRUE(mesh.curved_cells);
    EXPECT_TRUE(mesh.curved);
    EXPECT_NEAR(volume_of_hypercubes(mesh), area, 2e-4 * area) << type;
  }
}

TEST(CurvedCells, refinement_keeps_the_geometry)
{
  const MeshFile file(".msh", ring_cell(0.8, 10, true));
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

  auto refined = refine_simplices(triangulation, orders_by_shortest_diagonal(triangulation));
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
  const MeshFile file(".msh", header + "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0.5 0.9 0\n5 0.5 0.5 0\n6 0 0.5 0\n$EndNodes\n"
                                       "$Elements\n1\n1 9 2 1 1 1 2 3 4 5 6\n$EndElements\n");
  const auto     mesh = make_mesh<2>(file.mesh(), true);
  EXPECT_FALSE(mesh.curved_cells);
  ASSERT_EQ(mesh.warnings.size(), 1u);
  EXPECT_NE(mesh.warnings[0].find("a curved cell is folded over itself near (0.333333, 0.333333)"), std::string::npos) << mesh.warnings[0];
}

TEST(CurvedCells, what_is_straight_is_no_curved_mesh)
{
  const MeshFile file(".msh", header + "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0.5 0 0\n5 0.5 0.5 0\n6 0 0.5 0\n$EndNodes\n"
                                       "$Elements\n1\n1 9 2 1 1 1 2 3 4 5 6\n$EndElements\n");
  EXPECT_FALSE(make_mesh<2>(file.mesh(), true).curved_cells);
}

TEST(CurvedCells, drawings_are_meshed_to_their_curves)
{
  const MeshFile file(".geo", "SetFactory(\"OpenCASCADE\"); Disk(1) = {0, 0, 0, 1}; Mesh.MeshSizeMax = 0.4; Mesh.MeshSizeMin = 0.4;");
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
    const MeshFile file(".geo", drawing);
    auto           mesh = make_mesh<dim>(file.mesh(), true, order);
    for (unsigned k = 0; k < times; ++k)
    {
      auto refined = refine_simplices(*mesh.triangulation, orders_by_shortest_diagonal(*mesh.triangulation));
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
  const MeshFile file(".geo", ring + "Recombine Surface {1};");
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

// Two squares side by side, of which the drawing moves the lines x = 1 and x = 2 and folds the left one over itself.
TEST(CurvedCells, folded_cells_of_a_drawing_keep_degree_2_and_fit_to_their_neighbours)
{
  Triangulation<2> triangulation;
  dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, {2, 1}, Point<2>(0, 0), Point<2>(2, 1));
  const auto drawn_at = [](const Point<2> &x) { return Point<2>(x[0] + 0.1 * x[0] * x[1] * (1 - x[1]), x[1]); };
  for (const bool with_fold : {false, true})
  {
    CurvedCells<2> curved(triangulation, {});
    DrawnCells<2>  drawing(false, 4);
    for (const unsigned cell : {0u, 1u})
    {
      std::vector<Point<2>> nodes;
      for (const Point<2> &unit : drawing.unit_nodes())
        nodes.push_back(drawn_at(unit + Point<2>(cell, 0)));
      if (cell == 0 && with_fold)
        nodes[12][0] += 3; // the middle of the left square
      drawing.add(cell, nodes);
    }
    EXPECT_EQ(drawing.folded_cells().size(), with_fold ? 1u : 0u);
    curved.follow_drawing(triangulation, drawing);
    Triangulation<2> refined;
    refined.copy_triangulation(triangulation);
    refined.refine_global(1);
    curved.follow_refinement(refined);
    std::map<std::vector<unsigned>, Point<2>> known;
    for (const auto &cell : refined.active_cell_iterators())
    {
      const auto nodes = curved.nodes(cell);
      for (unsigned n = 0; n < nodes.size(); ++n)
        EXPECT_LT(known.emplace(vertices_around<2>(cell, curved.unit_nodes()[n]), nodes[n]).first->second.distance(nodes[n]), 1e-14);
    }
    const auto nodes_of_line = [&](const double x, const bool follows)
    {
      unsigned n = 0;
      for (const auto &[vertices, node] : known)
        for (const double y : {0.25, 0.5, 0.75})
          n += node.distance(follows ? drawn_at(Point<2>(x, y)) : Point<2>(x, y)) < 1e-14;
      return n;
    };
    EXPECT_EQ(nodes_of_line(1, !with_fold), 3u);
    EXPECT_EQ(nodes_of_line(2, true), 3u);
  }
}

// A coarse and a fine cylinder: some cells of the coarse one are folded with degree 4. Those of the other follow it all the same.
TEST(CurvedCells, folded_tetrahedra_leave_others_alone)
{
  const MeshFile file(".geo", R"(SetFactory("OpenCASCADE"); Cylinder(1) = {0, 0, 0, 0, 0, 1, 1}; Cylinder(2) = {5, 0, 0, 0, 0, 1, 1};
MeshSize{PointsOf{Volume{1};}} = 1.2; MeshSize{PointsOf{Volume{2};}} = 0.6; Mesh.MeshSizeExtendFromBoundary = 1;
)");
  const auto     missing = [&](const unsigned order)
  {
    auto mesh = make_mesh<3>(file.mesh(), true, order);
    auto refined = refine_simplices(*mesh.triangulation, orders_by_shortest_diagonal(*mesh.triangulation));
    mesh.curved_cells->follow_refinement(*refined.triangulation, refined.children);
    const CurvedSimplexMapping<3> mapping(*mesh.curved_cells);
    const dealii::FE_Nothing<3>   nothing(dealii::ReferenceCells::Tetrahedron);
    dealii::FEValues<3>           values(mapping, nothing, dealii::QGaussSimplex<3>(4), dealii::update_JxW_values);
    std::array<double, 2>         sums{};
    for (const auto &cell : refined.triangulation->active_cell_iterators())
    {
      values.reinit(cell);
      for (const double w : values.get_JxW_values())
      {
        EXPECT_GT(w, 0);
        sums[cell->center()[0] > 2.5] += w;
      }
    }
    return std::array<double, 2>{std::abs(sums[0] - dealii::numbers::PI), std::abs(sums[1] - dealii::numbers::PI)};
  };
  const auto stayed = missing(2), followed = missing(4);
  EXPECT_LT(followed[1], stayed[1] / 8);
  EXPECT_LT(followed[0], stayed[0] / 4);
  EXPECT_GT(followed[0] / stayed[0], 1.2 * followed[1] / stayed[1]); // all but the cells that are folded
}
