#include "unilateral/spaces/hanging_nodes.h"

#include <deal.II/dofs/dof_tools.h>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  AffineConstraints<double> constraints_at_hanging_nodes(const DoFHandler<dim> &dof_handler)
  {
    AffineConstraints<double> result;
    if (dof_handler.get_triangulation().has_hanging_nodes())
      DoFTools::make_hanging_node_constraints(dof_handler, result);
    result.close();
    return result;
  }

  template AffineConstraints<double> constraints_at_hanging_nodes(const DoFHandler<1> &);
  template AffineConstraints<double> constraints_at_hanging_nodes(const DoFHandler<2> &);
  template AffineConstraints<double> constraints_at_hanging_nodes(const DoFHandler<3> &);
} // namespace unilateral
