// The mesh that processes read together, here one alone, beside the one that Gmsh reads.
#include "unilateral/mesh/make_mesh.h"
#include "unilateral/mesh/named_parts.h"
#include "unilateral/mesh/part_of_mesh.h"
#include "unilateral/mesh/share_of_box.h"

#include "block_of_cells.h"
#include "text_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <string>

namespace
{
  using namespace unilateral;

  MeshDescription file(const std::string &name)
  {
    MeshDescription spec;
    spec.source = MeshDescription::Source::file;
    spec.file = name;
    return spec;
  }

  template <int dim>
  std::optional<ReceivedPart<dim>> read_in_pieces(const std::string &name, const bool simplices = true)
  {
    return part_of_mesh<dim>(file(name), simplices, Processes(), 1);
  }

  /// Of the cells of each region and the faces of each part.
  template <int dim>
  std::map<std::string, double> measures(const Mesh<dim> &mesh)
  {
    std::map<std::string, double> result;
    for (const auto &cell : mesh.triangulation->active_cell_iterators())
    {
      result["region " + mesh.region_names.at(cell->material_id())] += cell->measure();
      for (const auto f : cell->face_indices())
        if (cell->at_boundary(f))
          result["part " + mesh.part_names.at(cell->face(f)->boundary_id())] += cell->face(f)->measure();
    }
    return result;
  }

  /// The nodes of degree 2 of a cell, by the middle of the vertices that each lies between.
  template <int dim>
  std::vector<std::pair<dealii::Point<dim>, dealii::Point<dim>>>
  curved_nodes(const Mesh<dim> &mesh, const typename dealii::Triangulation<dim>::active_cell_iterator &cell)
  {
    std::vector<std::pair<dealii::Point<dim>, dealii::Point<dim>>> result;
    const auto                                                     nodes = mesh.curved_cells->nodes(cell);
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      const auto         around = vertices_around<dim>(cell, mesh.curved_cells->unit_nodes()[i]);
      dealii::Point<dim> middle;
      for (const unsigned v : around)
        middle += mesh.triangulation->get_vertices()[v] / double(around.size());
      result.emplace_back(middle, nodes[i]);
    }
    return result;
  }

  template <int dim>
  void expect_the_same_mesh(const MeshDescription &spec, const bool simplices, const PartsByPlace &parts = {})
  {
    const auto  part = part_of_mesh<dim>(spec, simplices, Processes(), 1, parts);
    auto        whole = make_mesh<dim>(spec, simplices);
    Diagnostics diagnostics;
    name_parts(whole, parts, diagnostics);
    EXPECT_TRUE(diagnostics.all().empty());
    ASSERT_TRUE(part.has_value());
    auto names = part->mesh.part_names;
    EXPECT_EQ(names.back(), ""); // of cuts
    names.pop_back();
    EXPECT_EQ(names, whole.part_names);
    EXPECT_EQ(part->mesh.region_names, whole.region_names);
    EXPECT_EQ(part->mesh.warnings, whole.warnings);
    EXPECT_EQ(part->mesh.curved, whole.curved);
    EXPECT_EQ(bool(part->mesh.curved_cells), bool(whole.curved_cells));
    EXPECT_LT(part->subdomain->some_point.distance(whole.triangulation->begin_active()->center()), 1e-14);
    ASSERT_EQ(part->mesh.triangulation->n_active_cells(), whole.triangulation->n_active_cells());
    const auto of_part = measures(part->mesh), of_whole = measures(whole);
    ASSERT_EQ(of_part.size(), of_whole.size());
    for (const auto &[what, measure] : of_whole)
      EXPECT_NEAR(of_part.at(what), measure, 1e-12) << what;
    auto cell = part->mesh.triangulation->begin_active();
    for (const auto &other : whole.triangulation->active_cell_iterators())
    {
      EXPECT_LT(cell->center().distance(other->center()), 1e-14);
      if (whole.curved_cells)
      {
        for (const auto &[middle, node] : curved_nodes(whole, other))
        {
          unsigned n_found = 0;
          for (const auto &[same_middle, same_node] : curved_nodes(part->mesh, cell))
            if (middle.distance(same_middle) < 1e-12)
            {
              ++n_found;
              EXPECT_LT(node.distance(same_node), 1e-12);
            }
          EXPECT_EQ(n_found, 1u);
        }
      }
      ++cell;
    }
  }

  template <int dim>
  void expect_the_same_mesh(const std::string &name, const bool simplices = true)
  {
    SCOPED_TRACE(name);
    expect_the_same_mesh<dim>(file(name), simplices);
  }

  bool is_read_in_pieces(const BlockOfCells &block, const bool simplices = true)
  {
    const TextFile text(".msh", block.text());
    return read_in_pieces<3>(text.name, simplices).has_value();
  }
} // namespace

