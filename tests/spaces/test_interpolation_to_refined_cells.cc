// What interpolation to a finer mesh reproduces.
#include "unilateral/spaces/interpolation_to_refined_cells.h"

#include <deal.II/base/function.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>
#include <deal.II/numerics/vector_tools.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace dealii;
  using unilateral::InterpolationToRefinedCells;
  using NodalValues = LinearAlgebra::distributed::Vector<double>;

  /// A polynomial of the same degree in every coordinate, another one in each component.
  template <int dim>
  class Polynomial : public Function<dim>
  {
  public:
    Polynomial(const unsigned degree, const unsigned n_components) : Function<dim>(n_components), degree(degree) {}
    double value(const Point<dim> &x, const unsigned component) const override
    {
      double value = 1;
      for (unsigned d = 0; d < dim; ++d)
        value *= std::pow(x[d] + 0.3 * (component + 1), degree) - 0.2 * x[d];
      return value;
    }

  private:
    unsigned degree;
  };

  /// The largest error at a node after @p before refinements and one more.
  template <int dim>
  double error(
    const FiniteElement<dim> &fe, const unsigned before, const unsigned degree, const bool smoothly = true, const bool in_places = false)
  {
    // Cells at one end only.
    const auto refine_in_places = [](Triangulation<dim> &mesh)
    {
      for (const auto &cell : mesh.active_cell_iterators())
        if (cell->center()[0] < 0.3)
          cell->set_refine_flag();
      mesh.execute_coarsening_and_refinement();
    };
    Triangulation<dim> mesh;
    GridGenerator::subdivided_hyper_cube(mesh, 2);
    mesh.refine_global(before);
    if (in_places)
      refine_in_places(mesh);
    DoFHandler<dim> dof_handler(mesh);
    dof_handler.distribute_dofs(fe);
    const Polynomial<dim>    polynomial(degree, fe.n_components());
    std::vector<NodalValues> functions(2, NodalValues(dof_handler.n_dofs()));
    VectorTools::interpolate(dof_handler, polynomial, functions[1]);
    const InterpolationToRefinedCells<dim> carried(dof_handler, functions, smoothly);
    if (in_places)
      refine_in_places(mesh);
    else
      mesh.refine_global(1);
    dof_handler.distribute_dofs(fe);
    carried.interpolate(dof_handler, functions);
    EXPECT_EQ(functions[0].linfty_norm(), 0);
    NodalValues expected(dof_handler.n_dofs());
    VectorTools::interpolate(dof_handler, polynomial, expected);
    expected -= functions[1];
    return expected.linfty_norm();
  }

  template <int dim>
  void check()
  {
    for (const unsigned degree : {1u, 2u})
      for (const unsigned n_components : {1u, 2u})
      {
        const FESystem<dim> fe(FE_Q<dim>(degree), n_components);
        EXPECT_LT(error<dim>(fe, 0, degree), 1e-13);
        EXPECT_LT(error<dim>(fe, 1, 2 * degree), 1e-12);
        EXPECT_LT(error<dim>(fe, 2, 2 * degree), 1e-12);
        EXPECT_GT(error<dim>(fe, 0, degree + 1), 1e-4);
        EXPECT_GT(error<dim>(fe, 1, 2 * degree + 1), 1e-6);
      }
  }
} // namespace

TEST(CellRefinement, polynomials_of_twice_the_degree_once_cells_have_siblings)
{
  check<1>();
  check<2>();
  check<3>();
}

TEST(CellRefinement, high_degrees_keep_their_own_polynomials)
{
  EXPECT_LT(error<2>(FE_Q<2>(4), 1, 4), 1e-12);
  EXPECT_GT(error<2>(FE_Q<2>(4), 1, 5), 1e-9);
}

TEST(CellRefinement, functions_that_may_jump_and_those_not_asked_for_stay_what_they_are)
{
  EXPECT_GT(error<2>(FE_Q<2>(1), 1, 2, false), 1e-3);
  EXPECT_LT(error<2>(FE_DGQ<2>(1), 1, 1), 1e-13);
  EXPECT_LT(error<2>(FE_DGQ<2>(2), 2, 2), 1e-13);
  EXPECT_GT(error<2>(FE_DGQ<2>(1), 2, 2), 1e-4);
}

TEST(CellRefinement, in_places)
{
  for (const unsigned degree : {1u, 2u, 3u})
  {
    EXPECT_LT(error<1>(FE_Q<1>(degree), 1, degree, true, true), 1e-12);
    EXPECT_LT(error<2>(FE_Q<2>(degree), 1, degree, true, true), 1e-12);
    EXPECT_LT(error<3>(FE_Q<3>(degree), 1, degree, true, true), 1e-12);
    EXPECT_LT(error<2>(FE_DGQ<2>(degree), 2, degree, false, true), 1e-12);
  }
}
