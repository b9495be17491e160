// Tractions through faces that balance the force and the moment that each cell is short of.
#pragma once

#include "unilateral/algebra/sparse_cholesky.h"
#include "unilateral/base/processes.h"
#include "unilateral/equilibration/face_tractions.h"
#include "unilateral/equilibration/rigid_motions.h"

#include <optional>
#include <vector>

namespace unilateral
{
  /// The tractions t_F, one for each face F, linear on it and zero but in its open directions, with
  ///     sum over the faces of K of +-int t_F.v = r_K(v)    for all rigid body modes v of each cell K
  /// and the least sum of int |t_F|^2 / w_F, w_F about E / (distance of the cells' centres). With rigid motions mu_K of the cells as
  /// multipliers, t_F is w_F times the projection of the jump of mu, and mu solves a symmetric system with as many unknowns for each cell
  /// as there are modes. Motions of the body as a whole that no open direction of its boundary resists must find r in balance.
  template <int dim>
  class StressBalance
  {
  public:
    static constexpr unsigned n_modes = RigidMotions<dim>::n;

    /// @p motions, @p stiffness by active cell; @p free: free_modes() of these cells. Throws std::runtime_error where the system cannot be
    /// factorised.
    StressBalance(const FaceTractions<dim>             &tractions,
                  const std::vector<RigidMotions<dim>> &motions,
                  const std::vector<double>            &stiffness,
                  const Eigen::MatrixXd                &free,
                  const RigidMotions<dim>              &body);

    /// The modes of the body that @p processes share, in terms of @p body, that no open direction resists; columns are orthonormal.
    /// Collective.
    static Eigen::MatrixXd free_modes(const FaceTractions<dim> &tractions, const RigidMotions<dim> &body, const Processes &processes);

    /// mu, n_modes numbers by cell, as many as @p r.
    std::vector<double> multipliers(const std::vector<double> &r) const;

    /// Adds the tractions. @p r: what is left of it afterwards.
    void solve(FaceTractions<dim> &tractions, std::vector<double> &r) const;

    /// w_F of a face; on a cut between processes that of the cell on this side alone.
    double weight(const std::size_t face) const { return weights[face]; }

  private:
    void          factorise(const FaceTractions<dim> &tractions, const Eigen::MatrixXd &free, const RigidMotions<dim> &body);
    const double *coupling(const std::size_t member, const unsigned row) const { return &couplings[starts[member] + row * n_modes]; }

    const std::vector<RigidMotions<dim>> &motions;
    std::vector<double>                   couplings, weights; ///< by member: open directions x dim functions x modes; by face
    std::vector<std::size_t>              starts;
    std::optional<SparseCholesky>         factors;
  };
} // namespace unilateral
