#include "unilateral/algebra/eigenvalues.h"
#include "unilateral/algebra/dense_solvers.h"

#include <deal.II/lac/arpack_solver.h>
#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/vector.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <utility>

namespace unilateral
{
  namespace
  {
    using DealiiVector = dealii::Vector<double>;

    /// A DenseMap with the face that deal.II's solver expects.
    struct DenseOperator
    {
      const DenseMap &map;
      void            vmult(DealiiVector &y, const DealiiVector &x) const
      {
        const Eigen::VectorXd image = map(Eigen::Map<const Eigen::VectorXd>(x.begin(), x.size()));
        std::copy(image.begin(), image.end(), y.begin());
      }
    };

    /// The same from matrices, column by column, where Lanczos iterations would have no room.
    Eigenpair dense_smallest_eigenpair(const std::size_t n, const DenseMap &inverse, const DenseMap &mass)
    {
      Eigen::MatrixXd T(n, n), D(n, n);
      for (std::size_t j = 0; j < n; ++j)
      {
        D.col(j) = mass(Eigen::VectorXd::Unit(n, j));
        T.col(j) = inverse(Eigen::VectorXd::Unit(n, j));
      }
      // S^-1 D x = theta x becomes (L' S^-1 L) y = theta y with D = L L', x = L'^-1 y.
      const Eigen::LLT<Eigen::MatrixXd>                    cholesky(0.5 * (D + D.transpose()));
      const Eigen::MatrixXd                                L = cholesky.matrixL();
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(L.transpose() * (0.5 * (T + T.transpose())) * L);
      return {1 / eigen.eigenvalues()(n - 1), cholesky.matrixL().transpose().solve(eigen.eigenvectors().col(n - 1))};
    }
  } // namespace

  namespace
  {
    /// A start without symmetry: the lowest mode is often orthogonal to every symmetric function. The same in every run.
    Eigen::VectorXd random_vector(const std::size_t n)
    {
      std::mt19937                           random(1980);
      std::uniform_real_distribution<double> uniform(-1, 1);
      Eigen::VectorXd                        vector(n);
      for (double &x : vector)
        x = uniform(random);
      return vector;
    }
  } // namespace

  Eigenpair smallest_eigenpair(const std::size_t n, const DenseMap &inverse, const DenseMap &mass)
  {
    constexpr std::size_t n_lanczos = 60;
    if (n <= 2 * n_lanczos)
      return dense_smallest_eigenpair(n, inverse, mass);

    dealii::SolverControl control(100, 1e-5);
    dealii::ArpackSolver  solver(
       control, dealii::ArpackSolver::AdditionalData(n_lanczos, dealii::ArpackSolver::largest_magnitude, /*symmetric=*/true));
    const Eigen::VectorXd first = random_vector(n);
    DealiiVector          start(n);
    std::copy(first.begin(), first.end(), start.begin());
    solver.set_initial_vector(start);

    std::vector<std::complex<double>> values(1);
    std::vector<DealiiVector>         vectors(1, DealiiVector(n));
    solver.solve(0, DenseOperator{mass}, DenseOperator{inverse}, values, vectors);

    Eigenpair             pair{values[0].real(), Eigen::Map<const Eigen::VectorXd>(vectors[0].begin(), n)};
    const Eigen::VectorXd image = mass(pair.vector), back = inverse(image);
    pair.vector /= std::sqrt(pair.vector.dot(image));
    // ARPACK reports its failures by assertions only.
    const Eigen::VectorXd unit = back / std::sqrt(back.dot(mass(back)));
    const double          miss = std::min((unit - pair.vector).norm(), (unit + pair.vector).norm()) / pair.vector.norm();
    if (!(miss < 1e-2))
      throw std::runtime_error("the Lanczos iteration for the smallest eigenvalue did not converge");
    return pair;
  }

  double smallest_eigenvalue(const std::size_t n, const DenseMap &inverse, const DenseMap &mass)
  {
    constexpr std::size_t most_steps = 400, between_checks = 10;
    constexpr double      accuracy = 1e-5;
    const std::size_t     n_steps = std::min(n, most_steps);
    // S^-1 D is symmetric in the inner product of D: the columns of Q are orthonormal in it, DQ = D Q, and Q' D S^-1 D Q is tridiagonal.
    Eigen::MatrixXd Q(n, n_steps), DQ(n, n_steps);
    Eigen::VectorXd next = random_vector(n), mass_times_next = mass(next), diagonal(n_steps), below(n_steps);
    double          size = std::sqrt(next.dot(mass_times_next)), value = 0;
    for (std::size_t k = 0; k < n_steps; ++k)
    {
      Q.col(k) = next / size;
      DQ.col(k) = mass_times_next / size;
      next = inverse(DQ.col(k));
      diagonal(k) = next.dot(DQ.col(k));
      for (unsigned repeated = 0; repeated < 2; ++repeated)
      {
        const Eigen::VectorXd along = DQ.leftCols(k + 1).transpose() * next;
        next.noalias() -= Q.leftCols(k + 1) * along;
      }
      mass_times_next = mass(next);
      size = std::sqrt(std::max(next.dot(mass_times_next), 0.));
      below(k) = size;

      const bool exhausted = k + 1 == n_steps || size <= 1e-13 * std::abs(diagonal(k));
      if (!exhausted && (k + 1) % between_checks != 0)
        continue;
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
      ritz.computeFromTridiagonal(diagonal.head(k + 1), below.head(k));
      const double before = std::exchange(value, ritz.eigenvalues()(k));
      const double residual = size * std::abs(ritz.eigenvectors()(k, k));
      if (value > 0 && (residual <= accuracy * value || value - before <= accuracy * value || (exhausted && n <= most_steps)))
        return 1 / value;
      if (exhausted)
        break;
    }
    throw std::runtime_error("the Lanczos iteration for the smallest eigenvalue did not converge");
  }
} // namespace unilateral