TEST(PartOfMesh, IsTheMeshThatGmshReads)
{
  expect_the_same_mesh<2>(PROJECT_DIR "/tests/data/triangles-41.msh");
  expect_the_same_mesh<2>(PROJECT_DIR "/tests/data/triangles-41-binary.msh");
  expect_the_same_mesh<3>(PROJECT_DIR "/tests/data/tetrahedra-41.msh");
  expect_the_same_mesh<2>(PROJECT_DIR "/examples/data/plate-with-hole.msh");
  expect_the_same_mesh<2>(PROJECT_DIR "/tests/data/quadrilaterals-41.msh", false);
  expect_the_same_mesh<3>(PROJECT_DIR "/tests/data/hexahedra-41.msh", false);
  expect_the_same_mesh<2>(PROJECT_DIR "/tests/data/triangles-22.msh");
  expect_the_same_mesh<2>(PROJECT_DIR "/tests/data/triangles-22-binary.msh");
  expect_the_same_mesh<3>(PROJECT_DIR "/tests/data/tetrahedra-22.msh");
  expect_the_same_mesh<3>(PROJECT_DIR "/tests/data/hexahedra-22.msh", false);
}

TEST(PartOfMesh, IsABoxAsTheLibraryMakesIt)
{
  for (const bool simplices : {false, true})
  {
    expect_the_same_mesh<2>(box({-1, 2}, {0.5, 3}, {5, 4}), simplices);
    expect_the_same_mesh<2>(box({0, 0}, {1, 1}, {3}), simplices);
    expect_the_same_mesh<3>(box({0, -1, 2}, {0.7, 1, 5}, {4, 3, 5}), simplices);
    expect_the_same_mesh<3>(box({0, 0, 0}, {1, 1, 1}, {1, 2, 1}), simplices);
  }
}

TEST(PartOfMesh, HasPartsByPlace)
{
  using dealii::Point;
  const FieldFunction low([](const Point<3> &p) { return double(p[2] < 2 && p[0] < 0.5); }),
    right([](const Point<3> &p) { return double(p[0] > 1 - 1e-9); }), everywhere([](const Point<3> &) { return 1.; });
  for (const bool simplices : {false, true})
  {
    const auto mesh = box({0, 0, 0}, {1, 2, 5}, {4, 3, 5});
    expect_the_same_mesh<3>(mesh, simplices, {{"foot", low}, {"top", right}});
    expect_the_same_mesh<3>(mesh, simplices, {{"all", everywhere}, {"foot", low}});
    const FieldFunction within_cells([](const Point<3> &p) { return double(p[0] < 0.6); }), nowhere([](const Point<3> &) { return 0.; });
    const FieldFunction without_values([](const Point<3> &p) -> double
                                       { return p[0] > 0.5 ? throw InputError({}, "no value", MessageName("out-of-range")) : 1.; });
    for (const auto &where : {within_cells, nowhere, without_values}) // what name_parts() warns of, or refuses
      EXPECT_FALSE(part_of_mesh<3>(mesh, simplices, Processes(), 1, {{"part", where}})) << simplices;
  }
}

TEST(ShareOfBox, IsCutBetweenLayers)
{
  const auto sizes = [](const std::vector<unsigned> &cells, const unsigned n_processes)
  {
    std::vector<std::uint32_t> ids(cells[0] * cells[1] * cells[2]);
    std::iota(ids.begin(), ids.end(), 0);
    const ShareOfBox<3>   share(box({0, 0, 0}, {1, 1, 1}, cells), false, Processes(0, n_processes));
    std::vector<unsigned> n_cells(n_processes, 0);
    for (const unsigned owner : share.owners(ids))
      ++n_cells.at(owner);
    return n_cells;
  };
  EXPECT_EQ(sizes({20, 20, 22}, 3), (std::vector<unsigned>{20 * 20 * 7, 20 * 10 * 15, 20 * 10 * 15}));
  EXPECT_EQ(sizes({8, 4, 4}, 4), (std::vector<unsigned>{32, 32, 32, 32}));
  EXPECT_EQ(sizes({5, 4, 4}, 2), (std::vector<unsigned>{0, 0})) << "3 and 2 layers are too uneven";
}

TEST(PartOfMesh, IsNotMadeOfABoxThatIsNone)
{
  for (const auto &spec : {box({0, 0}, {0, 1}, {4}), box({0, 0}, {1, 1}, {4, 0}), box({0, 0}, {1, 1}, {4, 4, 4}), box({0}, {1}, {4}),
                           box({0, 0}, {1, 1}, {100000, 100000})})
    EXPECT_FALSE(part_of_mesh<2>(spec, false, Processes(), 1));
}

TEST(PartOfMesh, OfHexahedraMayBeCurved)
{
  for (const unsigned order : {1u, 2u})
  {
    BlockOfHexahedra block(3, order);
    expect_the_same_mesh<3>(TextFile(".msh", block.text()).name, false);
    for (auto &x : block.nodes)
      x = {x[0] + 0.05 * std::sin(5 * x[1] * x[2]), x[1] + 0.1 * x[0] * x[2], x[2] + 0.1 * std::sin(3 * x[0]) * (1 - x[2]) * x[1]};
    const TextFile text(".msh", block.text());
    expect_the_same_mesh<3>(text.name, false);
    EXPECT_EQ(read_in_pieces<3>(text.name, false)->mesh.curved, order == 2);
  }
}

