// Smoothed aggregation as LinearSolver and DistributedAmg ask Trilinos ML for it.
#pragma once

#include <deal.II/lac/trilinos_precondition.h>

namespace unilateral
{
  /// @p higher_order: element degree > 1. Couplings weaker than @p drop_tolerance, a fraction of the diagonal, do not join an aggregate.
  inline dealii::TrilinosWrappers::PreconditionAMG::AdditionalData
  ml_parameters(const bool symmetric, const bool higher_order, const double drop_tolerance)
  {
    dealii::TrilinosWrappers::PreconditionAMG::AdditionalData data;
    data.elliptic = symmetric;
    data.higher_order_elements = higher_order;
    data.smoother_sweeps = 2;
    data.aggregation_threshold = drop_tolerance;
    data.smoother_type = symmetric ? "Chebyshev" : "symmetric Gauss-Seidel";
    return data;
  }
} // namespace unilateral
