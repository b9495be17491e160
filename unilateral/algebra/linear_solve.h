// When a linear solve may stop, and what came of it.
#pragma once

#include <algorithm>
#include <limits>
#include <string>

namespace unilateral
{
  /// When a linear solve may stop: residual <= max(absolute, relative * residual at the start), or after so many iterations.
  struct SolveTolerance
  {
    double   absolute = 0, relative = 0;
    unsigned enough_iterations = std::numeric_limits<unsigned>::max(); ///< reached: converged, its residual is the one before the last
    unsigned least_iterations = 0; ///< of conjugate gradients, for who has to know the spectrum: a small residual alone proves little
  };

  /// The same with at least so many iterations, but for solves that are not to be accurate (enough_iterations).
  inline SolveTolerance with_least_iterations(SolveTolerance tolerance, const unsigned least)
  {
    if (tolerance.enough_iterations > least)
      tolerance.least_iterations = std::max(tolerance.least_iterations, least);
    return tolerance;
  }

  struct LinearSolve
  {
    bool        converged = false;
    unsigned    iterations = 0; ///< 0 for a direct solve
    double      residual = 0;   ///< close to the energy norm of the error: (r' P^-1 r)^1/2 for a factorisation P; see ConjugateGradients
    std::string failure;        ///< why it did not converge
  };
} // namespace unilateral
