#include "unilateral/algebra/gmres.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace unilateral
{
  namespace
  {
    /// The least-squares problem |beta e_1 - H y| of a Hessenberg matrix H that grows by columns, by Givens rotations.
    class HessenbergProblem
    {
    public:
      explicit HessenbergProblem(const double beta) : rhs{beta} {}

      /// Column k has k + 2 entries. Returns the least |beta e_1 - H y|.
      double add_column(std::vector<double> column)
      {
        for (std::size_t i = 0; i < rotations.size(); ++i)
          rotate(rotations[i], column[i], column[i + 1]);
        const std::size_t k = rotations.size();
        const double      length = std::hypot(column[k], column[k + 1]);
        rotations.push_back(length > 0 ? Rotation{column[k] / length, column[k + 1] / length} : Rotation{1, 0});
        column[k] = length;
        column.resize(k + 1);
        columns.push_back(std::move(column));
        rhs.push_back(0);
        rotate(rotations[k], rhs[k], rhs[k + 1]);
        return std::abs(rhs[k + 1]);
      }

      /// The y of the least residual. A zero on the diagonal, of a singular matrix, takes no part.
      std::vector<double> solution() const
      {
        std::vector<double> y(rhs.begin(), rhs.end() - 1);
        for (std::size_t i = y.size(); i-- > 0;)
        {
          for (std::size_t k = i + 1; k < y.size(); ++k)
            y[i] -= columns[k][i] * y[k];
          y[i] = columns[i][i] != 0 ? y[i] / columns[i][i] : 0.;
        }
        return y;
      }

    private:
      struct Rotation
      {
        double c, s;
      };

      static void rotate(const Rotation &rotation, double &a, double &b)
      {
        const double before = a;
        a = rotation.c * before + rotation.s * b;
        b = -rotation.s * before + rotation.c * b;
      }

      std::vector<Rotation>            rotations;
      std::vector<std::vector<double>> columns; ///< of the triangular factor
      std::vector<double>              rhs;
    };

    /// The Krylov space between two restarts.
    struct KrylovBasis
    {
      std::vector<Vector> v; ///< orthonormal
      std::vector<Vector> z; ///< preconditioned

      /// Entry @p k of one of the two, which keep their memory over restarts.
      static Vector &at(std::vector<Vector> &vectors, const std::size_t k, const Vector &like)
      {
        if (k == vectors.size())
          vectors.emplace_back(like);
        return vectors[k];
      }
    };
  } // namespace

  LinearSolve gmres(const LinearMap      &T,
                    const LinearMap      &precondition,
                    const Vector         &rhs,
                    const ScalarProduct  &dot,
                    const SolveTolerance &tolerance,
                    const unsigned        max_iterations,
                    const unsigned        basis,
                    Vector               &x)
  {
    LinearSolve result;
    Vector      r(rhs), z(rhs);
    const auto  evaluate_residual = [&]
    {
      T(r, x);
      r.sadd(-1., 1., rhs);
      return std::sqrt(dot(r, r));
    };
    const double euclidean = evaluate_residual();
    precondition(z, r);
    // Where P^-1 turns r by a right angle, r'P^-1 r says nothing.
    const double product = std::abs(dot(r, z));
    const double start = std::sqrt(product > 0 ? product : euclidean * std::sqrt(dot(z, z)));
    result.residual = start;
    const double goal = std::max(tolerance.absolute, tolerance.relative * start);
    if (start <= goal)
    {
      result.converged = true;
      return result;
    }
    const double euclidean_goal = euclidean * goal / start;
    double       remaining = euclidean;
    KrylovBasis  krylov;
    bool         ended = false; // by the estimate
    while (!ended && remaining > euclidean_goal && result.iterations < max_iterations)
    {
      HessenbergProblem hessenberg(remaining);
      Vector           &first = KrylovBasis::at(krylov.v, 0, rhs);
      first = r;
      first *= 1 / remaining;
      double   estimate = remaining;
      unsigned k = 0;
      for (; k < basis && estimate > euclidean_goal && result.iterations < max_iterations; ++k, ++result.iterations)
      {
        Vector &of_step = KrylovBasis::at(krylov.z, k, rhs), &next = KrylovBasis::at(krylov.v, k + 1, rhs);
        precondition(of_step, krylov.v[k]);
        T(next, of_step);
        std::vector<double> column;
        for (unsigned i = 0; i <= k; ++i)
        {
          column.push_back(dot(next, krylov.v[i]));
          next.add(-column.back(), krylov.v[i]);
        }
        const double length = std::sqrt(dot(next, next));
        column.push_back(length);
        estimate = hessenberg.add_column(std::move(column));
        if (length > 0)
          next *= 1 / length;
      }
      const std::vector<double> y = hessenberg.solution();
      for (unsigned i = 0; i < k; ++i)
        x.add(y[i], krylov.z[i]);
      remaining = evaluate_residual();
      ended = !(estimate > euclidean_goal);
    }
    // The iteration only estimates its residual, and takes a singular T for solved.
    result.residual = start * remaining / euclidean;
    if (!ended && remaining > euclidean_goal)
      result.failure = fmt::format("GMRES did not converge in {} steps", result.iterations);
    else if (!(result.residual <= std::max(10 * goal, 1e-12 * start)))
      result.failure = fmt::format("GMRES broke down after {} steps with a residual of {:.1e}", result.iterations, result.residual);
    result.converged = result.failure.empty();
    return result;
  }
} // namespace unilateral
