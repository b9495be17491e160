// Vectors of unknowns.
#pragma once

#include <deal.II/lac/la_parallel_vector.h>

namespace unilateral
{
  /// Vectors of V_h (n entries) and of values at the constraint points (N entries).
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;
} // namespace unilateral
