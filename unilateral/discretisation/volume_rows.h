// What changes of volume cost, as a term of its own.
#pragma once

#include "unilateral/algebra/sparse_rows.h"
#include "unilateral/base/shared_unknowns.h"
#include "unilateral/discretisation/problem.h"

#include <deal.II/lac/vector.h>

namespace unilateral
{
  /// Some region is nearly incompressible, so that a(u, v) = a_0(u, v) + (C u, C v) with a row of C for each vertex around which changes of
  /// volume are averaged (VertexVolumes), or for each polynomial on which they are projected (BilinearForm::volume_rows).
  template <int dim>
  bool has_volume_rows(const Problem<dim> &problem);

  struct VolumeRows
  {
    OwnSparseRows  C;      ///< of a part of the mesh: what the own cells have of it
    SharedUnknowns shared; ///< the rows that other processes have, too
  };

  /// C in terms of the unknowns that the conditions leave free. With the constants c that prescribed values add the energy is
  /// 1/2 |C u + c|^2: @p load takes -C'c.
  template <int dim>
  VolumeRows volume_rows(const Problem<dim> &problem, dealii::Vector<double> &load);
} // namespace unilateral
