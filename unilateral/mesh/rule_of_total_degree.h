// Quadrature on reference cells for polynomials of a given total degree, with fewer points than a product of Gauss's rules.
#pragma once

#include <deal.II/base/quadrature.h>

namespace unilateral
{
  /// On the segment, quadrilateral or hexahedron, or with @p simplex on the triangle or tetrahedron: positive weights, points inside, exact
  /// for polynomials of total degree 2 n - 1. A product of Gauss's rules is exact for this degree of each variable, which takes n^3 points
  /// in space; hexahedra have 14 of Hammer and Stroud (1958) with n = 3 and 34 of Sarma and Stroud (1969) with n = 4 (A. H. Stroud:
  /// Approximate Calculation of Multiple Integrals, 1971, C3: 5-1 and 7-1). All others: gauss_rule(simplex, n).
  template <int dim>
  dealii::Quadrature<dim> rule_of_total_degree(bool simplex, unsigned n);
} // namespace unilateral
