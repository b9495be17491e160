// What the load makes of the error inside the cells of beams and plates.
#pragma once

#include "unilateral/algebra/vector.h"
#include "unilateral/discretisation/problem.h"

#include <vector>

namespace unilateral
{
  /// Adds to @p cell_squares, by active cell, the square of the energy norm of the function that the cell, clamped at its edges, is short
  /// of,
  ///     h^4/720 int r^2/EI,     r = f - c u - (EI u'')'',
  /// on a rectangle 1/(720 (1/a^4 + 4/(7 a^2 b^2) + 1/b^4)) in place of h^4/720 and div Div M in place of (EI u'')''. On an interval that
  /// is the error itself where r is constant; on a rectangle it is Ritz's with one function, x^2 (a - x)^2 y^2 (b - y)^2, and on a
  /// triangle with the square of the cubic bubble. On beams forces F and moments M at points inside cells, a and b from the ends, add
  ///     (F^2 a^3 b^3/3 + F M a^2 b^2 (b - a) + M^2 a b (h^2 - 3 a b))/(EI h^3),
  /// the work of each on a clamped beam of the length of the cell; on plates with Hermite elements 0.00175 F^2 h^2/D, by the series of
  /// Navier. The recovered moments see nothing of it: a single cubic beam has continuous moments, whatever acts on it. For Hermite elements
  /// and C0 interior penalty ones; zero where contact bears the load, at all points of the cell, and of forms of lower order. Returns the
  /// root of their sum. @p u with its prescribed values.
  template <int dim>
  double add_interior_residuals(const Problem<dim>       &problem,
                                const ConstraintSet<dim> &constraint_set,
                                const Vector             &u,
                                const Vector             &lambda,
                                std::vector<double>      &cell_squares);
} // namespace unilateral
