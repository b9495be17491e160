#include "unilateral/algebra/conjugate_gradients.h"
#include "unilateral/algebra/dense_solvers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace unilateral
{
  namespace
  {
    /// y = a x
    void set(Vector &y, const double a, const Vector &x)
    {
      double *const __restrict y_of = y.begin();
      const double *const __restrict x_of = x.begin();
      for (std::size_t i = 0, n = y.locally_owned_size(); i < n; ++i)
        y_of[i] = a * x_of[i];
    }

    /// z = x + a y, z may be x or y.
    void combine(Vector &z, const Vector &x, const double a, const Vector &y)
    {
      double *const       z_of = z.begin();
      const double *const x_of = x.begin(), *const y_of = y.begin();
#ifdef __clang__
#  pragma clang loop vectorize(assume_safety)
#else
#  pragma GCC ivdep
#endif
      for (std::size_t i = 0, n = z.locally_owned_size(); i < n; ++i)
        z_of[i] = x_of[i] + a * y_of[i];
    }

    /// The tridiagonal matrix of the Lanczos process that conjugate gradients are, from their step lengths alpha_j and the ratios beta_j
    /// of successive r'z; its eigenvalues are the Ritz values of P^-1 T.
    class LanczosMatrix
    {
    public:
      void add_step(const double alpha, const double beta)
      {
        const std::size_t j = diagonal.size();
        diagonal.push_back(1 / alpha + (j > 0 ? last_beta / last_alpha : 0));
        off_diagonal.push_back(std::sqrt(std::max(beta, 0.)) / alpha);
        last_alpha = alpha;
        last_beta = beta;
      }

      double smallest_eigenvalue() const
      {
        using Eigen::VectorXd;
        const Eigen::Index n = diagonal.size();
        if (n == 0)
          return 1;
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen;
        eigen.computeFromTridiagonal(VectorXd(Eigen::Map<const VectorXd>(diagonal.data(), n)),
                                     VectorXd(Eigen::Map<const VectorXd>(off_diagonal.data(), n - 1)), Eigen::EigenvaluesOnly);
        return eigen.info() == Eigen::Success ? eigen.eigenvalues()(0) : 1.;
      }

    private:
      std::vector<double> diagonal, off_diagonal;
      double              last_alpha = 0, last_beta = 0;
    };
  } // namespace

  LinearSolve ConjugateGradients::solve(const LinearMap      &T,
                                        const LinearMap      &precondition,
                                        const Vector         &rhs,
                                        const ScalarProduct  &dot,
                                        const SolveTolerance &tolerance,
                                        const unsigned        max_iterations,
                                        Vector               &x,
                                        Vector *const         Tx)
  {
    LinearSolve result;
    if (p.size() != rhs.size())
      for (Vector *const v : {&r, &z, &p, &Tp})
        v->reinit(rhs, true);
    // From zero, the first step needs no residual of its own and, where it is the only one, none after it.
    const Vector *residual = &rhs;
    if (dot(x, x) > 0)
    {
      T(r, x);
      combine(r, rhs, -1, r);
      residual = &r;
    }
    precondition(p, *residual);
    double        rz = dot(*residual, p);
    LanczosMatrix lanczos;
    const auto    set_residual = [&] { result.residual = std::sqrt(std::abs(rz) / smallest_ritz_value); };
    set_residual();
    const double goal = std::max(tolerance.absolute, tolerance.relative * result.residual);
    bool         Tx_is_known = false;
    while (result.residual > goal || result.iterations < tolerance.least_iterations)
    {
      if (rz == 0)
        break; // solved to the last bit
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
      const bool   from_zero = residual == &rhs, last = result.iterations == tolerance.enough_iterations;
      if (from_zero)
        set(x, step, p);
      else
        combine(x, x, step, p);
      if (last && from_zero && Tx)
      {
        set(*Tx, step, Tp);
        Tx_is_known = true;
        break;
      }
      combine(r, *residual, -step, Tp);
      residual = &r;
      if (last)
        break; // what the preconditioner would say of r is not needed
      precondition(z, r);
      const double rz_next = dot(r, z);
      combine(p, z, rz_next / rz, p);
      lanczos.add_step(step, rz_next / rz);
      rz = rz_next;
      set_residual();
      if (result.residual > goal)
        continue;
      if (const double theta = lanczos.smallest_eigenvalue(); theta > 0)
        smallest_ritz_value = std::min(smallest_ritz_value, theta);
      set_residual();
    }
    if (Tx && !Tx_is_known)
      combine(*Tx, rhs, -1, *residual);
    result.converged = result.failure.empty();
    return result;
  }
} // namespace unilateral
