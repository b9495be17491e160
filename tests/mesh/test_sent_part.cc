// Parts that another process has made, beside those that a process cuts out itself.
#include "unilateral/mesh/sent_part.h"

#include "unilateral/mesh/make_mesh.h"
#include "unilateral/spaces/unknowns_on_cuts.h"

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace
{
  using namespace dealii;
  using namespace unilateral;

  template <int dim>
  std::vector<SharedUnknowns::Entry> shared_entries(const Subdomain<dim> &subdomain, const Mesh<dim> &mesh, const FiniteElement<dim> &fe)
  {
    DoFHandler<dim> nodes(*mesh.triangulation);
    nodes.distribute_dofs(fe);
    return unknowns_on_cuts(subdomain, nodes, {}).entries();
  }

  /// Cells, names, boundary and what is shared with whom.
  template <int dim>
  void expect_same_parts(const MeshDescription &spec, const FiniteElement<dim> &fe, const unsigned n)
  {
    const bool      simplex = fe.reference_cell().is_simplex();
    const Mesh<dim> whole = make_mesh<dim>(spec, simplex);
    ASSERT_TRUE(can_be_sent(whole));
    const Division division = divide(*whole.triangulation, n);
    for (unsigned rank = 0; rank < n; ++rank)
    {
      const Processes processes(rank, n);
      const auto      received = unpack_part<dim>({PartsToSend<dim>(whole, division).bytes_for(rank)}, processes);
      Mesh<dim>       own = make_mesh<dim>(spec, simplex);
      const auto      cut_out = cut_out_subdomain(own, 0, processes, division);
      EXPECT_EQ(received.mesh.part_names, own.part_names);
      EXPECT_EQ(received.mesh.region_names, own.region_names);
      EXPECT_EQ(received.subdomain->vertex, cut_out->vertex);
      EXPECT_EQ(received.subdomain->ids_of_vertices, cut_out->ids_of_vertices);
      EXPECT_EQ(received.subdomain->some_point, cut_out->some_point);
      ASSERT_EQ(received.mesh.triangulation->n_active_cells(), own.triangulation->n_active_cells());
      EXPECT_EQ(bool(received.mesh.curved_cells), bool(own.curved_cells));
      auto cell = received.mesh.triangulation->begin_active();
      for (const auto &other : own.triangulation->active_cell_iterators())
      {
        EXPECT_EQ(cell->material_id(), other->material_id());
        for (const unsigned v : other->vertex_indices())
          EXPECT_EQ(cell->vertex(v), other->vertex(v));
        for (const auto face : other->face_indices())
        {
          ASSERT_EQ(cell->at_boundary(face), other->at_boundary(face));
          if (other->at_boundary(face))
            EXPECT_EQ(cell->face(face)->boundary_id(), other->face(face)->boundary_id());
        }
        if (own.curved_cells)
        {
          const auto nodes = received.mesh.curved_cells->nodes(cell), others = own.curved_cells->nodes(other);
          for (std::size_t k = 0; k < others.size(); ++k)
            EXPECT_LT(nodes[k].distance(others[k]), 1e-13);
        }
        ++cell;
      }
      const auto of_received = shared_entries<dim>(*received.subdomain, received.mesh, fe), of_own = shared_entries<dim>(*cut_out, own, fe);
      ASSERT_EQ(of_received.size(), of_own.size());
      EXPECT_GT(of_own.size(), 0u);
      for (std::size_t k = 0; k < of_own.size(); ++k)
      {
        EXPECT_EQ(of_received[k].dof, of_own[k].dof);
        EXPECT_EQ(of_received[k].ranks, of_own[k].ranks);
      }
    }
  }

  MeshDescription file(const std::string &name)
  {
    MeshDescription spec;
    spec.source = MeshDescription::Source::file;
    spec.file = PROJECT_DIR "/tests/data/" + name;
    return spec;
  }
} // namespace

namespace
{
  /// What find_neighbor_parts() says, from the mesh as a whole: vertices have the numbers that they have there.
  template <int dim>
  NeighborParts
  beyond_cuts(const Subdomain<dim> &part, const Division &before, const Division &after, const std::vector<std::uint64_t> &new_ids)
  {
    NeighborParts neighbors;
    neighbors.vertex_ids = part.ids_of_vertices;
    for (unsigned v = 0; v < part.ids_of_vertices.size(); ++v)
      for (const unsigned cell : part.cells_at_vertex[part.ids_of_vertices[v]])
        if (before.owner[cell] != part.processes.rank())
          neighbors.cells.push_back({v, {new_ids[cell], after.owner[cell]}});
    return neighbors;
  }

