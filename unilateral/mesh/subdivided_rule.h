// Composite rules for functions with kinks inside cells.
#pragma once

#include <deal.II/base/quadrature.h>

#include <vector>

namespace unilateral
{
  /// @p rule on each of the cells that halving the reference cell @p times in each direction makes.
  template <int dim>
  dealii::Quadrature<dim> subdivided(const dealii::Quadrature<dim> &rule, bool simplex, unsigned times);

  /// At the points of a cell: by more than 20 %, so that a jump between them, or an oscillation, is possible.
  bool varies_much(const std::vector<double> &values);
} // namespace unilateral
