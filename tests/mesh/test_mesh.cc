// Measures, names and errors of every source of a mesh.
#include "unilateral/base/file_access.h"
#include "unilateral/mesh/cells_read_ahead.h"
#include "unilateral/mesh/make_mesh.h"
#include "unilateral/mesh/make_outline.h"
#include "unilateral/mesh/simplex_refinement.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q.h>

#include "text_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include <unistd.h>

namespace
{
  using namespace unilateral;
  constexpr double pi = dealii::numbers::PI;

  MeshSpec box(const std::vector<double> &lower, const std::vector<double> &upper, const std::vector<unsigned> &cells)
  {
    MeshSpec spec;
    spec.source = MeshSpec::Source::box;
    spec.box_lower = lower;
    spec.box_upper = upper;
    spec.cells = cells;
    return spec;
  }

  MeshSpec ball(const std::vector<double> &center, const double radius)
  {
    MeshSpec spec;
    spec.source = MeshSpec::Source::ball;
    spec.center = center;
    spec.radius = radius;
    return spec;
  }

  MeshSpec shell(const std::vector<double> &center, const double inner, const double outer)
  {
    MeshSpec spec;
    spec.source = MeshSpec::Source::shell;
    spec.center = center;
    spec.inner = inner;
    spec.outer = outer;
    return spec;
  }

  MeshSpec file(const std::string &path)
  {
    MeshSpec spec;
    spec.source = MeshSpec::Source::file;
    spec.file = path;
    spec.where = {"case.toml", 3, 8};
    return spec;
  }

  const std::string test_data = PROJECT_DIR "/tests/data/", example_data = PROJECT_DIR "/examples/data/";

  /// Lengths, areas, volumes by name, with the mapping a problem of degree @p degree uses.
  struct Measures
  {
    double                        total = 0;
    std::map<std::string, double> parts, regions;
    double                        worst_cell = std::numeric_limits<double>::max(); ///< smallest Jacobian over the mean one of its cell
  };

  template <int dim>
  Measures measure(const Mesh<dim> &mesh, const unsigned degree = 1)
  {
    std::unique_ptr<dealii::Mapping<dim>>       mapping;
    std::unique_ptr<dealii::FiniteElement<dim>> fe;
    dealii::Quadrature<dim>                     in_cells;
    dealii::Quadrature<dim - 1>                 on_faces;
    if (mesh.simplex && dim > 1)
    {
      mapping = std::make_unique<dealii::MappingFE<dim>>(dealii::FE_SimplexP<dim>(1));
      fe = std::make_unique<dealii::FE_SimplexP<dim>>(1);
      in_cells = dealii::QGaussSimplex<dim>(2);
      on_faces = dealii::QGaussSimplex<dim - 1>(2);
    }
    else
    {
      mapping = std::make_unique<dealii::MappingQ<dim>>(degree);
      fe = std::make_unique<dealii::FE_Q<dim>>(1);
      in_cells = dealii::QGauss<dim>(degree + 2);
      on_faces = dealii::QGauss<dim - 1>(degree + 2);
    }
    dealii::FEValues<dim>     cell_values(*mapping, *fe, in_cells, dealii::update_JxW_values);
    dealii::FEFaceValues<dim> face_values(*mapping, *fe, on_faces, dealii::update_JxW_values);
    Measures                  result;
    for (const auto &cell : mesh.triangulation->active_cell_iterators())
    {
      cell_values.reinit(cell);
      double volume = 0, smallest = std::numeric_limits<double>::max();
      for (unsigned q = 0; q < in_cells.size(); ++q)
      {
        volume += cell_values.JxW(q);
        smallest = std::min(smallest, cell_values.JxW(q) / in_cells.weight(q));
      }
      result.worst_cell = std::min(result.worst_cell, smallest / volume);
      result.total += volume;
      result.regions[mesh.region_names.at(cell->material_id())] += volume;
      for (const unsigned f : cell->face_indices())
        if (cell->at_boundary(f))
        {
          face_values.reinit(cell, f);
          for (unsigned q = 0; q < on_faces.size(); ++q)
            result.parts[mesh.part_names.at(cell->face(f)->boundary_id())] += face_values.JxW(q);
        }
    }
    return result;
  }

  using Names = std::map<std::string, double>;

  void expect_near(const Names &actual, const Names &expected, const double tolerance)
  {
    ASSERT_EQ(actual.size(), expected.size());
    for (const auto &[name, value] : expected)
    {
      ASSERT_TRUE(actual.count(name)) << name;
      EXPECT_NEAR(actual.at(name), value, tolerance * std::max(1., value)) << name;
    }
  }

  template <int dim>
  void check_box(const MeshSpec &spec, const bool simplex, const Names &sides, const double volume, const unsigned n_cells)
  {
    for (const unsigned n : {0, 1, 2})
    {
      auto mesh = make_mesh<dim>(spec, simplex);
      EXPECT_EQ(mesh.triangulation->n_active_cells(), n_cells);
      EXPECT_FALSE(mesh.curved);
      mesh.triangulation->refine_global(n);
      const auto m = measure(mesh);
      EXPECT_NEAR(m.total, volume, 1e-12 * volume);
      expect_near(m.parts, sides, 1e-12);
      expect_near(m.regions, {{"domain", volume}}, 1e-12);
      EXPECT_GT(m.worst_cell, 0);
    }
  }

