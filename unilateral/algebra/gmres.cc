#include "unilateral/algebra/gmres.h"

#include <deal.II/lac/solver_gmres.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  namespace
  {
    struct AsMatrix
    {
      const LinearMap &map;
      void             vmult(Vector &y, const Vector &x) const { map(y, x); }
    };
  } // namespace

  LinearSolve gmres(const LinearMap      &T,
                    const LinearMap      &precondition,
                    const Vector         &rhs,
                    const SolveTolerance &tolerance,
                    const unsigned        max_iterations,
                    const unsigned        basis,
                    Vector               &x)
  {
    LinearSolve result;
    Vector      r(rhs), z(rhs);
    T(r, x);
    r.sadd(-1., 1., rhs);
    precondition(z, r);
    // Where P^-1 turns r by a right angle, r'P^-1 r says nothing.
    const double product = std::abs(r * z), euclidean = r.l2_norm();
    const double start = std::sqrt(product > 0 ? product : euclidean * z.l2_norm());
    result.residual = start;
    const double goal = std::max(tolerance.absolute, tolerance.relative * start);
    if (start <= goal)
    {
      result.converged = true;
      return result;
    }
    dealii::SolverControl        control(max_iterations, euclidean * goal / start);
    dealii::SolverFGMRES<Vector> solver(control, dealii::SolverFGMRES<Vector>::AdditionalData(basis));
    try
    {
      solver.solve(AsMatrix{T}, x, rhs, AsMatrix{precondition});
    }
    catch (const dealii::SolverControl::NoConvergence &)
    {
      result.failure = fmt::format("GMRES did not converge in {} steps", control.last_step());
    }
    result.iterations = control.last_step();
    // The iteration only estimates its residual, and takes a singular T for solved.
    T(r, x);
    r.sadd(-1., 1., rhs);
    const double remaining = r.l2_norm();
    result.residual = start * remaining / euclidean;
    if (result.failure.empty() && !(result.residual <= std::max(10 * goal, 1e-12 * start)))
      result.failure = fmt::format("GMRES broke down after {} steps with a residual of {:.1e}", control.last_step(), result.residual);
    result.converged = result.failure.empty();
    return result;
  }
} // namespace unilateral
