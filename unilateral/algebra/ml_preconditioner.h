// Smoothed aggregation by Trilinos ML.
#pragma once

#include <deal.II/lac/trilinos_precondition.h>

#include <Epetra_CrsMatrix.h>

#include <memory>
#include <vector>

namespace unilateral
{
  struct MlParameters
  {
    bool   symmetric = true;
    bool   higher_order = false;  ///< element degree > 1: tells the aggregation not to trust small couplings
    double drop_tolerance = 0.02; ///< couplings weaker than this fraction of the diagonal do not join an aggregate
  };

  /// One V-cycle with two steps of smoothing (Chebyshev polynomials, or Gauss-Seidel where the matrix is not symmetric). @p modes:
  /// functions with nearly no energy, by the rows of this process; none: the constant. @p block_size: unknowns of a node, in sequence.
  /// Collective.
  std::unique_ptr<dealii::TrilinosWrappers::PreconditionAMG> ml_preconditioner(const Epetra_CrsMatrix                 &matrix,
                                                                               const std::vector<std::vector<double>> &modes,
                                                                               unsigned                                block_size,
                                                                               const MlParameters                     &parameters);
} // namespace unilateral