  TEST(Mesh, Boxes)
  {
    for (const bool simplex : {false, true})
    {
      check_box<1>(box({-1}, {3}, {5}), simplex, {{"left", 1}, {"right", 1}}, 4, 5);
      const Names rectangle = {{"left", 0.5}, {"right", 0.5}, {"bottom", 2}, {"top", 2}};
      check_box<2>(box({-1, 1}, {1, 1.5}, {4, 3}), simplex, rectangle, 1, simplex ? 24 : 12);
      const Names block = {{"left", 6}, {"right", 6}, {"bottom", 3}, {"top", 3}, {"front", 2}, {"back", 2}};
      check_box<3>(box({0, 0, 0}, {1, 2, 3}, {2, 3, 1}), simplex, block, 6, simplex ? 30 : 6);
    }
    EXPECT_EQ(make_mesh<2>(box({0, 0}, {1, 1}, {3}), false).triangulation->n_active_cells(), 9u) << "one number means all directions";
    EXPECT_EQ((make_mesh<3>(box({0, 0, 0}, {1, 1, 1}, {1}), false).part_names),
              (std::vector<std::string>{"left", "right", "bottom", "top", "front", "back"}));
  }

  TEST(Mesh, TrianglesOfABoxAreRightAngled)
  {
    auto mesh = make_mesh<2>(box({0, 0}, {1, 1}, {2}), true);
    mesh.triangulation->refine_global(1);
    EXPECT_EQ(mesh.triangulation->n_active_cells(), 32u);
    EXPECT_EQ(mesh.triangulation->n_used_vertices(), 25u);
    for (const auto &cell : mesh.triangulation->active_cell_iterators())
      EXPECT_NEAR(cell->diameter(), 0.25 * std::sqrt(2.), 1e-14);
  }

  /// The error of measures goes down by 2^order a refinement.
  template <int dim>
  void check_convergence(const MeshSpec &spec, const bool simplex, const unsigned degree, const double volume, const Names &parts)
  {
    SCOPED_TRACE(testing::Message() << dim << "-D " << (simplex ? "P" : "Q") << degree);
    const double   order = simplex ? 2 : 2 * degree;
    const unsigned last = dim == 2 ? 3 : 2;
    double         volume_error[2] = {};
    Names          part_error[2];
    for (const unsigned i : {0, 1})
    {
      auto mesh = make_mesh<dim>(spec, simplex);
      EXPECT_TRUE(mesh.curved);
      mesh.triangulation->refine_global(last - 1 + i);
      const auto m = measure(mesh, degree);
      EXPECT_GT(m.worst_cell, 0.2) << "cells stay well shaped";
      volume_error[i] = std::abs(m.total - volume);
      ASSERT_EQ(m.parts.size(), parts.size());
      for (const auto &[name, value] : m.parts)
        part_error[i][name] = std::abs(value - parts.at(name));
    }
    EXPECT_GT(std::log2(volume_error[0] / volume_error[1]), order - 0.2);
    EXPECT_LT(std::log2(volume_error[0] / volume_error[1]), order + 0.5);
    for (const auto &[name, error] : part_error[0])
      EXPECT_GT(std::log2(error / part_error[1][name]), order - 0.2) << name;
  }

  TEST(Mesh, Balls)
  {
    const double r = 1.5;
    for (const unsigned degree : {1, 2, 3})
    {
      check_convergence<2>(ball({1, -2}, r), false, degree, pi * r * r, {{"surface", 2 * pi * r}});
      if (degree < 3)
        check_convergence<3>(ball({1, -2, 3}, r), false, degree, 4. / 3 * pi * r * r * r, {{"surface", 4 * pi * r * r}});
    }
    check_convergence<2>(ball({1, -2}, r), true, 1, pi * r * r, {{"surface", 2 * pi * r}});

    for (const bool simplex : {false, true})
    {
      auto interval = make_mesh<1>(ball({3}, 0.5), simplex);
      interval.triangulation->refine_global(2);
      EXPECT_NEAR(measure(interval).total, 1, 1e-14);
      expect_near(measure(interval).parts, {{"surface", 2}}, 0);
    }
  }

  TEST(Mesh, BallsOfAnySizeAreTheSameShape)
  {
    for (const double r : {1e-3, 1., 1e4})
    {
      auto mesh = make_mesh<3>(ball({0, 0, 0}, r), false);
      mesh.triangulation->refine_global(1);
      EXPECT_NEAR(measure(mesh, 2).total / (r * r * r), 4. / 3 * pi, 2e-3) << r;
    }
  }

  TEST(Mesh, Shells)
  {
    for (const unsigned degree : {1, 2})
    {
      check_convergence<2>(shell({1, 2}, 0.5, 2), false, degree, 3.75 * pi, {{"inner", pi}, {"outer", 4 * pi}});
      check_convergence<3>(shell({1, 2, 0}, 1, 2), false, degree, 28. / 3 * pi, {{"inner", 4 * pi}, {"outer", 16 * pi}});
    }
    check_convergence<2>(shell({1, 2}, 0.5, 2), true, 1, 3.75 * pi, {{"inner", pi}, {"outer", 4 * pi}});
    const auto thin = make_mesh<3>(shell({0, 0, 0}, 0.9, 1), true);
    EXPECT_GT(thin.triangulation->n_active_cells(), make_mesh<3>(shell({0, 0, 0}, 0.1, 1), true).triangulation->n_active_cells());
  }

  /// Volume over the cube of the root mean square edge; 1 for the regular tetrahedron, 0 for a flat one.
  double worst_shape(const dealii::Triangulation<3> &triangulation)
  {
    double worst = 1;
    for (const auto &cell : triangulation.active_cell_iterators())
    {
      double edges = 0;
      for (unsigned a = 0; a < 4; ++a)
        for (unsigned b = 0; b < a; ++b)
          edges += cell->vertex(a).distance_square(cell->vertex(b)) / 6;
      worst = std::min(worst, cell->measure() * 6 * std::sqrt(2.) / std::pow(edges, 1.5));
    }
    return worst;
  }

