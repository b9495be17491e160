#include "unilateral/algebra/minres.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace unilateral
{
  LinearSolve minres(const BlockLinearMap     &K,
                     const BlockLinearMap     &precondition,
                     const BlockVector        &rhs,
                     const BlockScalarProduct &product,
                     const IsEnough           &is_enough,
                     const unsigned            max_iterations,
                     BlockVector              &x)
  {
    LinearSolve result;
    x = 0.;
    // v_last, v, v_next: successive Lanczos vectors, z = P^-1 v; w_last, w, w_next: successive directions.
    BlockVector v_last(rhs), v(rhs), v_next(rhs), z(rhs), w_last(rhs), w(rhs), w_next(rhs);
    for (BlockVector *const zero : {&v_last, &w_last, &w})
      *zero = 0.;
    precondition(z, v);
    double gamma_last = 1, gamma = std::sqrt(std::max(0., product(z, v))), eta = gamma;
    double s_last = 0, s = 0, c_last = 1, c = 1;
    for (result.residual = eta; eta != 0 && !is_enough(x, result.residual);)
    {
      if (result.iterations == max_iterations)
      {
        result.failure = fmt::format("minimal residuals did not converge in {} steps", result.iterations);
        break;
      }
      ++result.iterations;
      z /= gamma;
      K(v_next, z);
      const double delta = product(v_next, z);
      v_next.add(-delta / gamma, v, -gamma / gamma_last, v_last);

      // The QR factorisation of the tridiagonal matrix by rotations.
      const double a_2 = s * delta + c_last * c * gamma, a_3 = s_last * gamma;
      w_next = z;
      w_next.add(-a_3, w_last, -a_2, w);
      precondition(z, v_next);
      const double zv = product(z, v_next);
      if (!(zv >= 0) || !std::isfinite(delta))
      {
        result.failure = "the preconditioner is not positive definite";
        break;
      }
      const double gamma_next = std::sqrt(zv), a_0 = c * delta - c_last * s * gamma, a_1 = std::hypot(a_0, gamma_next);
      if (a_1 == 0)
      {
        result.failure = "the linear system is singular";
        break;
      }
      w_next /= a_1;
      c_last = std::exchange(c, a_0 / a_1);
      s_last = std::exchange(s, gamma_next / a_1);
      x.add(c * eta, w_next);
      eta *= -s;
      result.residual = std::abs(eta);

      gamma_last = std::exchange(gamma, gamma_next);
      v_last.swap(v);
      v.swap(v_next);
      w_last.swap(w);
      w.swap(w_next);
    }
    result.converged = result.failure.empty();
    return result;
  }
} // namespace unilateral
