// Direct solves, made as accurate as double precision allows.
#pragma once

#include "unilateral/algebra/conjugate_gradients.h"

namespace unilateral
{
  /// T x = rhs by @p factorisation, x = T^-1 b up to rounding; starts from what x holds. The residual of the result is (r'T^-1 r)^1/2.
  /// @p gain, where given: the residual after the first solve relative to that before, nearly zero unless rounding spoils the
  /// factorisation.
  LinearSolve solve_with_refinement(const LinearMap      &T,
                                    const LinearMap      &factorisation,
                                    const Vector         &rhs,
                                    const ScalarProduct  &dot,
                                    const SolveTolerance &tolerance,
                                    Vector               &x,
                                    double               *gain = nullptr);
} // namespace unilateral