  /// The mesh after one refinement of its triangles or tetrahedra.
  template <int dim>
  Mesh<dim> refined(Mesh<dim> mesh)
  {
    mesh.triangulation = refine_simplices(*mesh.triangulation, orders_by_shortest_diagonal(*mesh.triangulation)).triangulation;
    return mesh;
  }

  TEST(Mesh, RefinedTetrahedraStayWellShaped)
  {
    for (const auto &spec : {box({0, 0, 0}, {1, 1, 1}, {2}), ball({0, 0, 0}, 1)})
    {
      auto         mesh = make_mesh<3>(spec, true);
      const double before = worst_shape(*mesh.triangulation);
      const auto   n_cells = mesh.triangulation->n_active_cells();
      for (unsigned i = 0; i < 3; ++i)
        mesh = refined(std::move(mesh));
      EXPECT_EQ(mesh.triangulation->n_active_cells(), 512 * n_cells);
      EXPECT_GT(worst_shape(*mesh.triangulation), 0.5 * before);
    }
  }

  /// Lengths of the edges over the longest one, in ascending order: congruent cells have the same, up to the size.
  std::vector<long> proportions(const std::array<dealii::Point<3>, 4> &corners)
  {
    std::vector<double> lengths;
    for (unsigned a = 0; a < 4; ++a)
      for (unsigned b = 0; b < a; ++b)
        lengths.push_back(corners[a].distance(corners[b]));
    std::sort(lengths.begin(), lengths.end());
    std::vector<long> rounded;
    for (const double length : lengths)
      rounded.push_back(std::lround(1e6 * length / lengths.back()));
    return rounded;
  }

  TEST(Mesh, ATetrahedronHasDescendantsOfThreeShapes)
  {
    dealii::Triangulation<3> mesh;
    dealii::CellData<3>      cell(4);
    cell.vertices = {0, 1, 2, 3};
    mesh.create_triangulation({{0, 0, 0}, {1, 0.2, 0.1}, {0.3, 1.1, 0}, {0.2, 0.4, 0.9}}, {cell}, {});
    const double before = worst_shape(mesh);
    auto         orders = orders_by_shortest_diagonal(mesh);
    for (unsigned level = 1; level <= 3; ++level)
    {
      auto refined = refine_simplices(mesh, orders);
      mesh.clear();
      mesh.copy_triangulation(*refined.triangulation);
      orders = refined.corner_orders;
      std::set<std::vector<long>> shapes;
      for (const auto &child : mesh.active_cell_iterators())
        shapes.insert(proportions({child->vertex(0), child->vertex(1), child->vertex(2), child->vertex(3)}));
      EXPECT_EQ(shapes.size(), 3u) << level;
      EXPECT_GT(worst_shape(mesh), 0.6 * before) << level;
    }
  }

  /// Children of a cell follow each other, and each has its corners where the table says.
  template <int dim>
  void expect_children_in_their_order(const std::vector<double> &high)
  {
    const auto                     coarse = make_mesh<dim>(box(std::vector<double>(dim, 0.), high, {1}), true);
    const std::vector<CornerOrder> orders = orders_by_shortest_diagonal(*coarse.triangulation);
    const auto                     refined = refine_simplices(*coarse.triangulation, orders);
    const auto                    &children = children_of_simplex<dim>();
    ASSERT_EQ(refined.triangulation->n_active_cells(), children.size() * coarse.triangulation->n_active_cells());
    for (const auto &cell : refined.triangulation->active_cell_iterators())
    {
      const unsigned     k = cell->active_cell_index();
      const CornerOrder &order = refined.corner_orders[k];
      auto               parent = coarse.triangulation->begin_active();
      std::advance(parent, k / children.size());
      EXPECT_EQ(refined.children[k].parent, parent->active_cell_index());
      for (unsigned v = 0; v <= dim; ++v)
      {
        const auto &[a, b] = children[k % children.size()][v];
        const auto &of_parent = orders[parent->active_cell_index()];
        const auto  middle = parent->vertex(of_parent[a]) + 0.5 * (parent->vertex(of_parent[b]) - parent->vertex(of_parent[a]));
        EXPECT_LT(cell->vertex(order[v]).distance(middle), 1e-14);
      }
      EXPECT_GT(cell->measure(), 0);
    }
  }

  TEST(Mesh, ChildrenOfSimplicesFollowEachOther)
  {
    expect_children_in_their_order<2>({1, 2});
    expect_children_in_their_order<3>({1, 2, 3});
  }

