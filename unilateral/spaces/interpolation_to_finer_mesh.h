// A function of V_h on a mesh that is refined more.
#pragma once

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/la_parallel_vector.h>

namespace unilateral
{
  /// @p u in terms of @p fine, whose mesh has the same coarse cells and refines all that the mesh of @p coarse does; the order in which the
  /// two were refined does not count. Of quadrilaterals and hexahedra, and the same element on both. Throws std::invalid_argument when @p
  /// fine does not refine @p coarse.
  template <int dim>
  dealii::LinearAlgebra::distributed::Vector<double> on_finer_mesh(const dealii::DoFHandler<dim>                            &coarse,
                                                                   const dealii::LinearAlgebra::distributed::Vector<double> &u,
                                                                   const dealii::DoFHandler<dim>                            &fine);
} // namespace unilateral
