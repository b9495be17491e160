// The system by which the parts of a divided mesh balance each other.
#pragma once

#include "unilateral/base/processes.h"

#include <Eigen/SparseCore>
#include <Eigen/SparseQR>

#include <map>

namespace unilateral
{
  /// n numbers mu_p for each process p, with
  ///     sum over q of C_pq (mu_p - mu_q) + C_pp mu_p = r_p,
  /// C_pq = C_qp symmetric, semidefinite and zero for processes that have no cut in common: a sparse system of as many blocks as there are
  /// pairs of neighbours. It may be singular; r is in its range then, and mu is one of the solutions. Every process factorises it.
  class SystemOfParts
  {
  public:
    /// @p own: C_pq for the neighbours q of this process p, and C_pp; n x n. Both sides integrate over a cut, and round: the mean of the
    /// two is taken. Collective.
    SystemOfParts(const Processes &processes, unsigned n, const std::map<unsigned, Eigen::MatrixXd> &own);

    /// mu of all processes, one behind the other. @p own: r_p. Collective.
    Eigen::VectorXd solve(const Eigen::VectorXd &own) const;

    /// C_pq, the same on both sides.
    const Eigen::MatrixXd &coupling(const unsigned neighbour) const { return couplings.at(neighbour); }

  private:
    const Processes                     processes;
    std::map<unsigned, Eigen::MatrixXd> couplings; ///< of this process

    Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> factors;
  };
} // namespace unilateral