TEST(PartOfMesh, OfHexahedraHasMistakes)
{
  const BlockOfHexahedra block(2);
  EXPECT_TRUE(is_read_in_pieces(block, false));
  EXPECT_FALSE(is_read_in_pieces(block, true));
  EXPECT_FALSE(is_read_in_pieces(BlockOfTetrahedra(2), false));

  auto folded = block; // its inner corner lies outside of the block
  for (auto &x : folded.nodes)
    if (x == std::array<double, 3>{0.5, 0.5, 0.5})
      x = {1.5, 0.5, 0.5};
  EXPECT_FALSE(is_read_in_pieces(folded, false));

  auto pieces = block;
  for (auto cell : block.cells)
  {
    for (unsigned &node : cell)
      node += block.nodes.size();
    pieces.cells.push_back(cell);
  }
  for (const auto &x : block.nodes)
    pieces.nodes.push_back({x[0] + 2, x[1], x[2]});
  EXPECT_FALSE(is_read_in_pieces(pieces, false));
}

TEST(PartOfMesh, OfOrder2MayBeCurved)
{
  BlockOfTetrahedra block(2, 2);
  expect_the_same_mesh<3>(TextFile(".msh", block.text()).name);
  for (auto &x : block.nodes)
    x[2] += 0.1 * std::sin(3 * x[0]) * (1 - x[2]);
  const TextFile text(".msh", block.text());
  expect_the_same_mesh<3>(text.name);
  EXPECT_TRUE(read_in_pieces<3>(text.name)->mesh.curved);
}

TEST(PartOfMesh, HasTheFirstNameOfAFace)
{
  BlockOfTetrahedra block(2);
  block.faces["another name of x-"] = block.faces["x-"];
  block.faces["inside"] = {{block.cells[20].begin(), block.cells[20].begin() + 3}};
  expect_the_same_mesh<3>(TextFile(".msh", block.text()).name);
}

TEST(PartOfMesh, IsNotMadeOfAMeshOfWhichThereIsMoreToSay)
{
  const BlockOfTetrahedra block(2);
  EXPECT_TRUE(is_read_in_pieces(block));
  auto repeated = block;
  repeated.cells.push_back(block.cells[7]);
  EXPECT_FALSE(is_read_in_pieces(repeated));

  auto flat = block;
  flat.cells.push_back({0, 1, 2, 4});
  EXPECT_FALSE(is_read_in_pieces(flat));

  auto folded = block; // another cell on the inner side of a face of the boundary
  folded.cells.push_back(block.faces.at("x-")[0]);
  folded.cells.back().push_back(26);
  EXPECT_FALSE(is_read_in_pieces(folded));

  auto pieces = block, overlapping = block;
  for (const auto &cell : block.cells)
  {
    std::vector<unsigned> copy;
    for (const unsigned node : cell)
      copy.push_back(node + block.nodes.size());
    pieces.cells.push_back(copy);
    overlapping.cells.push_back(copy);
  }
  for (const auto &x : block.nodes)
  {
    pieces.nodes.push_back({x[0] + 2, x[1], x[2]});
    overlapping.nodes.push_back({x[0] + 0.4, x[1], x[2]});
  }
  EXPECT_FALSE(is_read_in_pieces(pieces));
  EXPECT_FALSE(is_read_in_pieces(overlapping));

  auto       hanging = block; // the first cell is halved, not its neighbours
  const auto cut = block.cells[0];
  hanging.nodes.push_back({0, 0, 0});
  for (unsigned d = 0; d < 3; ++d)
    hanging.nodes.back()[d] = (block.nodes[cut[0]][d] + block.nodes[cut[1]][d]) / 2;
  hanging.cells[0][0] = hanging.nodes.size() - 1;
  hanging.cells.push_back(cut);
  hanging.cells.back()[1] = hanging.nodes.size() - 1;
  EXPECT_FALSE(is_read_in_pieces(hanging));

  auto incomplete = block;
  incomplete.cells.push_back({0, 1, 2, 1000});
  EXPECT_FALSE(is_read_in_pieces(incomplete));
}

TEST(PartOfMesh, IsNotMadeOfAFewCells)
{
  const BlockOfTetrahedra block(2);
  const TextFile          text(".msh", block.text());
  EXPECT_TRUE(part_of_mesh<3>(file(text.name), true, Processes(), 48).has_value());
  EXPECT_FALSE(part_of_mesh<3>(file(text.name), true, Processes(), 49).has_value());
  EXPECT_FALSE(part_of_mesh<2>(file(text.name), true, Processes(), 1).has_value());
}
