// Area, centroid and second moments of the parts of the boundary.
#pragma once

#include "unilateral/base/processes.h"

#include <deal.II/base/point.h>
#include <deal.II/base/quadrature.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

#include <functional>
#include <vector>

namespace unilateral
{
  /// Of one part, in the units of the mesh.
  template <int dim>
  struct SurfaceMoments
  {
    double                          measure = 0; ///< A: in 2-D the length
    dealii::Point<dim>              centroid;    ///< c
    dealii::SymmetricTensor<2, dim> second;      ///< int (x - c) (x - c)' dA
  };

  /// Of all parts, by boundary_id, as @p rule on faces integrates them. @p measure: the weight of dA, 2 pi r in a body of revolution.
  /// Faces of all @p processes that share the mesh count.
  template <int dim>
  std::vector<SurfaceMoments<dim>> surface_moments(const dealii::Mapping<dim>                              &mapping,
                                                   const dealii::DoFHandler<dim>                           &dof_handler,
                                                   const dealii::Quadrature<dim - 1>                       &rule,
                                                   unsigned                                                 n_parts,
                                                   const std::function<double(const dealii::Point<dim> &)> &measure,
                                                   const Processes                                         &processes);
} // namespace unilateral
