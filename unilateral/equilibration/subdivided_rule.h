// Composite rules for functions with kinks inside cells.
#pragma once

#include <deal.II/base/quadrature.h>

namespace unilateral
{
  /// @p rule on each of the cells that halving the reference cell @p times in each direction makes.
  template <int dim>
  dealii::Quadrature<dim> subdivided(const dealii::Quadrature<dim> &rule, bool simplex, unsigned times);
} // namespace unilateral
