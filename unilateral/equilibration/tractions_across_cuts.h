// Tractions on the cuts between subdomains.
#pragma once

#include "unilateral/discretisation/cut_faces.h"
#include "unilateral/equilibration/face_tractions.h"
#include "unilateral/equilibration/rigid_motions.h"
#include "unilateral/equilibration/stress_balance.h"
#include "unilateral/equilibration/system_of_parts.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace unilateral
{
  /// What StressBalance finds for all cells at once is found in two steps where the mesh is divided: first tractions t on cuts, with which
  /// each part as a whole is in balance; then, by each process, those between its cells. Together they have the least sum of
  /// int |t_F|^2 / w_F over all faces F, as those that one process finds, but for what the iteration leaves. Of t that sum has the gradient
  /// t - w_F (mu_K - mu_L), in the scalar product that goes with it, mu_K and mu_L the motions of the cells on both sides, multipliers of
  /// the balance within each part for this t. Conjugate gradients find its minimum, with a solve of each process for a step; directions
  /// keep parts in balance, by motions alpha_p of the parts: w_F (alpha_p - alpha_q) is subtracted from them on the cut between processes p
  /// and q, where
  ///     sum over q of int_pq w (alpha_p - alpha_q).v + int_p w alpha_p.v = the work of the forces that the part p is short of, on v
  /// for all rigid body modes v and each p, int_pq over the common cut, int_p over the open directions of the boundary of the part, whose
  /// own balance puts forces there. That system has as many unknowns for each process as there are modes, and is singular in those of the
  /// whole body that nothing resists, in which the forces have to be in balance.
  template <int dim>
  class TractionsAcrossCuts
  {
  public:
    static constexpr unsigned n_modes = RigidMotions<dim>::n;

    /// @p body: of the whole, the same for all processes; @p within: the balance of the cells of this process, @p motions of these.
    /// Collective.
    TractionsAcrossCuts(const CutFaces<dim>                  &cuts,
                        const FaceTractions<dim>             &tractions,
                        const StressBalance<dim>             &within,
                        const std::vector<RigidMotions<dim>> &motions,
                        const RigidMotions<dim>              &body,
                        const Processes                      &processes);

    /// On a face of the part.
    struct OnFace
    {
      std::size_t     face;         ///< of the tractions
      Eigen::MatrixXd coefficients; ///< basis functions x directions
    };
    /// @p r: what cells are short of, n_modes numbers for each; @p r_of_part: all of them together, for each mode of the body. Collective.
    std::vector<OnFace> solve(std::vector<double> r, const Eigen::VectorXd &r_of_part) const;

  private:
    using Modes = Eigen::Matrix<double, int(n_modes), int(n_modes)>;
    struct CutFace
    {
      std::size_t       face, cell;
      unsigned          beyond;           ///< the process there
      RigidMotions<dim> frame;            ///< about the middle of the face, in which tractions are given
      Modes             products;         ///< of the modes of the frame, integrated over the face
      Modes             of_cell, of_body; ///< motions of the cell and of the body in terms of the frame
      double            weight;           ///< w_F, the same on both sides
    };
    /// In the frames of cut_faces, a column each: tractions, or motions.
    using OnCuts = Eigen::Matrix<double, int(n_modes), Eigen::Dynamic>;

    OnCuts          jumps(const std::vector<double> &mu) const; ///< of motions of the cells; collective
    OnCuts          weighted(OnCuts motions) const;
    OnCuts          between_parts(const Eigen::VectorXd &alpha) const; ///< w (alpha_p - alpha_q)
    Eigen::VectorXd force_on_part(const OnCuts &t) const;
    OnCuts          with_parts_in_balance(const OnCuts &t) const;    ///< collective
    double          product(const OnCuts &a, const OnCuts &b) const; ///< collective
    /// What cells are short of is less by the forces of @p t on them.
    void take_off(const OnCuts &t, std::vector<double> &r) const;

    const CutFaces<dim>                 &cuts;
    const FaceTractions<dim>            &tractions;
    const StressBalance<dim>            &within;
    const RigidMotions<dim>              body;
    const Processes                     &processes;
    std::vector<CutFace>                 cut_faces; ///< in the order of cuts.faces()
    std::unique_ptr<const SystemOfParts> system;
  };
} // namespace unilateral