  TEST(Mesh, RefinedSimplicesFollowTheSphereAndKeepNames)
  {
    auto   disc = make_mesh<2>(ball({1, 2}, 1), true);
    auto   solid = make_mesh<3>(shell({1, 2, 3}, 1, 2), true);
    double disc_error[2] = {}, solid_error[2] = {};
    for (const unsigned i : {0, 1})
    {
      disc = refined(std::move(disc));
      solid = refined(std::move(solid));
      const auto of_disc = measure(disc), of_solid = measure(solid);
      EXPECT_NEAR(of_disc.parts.at("surface"), 2 * pi, 0.1);
      EXPECT_NEAR(of_solid.parts.at("inner"), 4 * pi, 0.6);
      EXPECT_NEAR(of_solid.parts.at("outer"), 16 * pi, 2.4);
      disc_error[i] = std::abs(of_disc.total - pi);
      solid_error[i] = std::abs(of_solid.total - 28. / 3 * pi);
    }
    EXPECT_GT(std::log2(disc_error[0] / disc_error[1]), 1.8);
    EXPECT_GT(std::log2(solid_error[0] / solid_error[1]), 1.8);

    const auto m = measure(refined(make_mesh<3>(box({0, 0, 0}, {1, 2, 3}, {1}), true)));
    expect_near(m.parts, {{"left", 6}, {"right", 6}, {"bottom", 3}, {"top", 3}, {"front", 2}, {"back", 2}}, 1e-12);
    EXPECT_NEAR(m.total, 6, 1e-12);
    const auto block = measure(refined(make_mesh<3>(file(test_data + "tetrahedra-41.msh"), true)));
    expect_near(block.parts, {{"bottom", 1}, {"top", 1}, {"sides", 4}}, 1e-12);
    expect_near(block.regions, {{"block", 1}}, 1e-12);
    const auto square = measure(refined(make_mesh<2>(file(test_data + "triangles-22.msh"), true)));
    expect_near(square.parts, {{"left", 1}, {"right", 1}, {"bottom", 1}, {"boundary", 1}}, 1e-12);
    expect_near(square.regions, {{"corner", 0.25}, {"rest", 0.75}}, 1e-12);
  }

  /// Twice the radius of the inscribed circle over that of the one around; 1 for the regular triangle.
  double worst_shape(const dealii::Triangulation<2> &triangulation)
  {
    double worst = 1;
    for (const auto &cell : triangulation.active_cell_iterators())
    {
      const double a = cell->vertex(0).distance(cell->vertex(1)), b = cell->vertex(1).distance(cell->vertex(2)),
                   c = cell->vertex(2).distance(cell->vertex(0));
      worst = std::min(worst, (b + c - a) * (c + a - b) * (a + b - c) / (a * b * c));
    }
    return worst;
  }

  /// Refined @p times times where the cell contains the origin of the box, or touches it.
  template <int dim>
  void refine_around_corner(Mesh<dim> mesh, const unsigned times, const double worst)
  {
    const auto   before = measure(mesh);
    const double shape = worst_shape(*mesh.triangulation);
    const auto   n_cells = mesh.triangulation->n_active_cells();
    for (unsigned i = 0; i < times; ++i)
    {
      const auto       &coarse = *mesh.triangulation;
      std::vector<bool> chosen(coarse.n_active_cells(), false);
      for (const auto &cell : coarse.active_cell_iterators())
        for (const unsigned v : cell->vertex_indices())
          if (cell->vertex(v).norm() < 1e-12)
            chosen[cell->active_cell_index()] = true;
      auto refined = refine_simplices(coarse, chosen);

      // Every chosen cell is cut in 2^dim, its parts are the whole of it, and so they are of the others.
      std::vector<unsigned> parts(coarse.n_active_cells(), 0);
      std::vector<double>   volume(coarse.n_active_cells(), 0);
      for (const auto &cell : refined.triangulation->active_cell_iterators())
      {
        const unsigned parent = refined.children[cell->active_cell_index()].parent;
        ++parts[parent];
        volume[parent] += cell->measure();
        EXPECT_GT(cell->measure(), 0);
      }
      for (const auto &cell : coarse.active_cell_iterators())
      {
        const unsigned c = cell->active_cell_index();
        EXPECT_NEAR(volume[c], cell->measure(), 1e-12 * cell->measure());
        if (chosen[c])
        {
          EXPECT_EQ(parts[c], 1u << dim);
        }
      }
      // New vertices are the midpoints of cut lines.
      const auto &vertices = refined.triangulation->get_vertices();
      ASSERT_EQ(vertices.size(), coarse.n_vertices() + refined.cut_lines.size());
      for (std::size_t k = 0; k < refined.cut_lines.size(); ++k)
      {
        const auto &[a, b] = refined.cut_lines[k];
        EXPECT_LT(vertices[coarse.n_vertices() + k].distance((vertices[a] + vertices[b]) / 2.), 1e-14);
      }
      mesh.triangulation = std::move(refined.triangulation);
    }
    // A node that hangs would leave faces without a neighbour inside.
    const auto after = measure(mesh);
    expect_near(after.parts, Names(before.parts.begin(), before.parts.end()), 1e-11);
    EXPECT_NEAR(after.total, before.total, 1e-11);
    EXPECT_GT(worst_shape(*mesh.triangulation), worst * shape);
    EXPECT_LT(mesh.triangulation->n_active_cells(), n_cells + 300 * times); // and no others than it takes
  }

  TEST(Mesh, SimplicesAreRefinedInPlacesWithoutHangingNodes)
  {
    refine_around_corner(make_mesh<2>(box({0, 0}, {1, 1}, {3}), true), 12, 0.4);
    refine_around_corner(make_mesh<2>(file(test_data + "triangles-22.msh"), true), 12, 0.4);
    refine_around_corner(make_mesh<3>(box({0, 0, 0}, {1, 2, 3}, {2}), true), 8, 0.2);
    refine_around_corner(make_mesh<3>(file(test_data + "tetrahedra-41.msh"), true), 8, 0.2);
  }

  TEST(Mesh, DimensionIsThatOfTheSource)
  {
    EXPECT_EQ(mesh_outline(box({0}, {1}, {1})).dimension, 1u);
    EXPECT_EQ(mesh_outline(ball({0, 0}, 1)).dimension, 2u);
    EXPECT_EQ(mesh_outline(shell({0, 0, 0}, 1, 2)).dimension, 3u);
    EXPECT_EQ(mesh_outline(file(test_data + "segments-41.msh")).dimension, 1u);
    EXPECT_EQ(mesh_outline(file(test_data + "triangles-22.msh")).dimension, 2u);
    EXPECT_EQ(mesh_outline(file(test_data + "hexahedra-41.msh")).dimension, 3u);
    EXPECT_EQ(mesh_outline(file(test_data + "square.geo")).dimension, 2u);
    EXPECT_EQ(mesh_outline(file(test_data + "block-with-bore.step")).dimension, 3u);
    EXPECT_EQ(mesh_outline(file(test_data + "disk.step")).dimension, 2u);
  }

