#include "unilateral/conjugate_gradients.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  LinearSolve conjugate_gradients(const LinearMap      &T,
                                  const LinearMap      &precondition,
                                  const Vector         &rhs,
                                  const ScalarProduct  &dot,
                                  const SolveTolerance &tolerance,
                                  const unsigned        max_iterations,
                                  Vector               &x,
                                  Vector *const         Tx)
  {
    LinearSolve result;
    Vector      r(rhs), z(rhs), p, Tp;
    if (dot(x, x) > 0)
    {
      T(r, x);
      r.sadd(-1., 1., rhs);
    }
    precondition(z, r);
    double rz = dot(r, z);
    p = z;
    Tp.reinit(rhs, true);
    result.residual = std::sqrt(std::abs(rz));
    const double goal = std::max(tolerance.absolute, tolerance.relative * result.residual);
    while (result.residual > goal)
    {
      if (result.iterations == max_iterations)
      {
        result.failure = fmt::format("conjugate gradients did not converge in {} steps", result.iterations);
        break;
      }
      ++result.iterations;
      T(Tp, p);
      const double curvature = dot(p, Tp);
      if (!(curvature > 0) || !(rz > 0))
      {
        result.failure = "the linear system is not positive definite";
        break;
      }
      const double step = rz / curvature;
      x.add(step, p);
      r.add(-step, Tp);
      if (result.iterations == tolerance.enough_iterations)
        break; // what the preconditioner would say of r is not needed
      precondition(z, r);
      const double rz_next = dot(r, z);
      p.sadd(rz_next / rz, 1., z);
      rz = rz_next;
      result.residual = std::sqrt(std::abs(rz));
    }
    if (Tx)
    {
      *Tx = rhs;
      *Tx -= r;
    }
    result.converged = result.failure.empty();
    return result;
  }
} // namespace unilateral
