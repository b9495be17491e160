// Tractions on the cuts between subdomains.
#pragma once

#include "unilateral/discretisation/cut_faces.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/equilibration/face_tractions.h"
#include "unilateral/equilibration/rigid_motions.h"
#include "unilateral/equilibration/system_of_parts.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace unilateral
{
  /// What StressBalance finds for all cells at once is found in two steps where the mesh is divided: first tractions on cuts, after which
  /// each part as a whole is in balance; then, by each process, those between its cells. The first are t = mu_p - mu_q on the cut between
  /// processes p and q, with a rigid body motion mu_p for each process:
  ///     sum over q of int_pq (mu_p - mu_q).v + int_p mu_p.v = r_p(v)    for all rigid body modes v and each p,
  /// int_pq over the common cut, int_p over the open directions of the boundary of the part (its own balance puts forces there): a
  /// symmetric system with as many unknowns for each process as there are modes, singular in those of the whole body that nothing resists,
  /// in which r has to be in balance.
  template <int dim>
  class TractionsAcrossCuts
  {
  public:
    static constexpr unsigned n_modes = RigidMotions<dim>::n;

    /// @p body: of the whole, the same for all processes. Collective.
    TractionsAcrossCuts(const Problem<dim>       &problem,
                        const CutFaces<dim>      &cuts,
                        const FaceTractions<dim> &tractions,
                        const RigidMotions<dim>  &body);

    /// On a face of the part.
    struct OnFace
    {
      std::size_t     face;         ///< of the tractions
      Eigen::MatrixXd coefficients; ///< basis functions x directions
    };
    /// @p r: what the part is short of, for each mode of the body. Collective.
    std::vector<OnFace> solve(const Eigen::VectorXd &r) const;

  private:
    struct CutFace
    {
      std::size_t face;
      unsigned    beyond; ///< the process there
    };
    /// Adds int (v_k in the @p directions).(v_l there) over a face.
    void add_products(std::size_t face, const std::vector<dealii::Tensor<1, dim>> &directions, Eigen::MatrixXd &matrix) const;

    const FaceTractions<dim>            &tractions;
    const RigidMotions<dim>              body;
    const Processes                     &processes;
    std::vector<CutFace>                 cut_faces;
    std::unique_ptr<const SystemOfParts> system;
  };
} // namespace unilateral
