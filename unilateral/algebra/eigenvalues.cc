#include "unilateral/algebra/eigenvalues.h"
#include "unilateral/algebra/dense_solvers.h"

#include <deal.II/lac/arpack_solver.h>
#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/vector.h>

#include <cmath>
#include <random>
#include <stdexcept>

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

  Eigenpair smallest_eigenpair(const std::size_t n, const DenseMap &inverse, const DenseMap &mass)
  {
    constexpr std::size_t n_lanczos = 60;
    if (n <= 2 * n_lanczos)
      return dense_smallest_eigenpair(n, inverse, mass);

    dealii::SolverControl control(100, 1e-5);
    dealii::ArpackSolver  solver(
       control, dealii::ArpackSolver::AdditionalData(n_lanczos, dealii::ArpackSolver::largest_magnitude, /*symmetric=*/true));
    // A start without symmetry: the lowest mode is often orthogonal to every symmetric function. The same in every run.
    std::mt19937                           random(1980);
    std::uniform_real_distribution<double> uniform(-1, 1);
    DealiiVector                           start(n);
    for (double &x : start)
      x = uniform(random);
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
} // namespace unilateral
