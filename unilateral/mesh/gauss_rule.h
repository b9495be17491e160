// Gauss's rules on reference cells of either kind.
#pragma once

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace unilateral
{
  /// On the segment, quadrilateral or hexahedron, or with @p simplex on the triangle or tetrahedron: exact for polynomials of degree
  /// 2 n_points - 1, of each variable or in total. The largest on triangles and tetrahedra has n_points = 4, and stands for those beyond;
  /// in dimension 0 there is one point, whatever n_points.
  template <int dim>
  dealii::Quadrature<dim> gauss_rule(const bool simplex, const unsigned n_points)
  {
    if constexpr (dim >= 2)
      if (simplex)
        return dealii::QGaussSimplex<dim>(std::min(n_points, 4u));
    return dealii::QGauss<dim>(dim == 0 ? 1 : n_points);
  }
} // namespace unilateral
