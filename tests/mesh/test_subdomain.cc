// Parts of a mesh for several processes, each made as on its own process, and what they have in common.
#include "unilateral/mesh/make_mesh.h"
#include "unilateral/mesh/refinement_at_cuts.h"
#include "unilateral/mesh/simplex_refinement.h"
#include "unilateral/spaces/simplex_element.h"
#include "unilateral/spaces/unknowns_on_cuts.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_tools.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <memory>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

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

  /// How to refine simplices, and what that has cut.
  struct SimplexRefinement
  {
    std::vector<CornerOrder> orders;
    std::vector<CutLines>    lines_cut;
  };

  template <int dim>
  void refine(Mesh<dim> &mesh, SimplexRefinement &simplices, const unsigned times)
  {
    if (!mesh.simplex)
      return mesh.triangulation->refine_global(times);
    for (unsigned k = 0; k < times; ++k)
    {
      auto refined = refine_simplices(*mesh.triangulation, simplices.orders);
      mesh.triangulation = std::move(refined.triangulation);
      simplices.orders = std::move(refined.corner_orders);
      simplices.lines_cut.push_back(std::move(refined.cut_lines));
    }
  }

  template <int dim>
  std::unique_ptr<Mapping<dim>> mapping_of(const FiniteElement<dim> &fe)
  {
    if (fe.reference_cell().is_simplex())
      return std::make_unique<MappingFE<dim>>(FE_SimplexP<dim>(1));
    return std::make_unique<MappingQ<dim>>(fe.degree);
  }

  /// All parts of a mesh that is cut after @p before refinements and refined @p after times more.
  template <int dim>
  std::vector<Part<dim>>
  parts_of(const MeshSpec &spec, const FiniteElement<dim> &fe, const unsigned n, const unsigned before, const unsigned after)
  {
    const bool             simplex = fe.reference_cell().is_simplex();
    std::vector<Part<dim>> parts(n);
    for (unsigned rank = 0; rank < n; ++rank)
    {
      auto &part = parts[rank];
      part.mesh = make_mesh<dim>(spec, simplex);
      SimplexRefinement simplices;
      if (simplex)
        simplices.orders = orders_by_shortest_diagonal(*part.mesh.triangulation);
      refine(part.mesh, simplices, before);
      part.subdomain = cut_out_subdomain(part.mesh, before, Processes(rank, n), divide(*part.mesh.triangulation, n));
      simplices.lines_cut.clear();
      if (simplex)
      {
        std::vector<CornerOrder> orders;
        for (const unsigned cell : part.subdomain->own_cells)
          orders.push_back(simplices.orders[cell]);
        simplices.orders = orders;
      }
      refine(part.mesh, simplices, after);
      part.dof_handler.reinit(*part.mesh.triangulation);
      part.dof_handler.distribute_dofs(fe);
      match_line_nodes(part.dof_handler);
      part.shared = unknowns_on_cuts(*part.subdomain, part.dof_handler, simplices.lines_cut);
      part.x.resize(part.dof_handler.n_dofs());
      DoFTools::map_dofs_to_support_points(*mapping_of(fe), part.dof_handler, part.x);
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
    // New nodes in a ball come out of an iteration that ends there.
    const double  tolerance = spec.source == MeshSpec::Source::ball ? 1e-10 : 1e-13;
    const auto    parts = parts_of(spec, fe, n, before, after);
    std::uint64_t n_owned = 0, n_cells = 0;
    double        volume = 0;
    for (const auto &part : parts)
    {
      n_cells += part.mesh.triangulation->n_active_cells();
      n_owned += part.dof_handler.n_dofs() - part.shared.n_not_owned();
      volume += GridTools::volume(*part.mesh.triangulation, *mapping_of(fe));
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
          EXPECT_LT(part.x[neighbor.dofs[k]].distance(other.x[back->dofs[k]]), tolerance);
          EXPECT_EQ(part.component[neighbor.dofs[k]], other.component[back->dofs[k]]);
        }
      }
    }
    // Nothing is missing, nothing counts twice.
    const bool        simplex = fe.reference_cell().is_simplex();
    auto              whole = make_mesh<dim>(spec, simplex);
    SimplexRefinement simplices;
    if (simplex)
      simplices.orders = orders_by_shortest_diagonal(*whole.triangulation);
    refine(whole, simplices, before + after);
    DoFHandler<dim> dof_handler(*whole.triangulation);
    dof_handler.distribute_dofs(fe);
    EXPECT_EQ(n_cells, whole.triangulation->n_active_cells());
    EXPECT_EQ(n_owned, dof_handler.n_dofs());
    EXPECT_NEAR(volume, GridTools::volume(*whole.triangulation, *mapping_of(fe)), std::max(tolerance, simplex ? 1e-10 : 1e-12));
  }

  /// The largest distance of a point of a cell from where it is in the whole mesh.
  template <int dim>
  double displacement_of_cells(const MeshSpec &spec, const unsigned degree, const unsigned n, const unsigned before, const unsigned after)
  {
    auto whole = make_mesh<dim>(spec, false);
    whole.triangulation->refine_global(before);
    const unsigned n_coarse = whole.triangulation->n_active_cells();
    whole.triangulation->refine_global(after);
    const MappingQ<dim>   mapping(degree);
    const FE_Nothing<dim> nothing;
    const QGauss<dim>     rule(degree + 1);
    FEValues<dim> in_whole(mapping, nothing, rule, update_quadrature_points), in_part(mapping, nothing, rule, update_quadrature_points);
    double        largest = 0;
    const std::function<void(const typename Triangulation<dim>::cell_iterator &, const typename Triangulation<dim>::cell_iterator &)>
      compare = [&](const auto &a, const auto &b)
    {
      ASSERT_EQ(a->has_children(), b->has_children());
      for (unsigned c = 0; c < a->n_children(); ++c)
        compare(a->child(c), b->child(c));
      if (a->has_children())
        return;
      in_whole.reinit(a);
      in_part.reinit(b);
      for (unsigned q = 0; q < rule.size(); ++q)
        largest = std::max(largest, in_whole.quadrature_point(q).distance(in_part.quadrature_point(q)));
    };
    for (const auto &part : parts_of(spec, FE_Q<dim>(1), n, before, after))
    {
      // Cells of a level are numbered in the same way, however often they have been refined since.
      std::vector<typename Triangulation<dim>::cell_iterator> of_level(whole.triangulation->begin(before),
                                                                       whole.triangulation->end(before));
      EXPECT_EQ(of_level.size(), n_coarse);
      for (auto cell = part.mesh.triangulation->begin(0); cell != part.mesh.triangulation->end(0); ++cell)
        compare(of_level[part.subdomain->own_cells[cell->index()]], cell);
    }
    return largest;
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

TEST(Subdomain, SidesOfACutThroughSimplicesAgreeOnWhatTheyShare)
{
  check<2>(box<2>(), FE_SimplexP<2>(1), 3, 1, 2);
  check<2>(box<2>(), FE_SimplexP<2>(2), 4, 0, 0);
  check<2>(box<2>(), *make_simplex_element<2>(3), 4, 1, 1);
  check<3>(box<3>(), FE_SimplexP<3>(1), 4, 0, 2);
  check<3>(box<3>(), FESystem<3>(FE_SimplexP<3>(2), 3), 3, 0, 1);
  check<3>(box<3>(), FE_SimplexP<3>(2), 5, 1, 0);
}

TEST(Subdomain, CurvedCellsLieWhereTheyLieInTheWhole)
{
  EXPECT_LT(displacement_of_cells<2>(ball<2>(), 3, 3, 1, 1), 1e-10);
  EXPECT_LT(displacement_of_cells<3>(ball<3>(), 2, 2, 0, 1), 1e-10);
  EXPECT_LT(displacement_of_cells<3>(ball<3>(), 3, 3, 1, 0), 1e-10);
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
      EXPECT_NEAR(part.mesh.triangulation->n_active_cells(), 12 * 64. / n, 3 + 0.05 * 12 * 64 / n);
}

namespace
{
  /// How many vertices processes have besides the first one each, and the most cells of one.
  std::pair<std::size_t, std::size_t> cost(const Subdomain<2> &subdomain, const std::vector<unsigned> &owner, const unsigned n)
  {
    std::size_t              further = 0;
    std::vector<std::size_t> n_cells(n, 0);
    for (const auto &cells : subdomain.cells_at_vertex)
    {
      std::set<unsigned> owners;
      for (const unsigned cell : cells)
        owners.insert(owner[cell]);
      further += owners.empty() ? 0 : owners.size() - 1;
    }
    for (const unsigned part : owner)
      ++n_cells[part];
    return {further, *std::max_element(n_cells.begin(), n_cells.end())};
  }
} // namespace

TEST(Subdomain, CutsAreNotLongerThanThoseOfBisection)
{
  for (const MeshSpec &spec : {ball<2>(), box<2>()})
    for (const unsigned n : {2u, 3u, 4u, 7u, 16u})
    {
      const auto            parts = parts_of<2>(spec, FE_Q<2>(1), n, 4, 0);
      const auto           &subdomain = *parts[0].subdomain;
      std::vector<Point<2>> centers;
      for (const auto &cell : subdomain.whole.triangulation->active_cell_iterators())
        centers.push_back(cell->center());
      const auto [further, largest] = cost(subdomain, subdomain.division.owner, n);
      const auto [of_bisection, largest_of_bisection] = cost(subdomain, bisect(centers, n), n);
      EXPECT_LE(further, of_bisection) << n;
      EXPECT_LE(largest, 1.05 * centers.size() / n + 1) << n;
      if (std::getenv("UNILATERAL_SHOW"))
        std::cout << centers.size() << " cells, " << n << " parts: " << further << " shared vertices, by bisection " << of_bisection
                  << "; most cells " << largest << ", " << largest_of_bisection << "\n";
    }
}

namespace
{
  /// A mesh of which a ball around @p centre is refined @p times, and the neighbourhood of cuts with it until they conform.
  template <int dim>
  std::pair<Mesh<dim>, Division> refined_in_places(const Point<dim> &centre, const unsigned times, const unsigned n_parts)
  {
    auto mesh = make_mesh<dim>(box<dim>(), false);
    mesh.triangulation->refine_global(1);
    Division   division;
    const auto refine = [&](std::vector<bool> chosen)
    {
      refine_alike_at_cuts(*mesh.triangulation, division, chosen);
      for (const auto &cell : mesh.triangulation->active_cell_iterators())
        if (chosen[cell->active_cell_index()])
          cell->set_refine_flag();
      mesh.triangulation->execute_coarsening_and_refinement();
    };
    for (unsigned k = 0; k < times; ++k)
    {
      for (const auto &cell : mesh.triangulation->active_cell_iterators())
        if (cell->center().distance(centre) < 0.4 / (1 << k))
          cell->set_refine_flag();
      mesh.triangulation->execute_coarsening_and_refinement();
    }
    division = divide(*mesh.triangulation, n_parts);
    for (unsigned k = 0; k < 10 && !conforms_at_cuts(*mesh.triangulation, division); ++k)
      refine(std::vector<bool>(mesh.triangulation->n_active_cells(), false));
    EXPECT_TRUE(conforms_at_cuts(*mesh.triangulation, division));
    return {std::move(mesh), division};
  }

  template <int dim>
  void check_in_places(const FiniteElement<dim> &fe, const unsigned n, const unsigned times)
  {
    Point<dim> centre;
    centre[0] = 0.3;
    auto            whole = refined_in_places<dim>(centre, times, n).first;
    DoFHandler<dim> dof_handler(*whole.triangulation);
    dof_handler.distribute_dofs(fe);
    std::vector<Point<dim>> x_in_whole(dof_handler.n_dofs());
    DoFTools::map_dofs_to_support_points(MappingQ<dim>(1), dof_handler, x_in_whole);

    std::vector<Part<dim>> parts(n);
    std::size_t            n_cells = 0, n_owned = 0;
    for (unsigned rank = 0; rank < n; ++rank)
    {
      auto &part = parts[rank];
      auto [mesh, division] = refined_in_places<dim>(centre, times, n);
      part.mesh = std::move(mesh);
      part.subdomain = cut_out_subdomain(part.mesh, times + 1, Processes(rank, n), division);
      part.dof_handler.reinit(*part.mesh.triangulation);
      part.dof_handler.distribute_dofs(fe);
      part.shared = unknowns_on_cuts(*part.subdomain, part.dof_handler, {});
      part.x.resize(part.dof_handler.n_dofs());
      DoFTools::map_dofs_to_support_points(MappingQ<dim>(1), part.dof_handler, part.x);
      n_cells += part.mesh.triangulation->n_active_cells();
      n_owned += part.dof_handler.n_dofs() - part.shared.n_not_owned();
      std::vector<Point<dim>> centers;
      for (const auto &cell : part.subdomain->whole.triangulation->active_cell_iterators())
        centers.push_back(cell->center());
      for (const auto &cell : part.mesh.triangulation->active_cell_iterators())
        EXPECT_LT(cell->center().distance(centers[part.subdomain->own_active_cells[cell->active_cell_index()]]), 1e-13);
    }
    EXPECT_EQ(n_cells, whole.triangulation->n_active_cells());
    EXPECT_EQ(n_owned, dof_handler.n_dofs());
    EXPECT_TRUE(whole.triangulation->has_hanging_nodes());
    for (const auto &part : parts)
      for (const auto &neighbor : part.shared.all_neighbors())
      {
        const auto &others = parts[neighbor.rank].shared.all_neighbors();
        const auto  back =
          std::find_if(others.begin(), others.end(), [&](const auto &entry) { return entry.rank == part.subdomain->processes.rank(); });
        ASSERT_NE(back, others.end());
        ASSERT_EQ(back->dofs.size(), neighbor.dofs.size());
        for (std::size_t k = 0; k < neighbor.dofs.size(); ++k)
          EXPECT_LT(part.x[neighbor.dofs[k]].distance(parts[neighbor.rank].x[back->dofs[k]]), 1e-13);
      }
  }
} // namespace

TEST(Subdomain, SidesOfACutAgreeWhereTheMeshIsRefinedInPlaces)
{
  check_in_places<2>(FE_Q<2>(1), 2, 3);
  check_in_places<2>(FE_Q<2>(3), 3, 2);
  check_in_places<3>(FE_Q<3>(1), 2, 2);
  check_in_places<3>(FE_Q<3>(2), 5, 2);
}

TEST(Subdomain, PartsAreWeighedByTheCellsThatCome)
{
  auto mesh = make_mesh<2>(box<2>(), false);
  mesh.triangulation->refine_global(4);
  std::vector<double> weights;
  for (const auto &cell : mesh.triangulation->active_cell_iterators())
    weights.push_back(cell->center()[0] < 0.25 ? 16 : 1);
  for (const unsigned n : {2u, 3u, 5u})
  {
    const Division      division = divide(*mesh.triangulation, n, weights);
    std::vector<double> of_part(n, 0.);
    double              all = 0;
    for (std::size_t k = 0; k < weights.size(); ++k)
    {
      of_part[division.owner[k]] += weights[k];
      all += weights[k];
    }
    EXPECT_LT(*std::max_element(of_part.begin(), of_part.end()), 1.1 * all / n) << n;
  }
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
