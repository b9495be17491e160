// (q, v) between pressures at the points of I_G and the functions of V_h, as matrices: what the inf-sup constants are made of.
#pragma once

#include "unilateral/constraints/constraint_set.h"
#include "unilateral/discretisation/points_by_cell.h"
#include "unilateral/discretisation/problem.h"

#include <Eigen/SparseCore>

#include <memory>
#include <optional>
#include <vector>

namespace unilateral
{
  using SparseMatrixd = Eigen::SparseMatrix<double>;

  /// The unknowns that no Dirichlet data fix, numbered on their own.
  class FreeUnknowns
  {
  public:
    template <int dim>
    explicit FreeUnknowns(const Problem<dim> &problem);

    int n_free = 0;
    int operator[](const dealii::types::global_dof_index dof) const { return number[dof]; } ///< -1: fixed

    /// The rows and columns of the free unknowns.
    SparseMatrixd restricted(const dealii::SparseMatrix<double> &matrix) const;

  private:
    std::vector<int> number;
  };

  /// (q, v) for q with values at N points and v in a space with n free unknowns.
  struct Pairing
  {
    SparseMatrixd gram;        ///< H (n x n): the full H^m inner product
    SparseMatrixd functionals; ///< n x N; column i is v -> (q_i, v), q_i = 1/sqrt(w_i) at its point and 0 at the others: ||q_i||_0 = 1
  };

  /// Which (q, v) is meant.
  enum class PairingKind
  {
    by_rule, ///< I_G(q v): what the discrete problem (7), (21) uses
    by_L2    ///< the integral of q v, q the polynomial on each cell that takes its values at the points; the same where (14) holds
  };

  /// On V_h. @p zone: the points that q may use (N flags); the columns are those points in order.
  /// by_L2 needs a rule with all its points inside the cells that is unisolvent for a polynomial space: see has_polynomials().
  template <int dim>
  Pairing
  make_pairing(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const std::vector<bool> &zone, PairingKind kind);

  /// For gauss(n) on segments, quadrilaterals and hexahedra, and with 1 or dim + 1 points on simplices, of the first block.
  template <int dim>
  bool has_polynomials(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set);

  /// The same functionals on a space that is richer than V_h, to compute the dual norm ||q||_{-m} = sup (q, v)/||v||_m: each cell halved
  /// and degree 8 in 1-D, degree p + 1 (P3 at most) in 2-D and 3-D; for Hermite elements each cell cut in three a direction,
  /// in fifteen on a beam for by_L2. For by_L2 the
  /// norm is right to about three digits for the modes that decide. For point values it is the norm over that space: in 1-D up to 4 % below
  /// the true one (none for P1, P2 with their nodal rule); in 2-D and 3-D, where a point mass has no H^-1 norm, a norm that depends on the
  /// mesh as those of V_h do. The coarse mesh is built anew with the same refinements: @p problem must come from its own `statement`.
  template <int dim>
  Pairing
  make_dual_pairing(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const std::vector<bool> &zone, PairingKind kind);

  /// About how many unknowns that richer space has.
  template <int dim>
  std::size_t n_dual_unknowns(const Problem<dim> &problem);

  /// The flags without those of points that feel the same as an earlier one: the second side of a constraint, another obstacle for the
  /// same part.
  template <int dim>
  std::vector<bool> each_point_once(const ConstraintSet<dim> &constraint_set, std::vector<bool> flags);
} // namespace unilateral
