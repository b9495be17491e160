#include "unilateral/algebra/iterative_refinement.h"

#include <cmath>
#include <limits>

namespace unilateral
{
  LinearSolve solve_with_refinement(const LinearMap      &T,
                                    const LinearMap      &factorisation,
                                    const Vector         &rhs,
                                    const ScalarProduct  &dot,
                                    const SolveTolerance &tolerance,
                                    Vector               &x,
                                    double *const         gain)
  {
    LinearSolve result;
    Vector      residual(rhs), correction(rhs);
    double      previous = std::numeric_limits<double>::max();
    // One solve, and refinement while it still helps: a factorisation without pivoting trouble needs one or two.
    for (unsigned step = 0; step < 4; ++step)
    {
      T(residual, x);
      residual.sadd(-1., 1., rhs);
      factorisation(correction, residual);
      result.residual = std::sqrt(std::abs(dot(residual, correction)));
      if (!std::isfinite(result.residual))
      {
        result.failure = std::isfinite(dot(residual, residual))
                           ? "the linear system is singular"
                           : "numbers are beyond the range of floating-point arithmetic; choose other units";
        return result;
      }
      if (step == 1 && gain)
        *gain = previous > 0 ? result.residual / previous : 0;
      if (step > 0 && (result.residual <= tolerance.absolute || result.residual > 0.5 * previous))
        break;
      x += correction;
      previous = result.residual;
    }
    result.converged = true; // as well as double precision allows
    return result;
  }
} // namespace unilateral
