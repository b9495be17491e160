// The forecast of nodes against refinement itself.
#include "unilateral/mesh/nodes_of_refinement.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/grid_generator.h>

#include <gtest/gtest.h>

#include <random>
#include <vector>

using namespace unilateral;

namespace
{
  template <int dim>
  void check_forecast(const unsigned degree)
  {
    std::mt19937               random(dim * 10 + degree);
    dealii::Triangulation<dim> triangulation;
    dealii::GridGenerator::subdivided_hyper_cube(triangulation, 2);
    const dealii::FE_Q<dim>         fe(degree);
    dealii::DoFHandler<dim>         dof_handler(triangulation);
    dealii::types::global_dof_index expected = 0;
    for (unsigned level = 0; level < (dim == 3 ? 3 : 5); ++level)
    {
      dof_handler.distribute_dofs(fe);
      if (level > 0)
        EXPECT_EQ(dof_handler.n_dofs(), expected) << dim << " " << degree << " " << level;
      std::vector<bool> chosen(triangulation.n_active_cells());
      for (std::size_t c = 0; c < chosen.size(); ++c)
        chosen[c] = random() % 4 == 0;
      expected = dof_handler.n_dofs() + n_new_nodes(triangulation, chosen, degree);
      for (const auto &cell : triangulation.active_cell_iterators())
      {
        EXPECT_FALSE(cell->refine_flag_set());
        if (chosen[cell->active_cell_index()])
          cell->set_refine_flag();
      }
      triangulation.execute_coarsening_and_refinement();
    }
  }
} // namespace

TEST(NodesOfRefinement, are_those_that_are_there_afterwards)
{
  for (unsigned degree = 1; degree < 5; ++degree)
  {
    check_forecast<1>(degree);
    check_forecast<2>(degree);
    check_forecast<3>(degree);
  }
}
