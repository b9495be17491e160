// Parts of a mesh for several processes, each made as on its own process, and what they have in common.
#include "unilateral/subdomain.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_tools.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace
{
  using namespace dealii;
  using namespace unilateral;

  template <int dim>
  MeshSpec ball()
  {
    MeshSpec spec;
    spec.source = MeshSpec::Source::ball;
    spec.center.assign(dim, 0.);
    spec.radius = 1;
    return spec;
  }

  template <int dim>
  MeshSpec box()
  {
    MeshSpec spec;
    spec.source = MeshSpec::Source::box;
    spec.box_lower.assign(dim, 0.);
    spec.box_upper.assign(dim, 1.);
    spec.cells = {3};
    return spec;
  }

  template <int dim>
  struct Part
  {
    Mesh<dim>                       mesh;
    std::unique_ptr<Subdomain<dim>> subdomain;
    DoFHandler<dim>                 dof_handler;
    SharedUnknowns                  shared;
    std::vector<Point<dim>>         x; ///< of the unknowns
    std::vector<unsigned>           component;
  };

  /// All parts of a mesh that is cut after @p before refinements and refined @p after times more.
  template <int dim>
  std::vector<Part<dim>>
  parts_of(const MeshSpec &spec, const FiniteElement<dim> &fe, const unsigned n, const unsigned before, const unsigned after)
  {
    std::vector<Part<dim>> parts(n);
    for (unsigned rank = 0; rank < n; ++rank)
    {
      auto &part = parts[rank];
      part.mesh = make_mesh<dim>(spec, false);
      part.mesh.triangulation->refine_global(before);
      part.subdomain = cut_out_subdomain(part.mesh, before, Processes(rank, n));
      part.mesh.triangulation->refine_global(after);
      part.dof_handler.reinit(*part.mesh.triangulation);
      part.dof_handler.distribute_dofs(fe);
      part.shared = unknowns_on_cuts(*part.subdomain, part.dof_handler);
      const MappingQ<dim> mapping(fe.degree);
      part.x.resize(part.dof_handler.n_dofs());
      DoFTools::map_dofs_to_support_points(mapping, part.dof_handler, part.x);
      part.component.resize(part.x.size());
      std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
      for (const auto &cell : part.dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        for (unsigned i = 0; i < dofs.size(); ++i)
          part.component[dofs[i]] = fe.system_to_component_index(i).first;
      }
    }
    return parts;
  }

  template <int dim>
  void check(const MeshSpec &spec, const FiniteElement<dim> &fe, const unsigned n, const unsigned before, const unsigned after)
  {
    const auto    parts = parts_of(spec, fe, n, before, after);
    std::uint64_t n_owned = 0, n_cells = 0;
    double        volume = 0;
    for (const auto &part : parts)
    {
      n_cells += part.mesh.triangulation->n_active_cells();
      n_owned += part.dof_handler.n_dofs() - part.shared.n_not_owned();
      volume += GridTools::volume(*part.mesh.triangulation, MappingQ<dim>(fe.degree));
      for (const auto &neighbor : part.shared.all_neighbors())
      {
        // The other has the same list, at the same places.
        const auto &other = parts[neighbor.rank];
        const auto  back = std::find_if(other.shared.all_neighbors().begin(), other.shared.all_neighbors().end(),
                                        [&](const auto &entry) { return entry.rank == part.subdomain->processes.rank(); });
        ASSERT_NE(back, other.shared.all_neighbors().end());
        ASSERT_EQ(back->dofs.size(), neighbor.dofs.size());
        for (std::size_t k = 0; k < neighbor.dofs.size(); ++k)
        {
          EXPECT_LT(part.x[neighbor.dofs[k]].distance(other.x[back->dofs[k]]), 1e-10);
          EXPECT_EQ(part.component[neighbor.dofs[k]], other.component[back->dofs[k]]);
        }
      }
    }
    // Nothing is missing, nothing counts twice.
    auto whole = make_mesh<dim>(spec, false);
    whole.triangulation->refine_global(before + after);
    DoFHandler<dim> dof_handler(*whole.triangulation);
    dof_handler.distribute_dofs(fe);
    EXPECT_EQ(n_cells, whole.triangulation->n_active_cells());
    EXPECT_EQ(n_owned, dof_handler.n_dofs());
    // deal.II's averages of points on a sphere depend on their order.
    EXPECT_NEAR(volume, GridTools::volume(*whole.triangulation, MappingQ<dim>(fe.degree)), 1e-5);
  }
} // namespace

TEST(Subdomain, SidesOfACutAgreeOnWhatTheyShare)
{
  check<2>(box<2>(), FE_Q<2>(1), 3, 1, 2);
  check<2>(box<2>(), FE_Q<2>(3), 4, 0, 1);
  check<2>(ball<2>(), FE_Q<2>(2), 3, 1, 1);
  check<3>(box<3>(), FE_Q<3>(1), 4, 0, 2);
  check<3>(ball<3>(), FE_Q<3>(2), 3, 1, 1);
  check<3>(ball<3>(), FESystem<3>(FE_Q<3>(3), 3), 2, 1, 0);
}

TEST(Subdomain, BoundaryKeepsItsNamesAndTheCutGetsOneOfItsOwn)
{
  const auto parts = parts_of<2>(box<2>(), FE_Q<2>(1), 3, 1, 1);
  double     length = 0;
  for (const auto &part : parts)
  {
    ASSERT_EQ(part.mesh.part_names.size(), 5u);
    for (const auto &cell : part.mesh.triangulation->active_cell_iterators())
      for (const auto face : cell->face_indices())
        if (cell->face(face)->at_boundary())
        {
          const Point<2> x = cell->face(face)->center();
          const bool     outside = x[0] < 1e-9 || x[1] < 1e-9 || x[0] > 1 - 1e-9 || x[1] > 1 - 1e-9;
          EXPECT_EQ(part.mesh.part_names[cell->face(face)->boundary_id()].empty(), !outside);
          if (part.mesh.part_names[cell->face(face)->boundary_id()] == "left")
            length += cell->face(face)->measure();
        }
  }
  EXPECT_NEAR(length, 1, 1e-12);
}

TEST(Subdomain, PartsAreEquallyLarge)
{
  for (const unsigned n : {2u, 3u, 5u, 7u})
    for (const auto &part : parts_of<2>(ball<2>(), FE_Q<2>(1), n, 3, 0))
      EXPECT_NEAR(part.mesh.triangulation->n_active_cells(), 12 * 64. / n, 3);
}

TEST(Processes, AloneTheyReturnWhatTheyGet)
{
  const Processes alone;
  EXPECT_TRUE(alone.alone());
  EXPECT_EQ(alone.sum(2.5), 2.5);
  EXPECT_EQ(alone.max(-1.), -1.);
  EXPECT_EQ(alone.gather(std::vector<int>{3, 1}), (std::vector<int>{3, 1}));
  EXPECT_EQ(alone.nth_smallest({3., 1., 2.}, 1), 2.);
}
