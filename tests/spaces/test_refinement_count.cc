// What local refinements make of cells, beside meshes that are refined so.
#include "unilateral/spaces/refinement_count.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <gtest/gtest.h>

#include <vector>

namespace
{
  using namespace unilateral;

  /// A place that is refined `times` times.
  std::vector<FieldFunction> repeated(const FieldFunction &place, const unsigned times)
  {
    return std::vector<FieldFunction>(times, place);
  }

  template <int dim>
  double count_of_all(const dealii::Triangulation<dim> &mesh, const std::vector<FieldFunction> &places, const unsigned n_everywhere)
  {
    RefinementCount<dim> count(places, n_everywhere);
    double               sum = 0;
    for (const auto &cell : mesh.active_cell_iterators())
      sum += count(cell);
    return sum;
  }

  template <int dim>
  bool is_taken(const FieldFunction &place, const typename dealii::Triangulation<dim>::active_cell_iterator &cell)
  {
    bool taken = place.value(cell->center()) != 0;
    for (const unsigned v : cell->vertex_indices())
      taken = taken || place.value(cell->vertex(v)) != 0;
    return taken;
  }

  template <int dim>
  void expect_as_refined(const std::vector<FieldFunction> &places, const double rtol)
  {
    dealii::Triangulation<dim> mesh;
    dealii::GridGenerator::hyper_cube(mesh);
    mesh.refine_global(dim == 2 ? 4 : 3);
    const double now = count_of_all(mesh, places, 0);
    // From the mesh two refinements before: for each of its cells, per cell that these make of it.
    dealii::Triangulation<dim> coarse;
    dealii::GridGenerator::hyper_cube(coarse);
    coarse.refine_global(dim == 2 ? 2 : 1);
    const double before = count_of_all(coarse, places, 2) * (1u << 2 * dim);
    for (const FieldFunction &place : places)
    {
      for (const auto &cell : mesh.active_cell_iterators())
        if (is_taken<dim>(place, cell))
          cell->set_refine_flag();
      mesh.execute_coarsening_and_refinement();
    }
    EXPECT_NEAR(now, mesh.n_active_cells(), rtol * mesh.n_active_cells()); // but for what neighbours ask for
    EXPECT_NEAR(before, now, 1e-12 * now);
  }
} // namespace

TEST(RefinementCount, CountsTheCellsOfNestedDiscs)
{
  const auto disc = [](const double r) { return FieldFunction([r](const dealii::Point<2> &x) { return x.norm() < r ? 1. : 0.; }); };
  expect_as_refined<2>({disc(0.6), disc(0.4), disc(0.2)}, 1e-3);
  expect_as_refined<2>({disc(0.6), disc(0.05), disc(0.03), disc(0.01)}, 0.02);
}

TEST(RefinementCount, CountsTheCellsOfABallInACube)
{
  const FieldFunction ball([](const dealii::Point<3> &x) { return x.distance(dealii::Point<3>(0.3, 0.4, 0.2)) < 0.3 ? 1. : 0.; });
  expect_as_refined<3>({ball}, 1e-3);
}

TEST(RefinementCount, IsAPowerWhereAllOfACellIsRefined)
{
  const FieldFunction everywhere(1.), right([](const dealii::Point<2> &x) { return x[0] > 0.5 ? 1. : 0.; });
  for (const bool simplices : {false, true})
  {
    dealii::Triangulation<2> plane;
    dealii::Triangulation<3> space;
    if (simplices)
    {
      dealii::GridGenerator::subdivided_hyper_cube_with_simplices(plane, 2);
      dealii::GridGenerator::subdivided_hyper_cube_with_simplices(space, 1);
    }
    else
    {
      dealii::GridGenerator::subdivided_hyper_cube(plane, 2);
      dealii::GridGenerator::subdivided_hyper_cube(space, 1);
    }
    for (const unsigned n_everywhere : {0, 1, 3}) // which do not count
    {
      EXPECT_EQ(count_of_all(plane, repeated(everywhere, 3), n_everywhere), 64. * plane.n_active_cells());
      EXPECT_EQ(count_of_all(space, repeated(everywhere, 2), n_everywhere), 64. * space.n_active_cells());
    }
    EXPECT_EQ(count_of_all(plane, {everywhere, FieldFunction(0.)}, 1), 4. * plane.n_active_cells());
    // Each cell becomes 16, and those of the right half of the cells 64.
    EXPECT_EQ(count_of_all(plane, {everywhere, everywhere, right}, 0), (16. + 64.) / 2 * plane.n_active_cells());
  }
}