  /// Cells by their centres, with region, and boundary ids of faces by theirs.
  template <int dim>
  std::set<std::vector<double>> description(const Triangulation<dim> &triangulation)
  {
    std::set<std::vector<double>> entries;
    const auto                    add = [&](const Point<dim> &x, const double what)
    {
      std::vector<double> entry;
      for (unsigned d = 0; d < dim; ++d)
        entry.push_back(x[d]);
      entry.push_back(what);
      entries.insert(entry);
    };
    for (const auto &cell : triangulation.active_cell_iterators())
    {
      add(cell->center(), -1. - cell->material_id());
      for (const auto face : cell->face_indices())
        if (cell->at_boundary(face))
          add(cell->face(face)->center(), cell->face(face)->boundary_id());
    }
    return entries;
  }

  /// Parts that are divided anew are those of the mesh as a whole, divided so at once.
  template <int dim>
  void expect_other_parts(const MeshDescription &spec, const FiniteElement<dim> &fe, const unsigned n)
  {
    const bool          simplex = fe.reference_cell().is_simplex();
    const Mesh<dim>     whole = make_mesh<dim>(spec, simplex);
    const Division      before = divide(*whole.triangulation, n);
    std::vector<double> weights;
    for (const auto &cell : whole.triangulation->active_cell_iterators())
      weights.push_back(1 + 20 * std::pow(cell->center()[0], 4));
    const Division after = divide(*whole.triangulation, n, weights);
    EXPECT_NE(after.owner, before.owner);

    std::vector<std::uint64_t> first_cell(n + 1, 0), new_ids(before.owner.size());
    for (unsigned rank = 0; rank < n; ++rank)
    {
      first_cell[rank + 1] = first_cell[rank];
      for (unsigned cell = 0; cell < before.owner.size(); ++cell)
        if (before.owner[cell] == rank)
          new_ids[cell] = first_cell[rank + 1]++;
    }
    std::vector<std::vector<std::vector<char>>> messages(n); // [to][from]
    for (unsigned from = 0; from < n; ++from)
    {
      Mesh<dim>             mesh = make_mesh<dim>(spec, simplex);
      const auto            subdomain = cut_out_subdomain(mesh, 0, Processes(from, n), before);
      std::vector<unsigned> owner;
      for (const unsigned cell : subdomain->own_cells)
        owner.push_back(after.owner[cell]);
      const PartsToSend<dim> parts(mesh, *subdomain, first_cell[from], owner, beyond_cuts(*subdomain, before, after, new_ids));
      for (unsigned to = 0; to < n; ++to)
        messages[to].push_back(parts.bytes_for(to));
    }
    for (unsigned rank = 0; rank < n; ++rank)
    {
      const auto received = unpack_part<dim>(messages[rank], Processes(rank, n));
      Mesh<dim>  own = make_mesh<dim>(spec, simplex);
      const auto cut_out = cut_out_subdomain(own, 0, Processes(rank, n), after);
      EXPECT_EQ(received.mesh.part_names, own.part_names);
      EXPECT_EQ(received.subdomain->some_point, cut_out->some_point);
      EXPECT_EQ(description(*received.mesh.triangulation), description(*own.triangulation));
      const auto of_received = shared_entries<dim>(*received.subdomain, received.mesh, fe), of_own = shared_entries<dim>(*cut_out, own, fe);
      ASSERT_EQ(of_received.size(), of_own.size());
      std::multiset<std::vector<unsigned>> ranks_of_received, ranks_of_own;
      for (std::size_t k = 0; k < of_own.size(); ++k)
      {
        ranks_of_received.insert(of_received[k].ranks);
        ranks_of_own.insert(of_own[k].ranks);
      }
      EXPECT_EQ(ranks_of_received, ranks_of_own);
    }
  }
} // namespace

TEST(SentPart, ComesFromAllThatHadItsCells)
{
  expect_other_parts<2>(box({0, 0}, {2, 1}, {7, 5}), FE_SimplexP<2>(2), 2);
  expect_other_parts<2>(box({0, 0}, {2, 1}, {9, 8}), FE_Q<2>(2), 4);
  expect_other_parts<3>(box({0, 0, 0}, {1, 1, 1}, {5, 4, 4}), FE_SimplexP<3>(2), 3);
  expect_other_parts<2>(file("triangles-order-2.msh"), FE_SimplexP<2>(2), 3);
}

TEST(SentPart, IsThePartThatAProcessCutsOutItself)
{
  expect_same_parts<2>(box({0, 0}, {2, 1}, {7, 5}), FE_Q<2>(2), 3);
  expect_same_parts<2>(box({0, 0}, {2, 1}, {7, 5}), FE_SimplexP<2>(2), 2);
  expect_same_parts<3>(box({0, 0, 0}, {1, 1, 1}, {4, 3, 3}), FE_SimplexP<3>(2), 3);
  expect_same_parts<3>(file("hexahedra-41.msh"), FE_Q<3>(1), 2);
}

TEST(SentPart, HasTheNodesOfCurvedCells)
{
  expect_same_parts<2>(file("triangles-order-2.msh"), FE_SimplexP<2>(2), 3);
}

TEST(SentPart, IsNotForCellsThatFollowAManifold)
{
  EXPECT_FALSE(can_be_sent(make_mesh<2>(ball({0, 0}, 1), false)));
}