  TEST(Mesh, GmshFilesOfEveryKind)
  {
    const Names square_sides = {{"left", 1}, {"right", 1}, {"bottom", 1}, {"boundary", 1}};
    const Names square_regions = {{"corner", 0.25}, {"rest", 0.75}};
    for (const std::string version : {"22", "41", "22-binary", "41-binary", "order-2"})
    {
      SCOPED_TRACE(version);
      auto mesh = make_mesh<2>(file(test_data + "triangles-" + version + ".msh"), true);
      EXPECT_TRUE(mesh.simplex);
      EXPECT_FALSE(mesh.curved);
      // A curve inside the domain is no part of the boundary; who names it is told.
      EXPECT_EQ(mesh.warnings.size(), 1u);
      EXPECT_EQ(mesh.part_names, (std::vector<std::string>{"left", "right", "bottom", "boundary"}));
      mesh.triangulation->refine_global(1);
      const auto m = measure(mesh);
      expect_near(m.parts, square_sides, 1e-12);
      expect_near(m.regions, square_regions, 1e-12);
    }
    for (const std::string version : {"22", "41"})
    {
      SCOPED_TRACE(version);
      auto quadrilaterals = make_mesh<2>(file(test_data + "quadrilaterals-" + version + ".msh"), false);
      quadrilaterals.triangulation->refine_global(1);
      auto m = measure(quadrilaterals);
      expect_near(m.parts, square_sides, 1e-12);
      expect_near(m.regions, square_regions, 1e-12);
      EXPECT_GT(m.worst_cell, 0);

      for (const std::string kind : {"tetrahedra", "hexahedra"})
      {
        auto block = make_mesh<3>(file(test_data + kind + "-" + version + ".msh"), kind == "tetrahedra");
        block.triangulation->refine_global(1);
        m = measure(block);
        EXPECT_GT(m.worst_cell, 0);
        expect_near(m.parts, {{"bottom", 1}, {"top", 1}, {"sides", 4}}, 1e-12);
        expect_near(m.regions, {{"block", 1}}, 1e-12);
      }
      for (const bool simplex : {false, true})
      {
        auto segments = make_mesh<1>(file(test_data + "segments-" + version + ".msh"), simplex);
        segments.triangulation->refine_global(2);
        m = measure(segments);
        expect_near(m.parts, {{"start", 1}, {"end", 1}}, 0);
        expect_near(m.regions, {{"fine", 1}, {"coarse", 1}}, 1e-12);
        for (const auto &cell : segments.triangulation->active_cell_iterators())
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary())
            {
              EXPECT_EQ(segments.part_names[face->boundary_id()], face->vertex(0)[0] < 2 ? "start" : "end");
            }
      }
    }
  }

  TEST(Mesh, PlateWithHole)
  {
    const double hole = 0.04 * pi;
    for (const std::string &path :
         {example_data + "plate-with-hole.msh", test_data + "plate-with-hole-22.msh", example_data + "plate-with-hole.geo"})
    {
      SCOPED_TRACE(path);
      const auto mesh = make_mesh<2>(file(path), true);
      EXPECT_TRUE(mesh.warnings.empty());
      const auto m = measure(mesh);
      EXPECT_NEAR(m.regions.at("hard"), 0.8, 1e-12);
      EXPECT_NEAR(m.regions.at("soft"), 1.2 - hole, 2e-3);
      EXPECT_NEAR(m.parts.at("hole"), 0.4 * pi, 5e-3);
      EXPECT_NEAR(m.parts.at("left"), 1, 1e-12);
      EXPECT_NEAR(m.parts.at("right"), 1, 1e-12);
      EXPECT_NEAR(m.parts.at("bottom"), 2, 1e-12);
      EXPECT_NEAR(m.parts.at("top"), 2, 1e-12);
      EXPECT_EQ(m.parts.size(), 5u);
    }
  }

  TEST(Mesh, GeometryIsMeshedOnTheWay)
  {
    auto     plate = file(example_data + "plate-with-hole.geo");
    unsigned n_cells[2] = {};
    for (const bool simplex : {false, true})
    {
      SCOPED_TRACE(simplex);
      for (const unsigned i : {0, 1})
      {
        plate.size = i == 0 ? 0.2 : 0.05;
        const auto mesh = make_mesh<2>(plate, simplex);
        const auto m = measure(mesh);
        EXPECT_NEAR(m.total, 2 - 0.04 * pi, i == 0 ? 0.05 : 5e-3);
        EXPECT_GT(m.worst_cell, 0);
        n_cells[i] = mesh.triangulation->n_active_cells();
      }
      EXPECT_GT(n_cells[1], 4 * n_cells[0]);
      EXPECT_LT(n_cells[1], 32 * n_cells[0]);
    }

    auto block = file(test_data + "block-with-bore.step");
    block.size = 0.25;
    for (const bool simplex : {false, true})
    {
      const auto mesh = make_mesh<3>(block, simplex);
      const auto m = measure(mesh);
      EXPECT_GT(m.worst_cell, 0);
      EXPECT_NEAR(m.total, 1 - pi / 32, 0.02);
      ASSERT_EQ(m.parts.size(), 7u);
      for (unsigned i = 1; i <= 7; ++i)
        EXPECT_TRUE(m.parts.count("surface" + std::to_string(i)));
      EXPECT_NEAR(m.parts.at("surface1"), 0.5, 1e-9) << "x = 0";
    }
    for (const bool simplex : {false, true})
    {
      const auto m = measure(make_mesh<2>(file(test_data + "disk.step"), simplex));
      EXPECT_NEAR(m.total, pi, 0.2);
      EXPECT_EQ(m.parts.count("curve1"), 1u);
    }
    // Straight cells along curves are known for what they are.
    EXPECT_TRUE(make_mesh<2>(plate, true).approximates_curves);
    EXPECT_TRUE(make_mesh<3>(block, true).approximates_curves);
  }

  TEST(Mesh, OutlineHasEveryNameOfTheMesh)
  {
    const auto holds = [](const std::vector<std::string> &names, const std::vector<std::string> &some)
    {
      return std::all_of(some.begin(), some.end(),
                         [&](const std::string &name) { return std::find(names.begin(), names.end(), name) != names.end(); });
    };
    auto block = file(test_data + "block-with-bore.step");
    block.size = 0.5;
    for (const auto &spec :
         {file(test_data + "tetrahedra-41.msh"), file(test_data + "tetrahedra-22.msh"), file(test_data + "cube.geo"), block})
    {
      const auto mesh = make_mesh<3>(spec, true);
      EXPECT_TRUE(holds(mesh_outline(spec).part_names, mesh.part_names)) << spec.file;
      EXPECT_TRUE(holds(mesh_outline(spec).region_names, mesh.region_names)) << spec.file;
    }
    EXPECT_EQ(mesh_outline(box({0, 0}, {1, 1}, {1})).part_names, (std::vector<std::string>{"left", "right", "bottom", "top"}));
  }

  TEST(Mesh, WhatTheWriterOfAStepFileCallsItselfIsNoName)
  {
    auto block = file(test_data + "block-with-bore.step");
    block.size = 0.5;
    EXPECT_EQ(make_mesh<3>(block, true).region_names, (std::vector<std::string>{"domain"}));
    EXPECT_EQ(make_mesh<2>(file(test_data + "disk.step"), true).region_names, (std::vector<std::string>{"domain"}));
  }

  /// The message of the InputError that @p action throws; its place must be on @p line.
  template <typename Action>
  std::string error_of(const Action &action, const unsigned line = 0)
  {
    try
    {
      action();
    }
    catch (const InputError &error)
    {
      EXPECT_EQ(error.diagnostics.size(), 1u);
      EXPECT_EQ(error.diagnostics.front().where.line, line);
      return error.diagnostics.front().message;
    }
    return "no error";
  }

  std::string error_of_file(const std::string &path, const bool simplex)
  {
    return error_of(
      [&]
      {
        const auto spec = file(path);
        switch (mesh_outline(spec).dimension)
        {
        case 1:
          make_mesh<1>(spec, simplex);
          return;
        case 2:
          make_mesh<2>(spec, simplex);
          return;
        default:
          make_mesh<3>(spec, simplex);
        }
      },
      3);
  }

  void expect_error(const std::string &message, const std::string &part)
  {
    EXPECT_NE(message.find(part), std::string::npos) << "\"" << message << "\" does not say \"" << part << '"';
  }

  struct MeshText : TextFile
  {
    explicit MeshText(const std::string &text, const std::string &ending = ".msh") : TextFile(ending, text) {}
  };

  /// A .msh 2.2 file with the given nodes and elements ("type 2 group entity nodes...").
  struct HandMadeMesh : MeshText
  {
    HandMadeMesh(const std::vector<std::array<double, 3>> &nodes, const std::vector<std::string> &elements)
      : MeshText(text(nodes, elements))
    {
    }

    static std::string text(const std::vector<std::array<double, 3>> &nodes, const std::vector<std::string> &elements)
    {
      std::ostringstream out;
      out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << nodes.size() << '\n';
      for (unsigned i = 0; i < nodes.size(); ++i)
        out << i + 1 << ' ' << nodes[i][0] << ' ' << nodes[i][1] << ' ' << nodes[i][2] << '\n';
      out << "$EndNodes\n$Elements\n" << elements.size() << '\n';
      for (unsigned i = 0; i < elements.size(); ++i)
        out << i + 1 << ' ' << elements[i] << '\n';
      out << "$EndElements\n";
      return out.str();
    }
  };

  TEST(Mesh, PolygonsOfAScriptAreTheDomain)
  {
    const MeshText polygon("Point(1) = {0, 0, 0, 1}; Point(2) = {1, 0, 0, 1}; Point(3) = {0, 1, 0, 1};\n"
                           "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 1};\nCurve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};\n",
                           ".geo");
    EXPECT_FALSE(make_mesh<2>(file(polygon.name), true).approximates_curves);

    // In space Gmsh's own kernel has no planes for the sides of what is extruded.
    for (const bool curved : {false, true})
    {
      const std::string side = curved ? "Circle(2) = {2, 1, 3};" : "Line(2) = {2, 3};";
      const MeshText prism("Point(1) = {0, 0, 0, 0.5}; Point(2) = {1, 0, 0, 0.5}; Point(3) = {0, 1, 0, 0.5};\nLine(1) = {1, 2}; " + side +
                             " Line(3) = {3, 1};\nCurve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};\nExtrude {0, 0, 1} {Surface{1};}\n",
                           ".geo");
      EXPECT_EQ(make_mesh<3>(file(prism.name), true).approximates_curves, curved);
    }
  }

  TEST(Mesh, CellsAreTurnedAndGroupsWithoutNamesAreNumbers)
  {
    // Two triangles, the second clockwise; a quadrilateral, clockwise; a node that nothing uses.
    const HandMadeMesh triangles({{0, 0, 5}, {1, 0, 5}, {9, 9, 9}, {1, 1, 5}, {0, 1, 5}},
                                 {"1 2 7 1 1 2", "2 2 3 1 1 2 4", "2 2 3 1 1 5 4"});
    const auto         mesh = make_mesh<2>(file(triangles.name), true);
    EXPECT_EQ(mesh.triangulation->n_used_vertices(), 4u);
    const auto m = measure(mesh);
    EXPECT_GT(m.worst_cell, 0);
    expect_near(m.parts, {{"7", 1}, {"boundary", 3}}, 1e-14);
    expect_near(m.regions, {{"3", 1}}, 1e-14);

    const HandMadeMesh quadrilateral({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {"3 2 0 1 1 4 3 2"});
    const auto         square = measure(make_mesh<2>(file(quadrilateral.name), false));
    EXPECT_NEAR(square.total, 1, 1e-14);
    expect_near(square.regions, {{"domain", 1}}, 1e-14);
  }

  TEST(Mesh, FilesThatAreNoMesh)
  {
    expect_error(error_of_file("/nonexistent.msh", true), "does not exist");
    expect_error(error_of_file(test_data, true), "is no ordinary file");
    expect_error(error_of_file(PROJECT_DIR "/CMakeLists.txt", true), "of no known kind");
    {
      const MeshText f("");
      expect_error(error_of_file(f.name, true), "is empty");
    }
    {
      const MeshText f("hello, world\n");
      expect_error(error_of_file(f.name, true), "is not a Gmsh mesh");
    }
    {
      const MeshText f("$MeshFormat\n1.0 0 8\n$EndMeshFormat\n");
      expect_error(error_of_file(f.name, true), "version 4.1 or 2.2");
    }
    {
      const MeshText f("hello, world\n", ".step");
      expect_error(error_of_file(f.name, true), "is not a STEP file");
    }
    {
      const MeshText f("ISO-10303-21;\nnonsense\n", ".step");
      testing::internal::CaptureStdout();
      expect_error(error_of_file(f.name, true), f.name);
      EXPECT_EQ(testing::internal::GetCapturedStdout(), "") << "the terminal is not for libraries";
    }
    {
      const MeshText f("Point(1) = {0, 0, 0};\nLine(1) = {1, 2};\n", ".geo");
      expect_error(error_of_file(f.name, true), f.name);
    }
    {
      const MeshText f("Point(1) = {0, 0, ;\n", ".geo");
      expect_error(error_of_file(f.name, true), f.name);
    }
    {
      const MeshText f("Point(1) = {0, 0, 0};\n  Exit ;\n", ".geo");
      expect_error(error_of_file(f.name, true), "Exit");
    }
    {
      const MeshText f("Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};\n"
                       "Line(1) = {1, 3}; Line(2) = {3, 2}; Line(3) = {2, 4}; Line(4) = {4, 1};\n"
                       "Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};\n",
                       ".geo");
      expect_error(error_of_file(f.name, true), "meshing '" + f.name + "' failed");
    }
    {
      const MeshText f("// nothing\n", ".geo");
      expect_error(error_of_file(f.name, true), "holds no mesh");
    }
    {
      const HandMadeMesh f({{0, 0, 0}}, {"15 2 1 1 1"});
      expect_error(error_of_file(f.name, true), "holds no mesh");
    }
    {
      const HandMadeMesh f({}, {});
      expect_error(error_of_file(f.name, true), "holds no mesh");
    }
    for (const std::string name : {"triangles-41.msh", "triangles-22.msh", "triangles-41-binary.msh", "hexahedra-41.msh"})
      for (const double share : {0.1, 0.5, 0.95})
      {
        // A file that a full disk or a broken download cut off: an error, or a smaller mesh, but never a crash.
        std::ifstream  whole(test_data + name, std::ios::binary);
        std::string    text{std::istreambuf_iterator<char>(whole), {}};
        const MeshText f(text.substr(0, text.size() * share));
        error_of_file(f.name, name[0] == 't');
      }
  }

  TEST(Mesh, CellsThatDoNotFit)
  {
    expect_error(error_of_file(test_data + "triangles-41.msh", false), "the mesh has triangles; use element = \"P1\"");
    expect_error(error_of_file(test_data + "tetrahedra-41.msh", false), "the mesh has tetrahedra; use element = \"P1\"");
    expect_error(error_of_file(test_data + "quadrilaterals-41.msh", true), "the mesh has quadrilaterals; use element = \"Q1\"");
    expect_error(error_of_file(test_data + "hexahedra-41.msh", true), "the mesh has hexahedra; use element = \"Q1\"");
    const std::vector<std::array<double, 3>> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0.5, 0}, {2, 2, 0}, {0.5, 0, 0}};
    {
      const HandMadeMesh f(square, {"3 2 1 1 1 2 3 4", "2 2 1 1 2 5 3"});
      expect_error(error_of_file(f.name, true), "mixes");
    }
    {
      const HandMadeMesh f(square, {"3 2 1 1 1 3 2 4"});
      expect_error(error_of_file(f.name, false), "folded over itself");
    }
    {
      const HandMadeMesh f({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {"2 2 1 1 1 2 3"});
      expect_error(error_of_file(f.name, true), "flat");
    }
    {
      const HandMadeMesh f({{0, 0, 0}, {1, 0, 0}, {0, 1, 1}}, {"2 2 1 1 1 2 3"});
      expect_error(error_of_file(f.name, true), "surface in space");
    }
    {
      const HandMadeMesh f({{0, 0, 0}, {1, 1, 0}}, {"1 2 1 1 1 2"});
      expect_error(error_of_file(f.name, true), "must lie on the x axis");
    }
    {
      const HandMadeMesh f(square, {"2 2 1 1 1 2 3", "2 2 1 1 2 5 3", "2 2 1 1 2 6 3"});
      expect_error(error_of_file(f.name, true), "that 3 cells share");
    }
    {
      // (0.5, 0) is a corner of the lower triangles only.
      const HandMadeMesh f({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.5, 0, 0}, {0.5, -1, 0}},
                           {"2 2 1 1 1 2 3", "2 2 1 1 1 5 4", "2 2 1 1 4 5 2"});
      expect_error(error_of_file(f.name, true), "hanging node at (0.5, 0)");
    }
    {
      const HandMadeMesh f({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {1, 1, 0}}, {"6 2 1 1 1 2 3 4 5 6"});
      expect_error(error_of_file(f.name, true), "Prism");
    }
    {
      const HandMadeMesh f({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {"2 2 1 1 1 2 9"});
      EXPECT_NE(error_of_file(f.name, true), "no error");
    }
    {
      auto apart = square;
      apart[3] = {3, 1, 0};
      const HandMadeMesh f(apart, {"2 2 1 1 1 2 3", "2 2 2 2 2 1 3", "2 2 1 1 4 5 6"});
      const auto         mesh = make_mesh<2>(file(f.name), true);
      ASSERT_EQ(mesh.warnings.size(), 2u);
      expect_error(mesh.warnings[0], "more than once");
      expect_error(mesh.warnings[1], "2 pieces");
    }
  }

  /// Sets file_access() for a while.
  struct AccessForTest
  {
    explicit AccessForTest(const FileAccess &access) { set_file_access(access); }
    ~AccessForTest() { set_file_access(before); }
    const FileAccess before = file_access();
  };

  TEST(Mesh, CellsComeAlongWithTheNamesOfAFile)
  {
    FileAccess access;
    access.read_ahead = true;
    const AccessForTest for_test(access);
    for (const std::string name : {"triangles-22.msh", "triangles-41-binary.msh"})
    {
      MeshSpec   spec = file(test_data + name);
      const auto outline = mesh_outline(spec);
      ASSERT_TRUE(outline.read_ahead && outline.read_ahead->cells);
      spec.read_ahead = outline.read_ahead;
      const double area = measure(make_mesh<2>(spec, true)).total;
      EXPECT_FALSE(outline.read_ahead->cells) << "they are taken";
      EXPECT_EQ(measure(make_mesh<2>(spec, true)).total, area) << "made again from the file";
      EXPECT_EQ(measure(make_mesh<2>(file(spec.file), true)).total, area);
      spec.read_ahead = mesh_outline(spec).read_ahead;
      expect_error(error_of([&] { make_mesh<2>(spec, false); }, 3), "the mesh has triangles; use element");
    }
    EXPECT_FALSE(mesh_outline(file(test_data + "square.geo")).read_ahead) << "the element decides on its cells";
    const HandMadeMesh prism({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {1, 1, 0}}, {"6 2 1 1 1 2 3 4 5 6"});
    EXPECT_FALSE(mesh_outline(file(prism.name)).read_ahead);
  }

  TEST(Mesh, NamesAreReadByTheFirstOfSeveralProcesses)
  {
    std::string answer;
    FileAccess  first, other;
    first.by_first_process = [&](const auto &read) { return answer = read(); };
    other.by_first_process = [&](const auto &) { return answer; };
    const auto on_both = [&](const std::string &path)
    {
      std::array<std::string, 2> said;
      for (const bool is_first : {true, false})
      {
        const AccessForTest for_test(is_first ? first : other);
        std::string         name;
        said[is_first ? 0 : 1] =
          error_of([&] { name = mesh_outline(file(path)).part_names.at(0); }, path.starts_with(test_data) ? 0 : 3) + name;
      }
      EXPECT_EQ(said[0], said[1]);
      return said[1];
    };
    on_both(test_data + "triangles-22.msh");
    EXPECT_FALSE(answer.empty());
    const MeshText damaged("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n7\n");
    expect_error(on_both(damaged.name), "failed");
  }

  TEST(Mesh, ImpossibleShapes)
  {
    expect_error(error_of([] { make_mesh<2>(box({0, 0}, {1, 0}, {1}), false); }), "no extent in y");
    expect_error(error_of([] { make_mesh<2>(box({0, 0}, {1, 1}, {1, 2, 3}), false); }), "'cells' has 3 numbers");
    expect_error(error_of([] { make_mesh<2>(box({0, 0}, {1, 1}, {0}), false); }), "at least 1");
    expect_error(error_of([] { make_mesh<2>(box({0, 0}, {1, 1, 1}, {1}), false); }), "3 coordinates");
    expect_error(error_of([] { make_mesh<2>(ball({0, 0}, 0), false); }), "must be > 0");
    expect_error(error_of([] { make_mesh<2>(ball({0, NAN}, 1), false); }), "finite");
    expect_error(error_of([] { make_mesh<2>(shell({0, 0}, 2, 1), false); }), "0 < inner < outer");
    expect_error(error_of([] { make_mesh<1>(shell({0}, 1, 2), false); }), "2-D or 3-D");
    expect_error(error_of([] { mesh_outline(box({0, 0, 0, 0}, {1, 1, 1, 1}, {1})); }), "dimension 4");
    expect_error(error_of([] { mesh_outline(MeshSpec()); }), "no mesh");
  }
} // namespace
