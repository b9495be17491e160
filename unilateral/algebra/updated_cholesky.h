// One factorisation of A for all systems (A + B' D B) x = b with diagonal matrices D.
#pragma once

#include "unilateral/algebra/dense_solvers.h"
#include "unilateral/algebra/sparse_cholesky.h"
#include "unilateral/algebra/sparse_rows.h"
#include "unilateral/algebra/vector.h"

#include <deal.II/lac/sparse_matrix.h>

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace unilateral
{
  /// A is symmetric and at least positive semidefinite, B has few columns that are not zero: C of them, eliminated last. Woodbury's formula
  /// for P A P' = L L' needs no more than the last block L_22 of L: with Y = L_22^-1 B_C', computed once, and the rows i of B with D_ii >
  /// 0,
  ///
  ///     (A + B'DB)^-1 = P' L^-T (1 - Y_i (D_ii^-1 + Y_i'Y_i)^-1 Y_i') L^-1 P,
  ///
  /// so that another D costs a dense system of as many unknowns as it has entries. Where A is singular or nearly so the unknowns that hold
  /// its null space get stiff springs E E', which rows of the same kind with D = -1 take away again.
  class UpdatedCholesky
  {
  public:
    /// Orders the unknowns. Keeps references to A and B. @p modes: functions with little or no energy.
    UpdatedCholesky(const dealii::SparseMatrix<double> &A, const SparseRows &B, const std::vector<Vector> &modes);

    /// What factorise() will take: numbers, and multiplications and additions.
    double predicted_entries() const;
    double predicted_operations() const;

    /// Throws std::runtime_error when A is not positive definite together with the springs, or the memory does not suffice.
    void factorise();

    /// B A^-1 B', after factorise(); none where springs had to be added.
    const Eigen::MatrixXd *compliance() const { return springs.empty() ? &G : nullptr; }

    /// For D = diag(@p d), d >= 0.
    void set_diagonal(const Vector &d);

    /// x = (A + B'DB)^-1 b; nothing that makes sense where the matrix is singular.
    void solve(Vector &x, const Vector &b) const;

  private:
    const dealii::SparseMatrix<double>          &A;
    const SparseRows                             B;
    SparseCholesky::Additions                    springs;  ///< at the unknowns that hold the modes
    std::vector<dealii::types::global_dof_index> last;     ///< the columns of B that are not zero, and those of the springs
    SparseCholesky                               cholesky; ///< of A with the springs
    Eigen::MatrixXd                              Y;        ///< C x (N and springs)
    Eigen::MatrixXd                              G;        ///< Y'Y
    std::vector<std::size_t>                     chosen;   ///< the columns of Y that D asks for
    Eigen::MatrixXd                              Y_chosen; ///< those
    Eigen::PartialPivLU<Eigen::MatrixXd>         small;    ///< D^-1 + G, of those
  };
} // namespace unilateral
