// The forces that act at the unknowns of a discrete solution.
#pragma once

#include "unilateral/constraints/constraint_set.h"
#include "unilateral/discretisation/element_systems.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/inequality/discrete_problem.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace unilateral
{
  /// What one local system makes of A u - f.
  struct LocalForces
  {
    const std::vector<dealii::types::global_dof_index> &dofs;
    const Eigen::VectorXd                              &u, &Au;   ///< at these
    const Eigen::VectorXd                              &diagonal; ///< of A
    const Eigen::VectorXd                              &summands; ///< the sizes of what is summed up for Au
    const dealii::Vector<double>                       *load;     ///< nullptr: none
    bool                                                springs;  ///< of boundary faces and points
  };

  /// Visits all of them, on the own part of the mesh.
  template <int dim>
  void for_each_local_force(const Problem<dim> &problem, const Vector &u, const std::function<void(const LocalForces &)> &visit);

  /// What acts at each unknown. On cuts between subdomains: what the own cells and points make of it, the sum over all unknowns of all
  /// processes being the whole.
  struct ForcesAtUnknowns
  {
    Vector load;     ///< f; like the others zero at hanging nodes, which hand on what acts there
    Vector springs;  ///< minus what boundary faces and points have in A u
    Vector contact;  ///< -B'W lambda
    Vector missing;  ///< A u + B'W lambda - f: what supports bear
    Vector diagonal; ///< of A
    Vector summands; ///< the sizes of what is summed up for A u
  };

  /// Nodes that are tied to others (NodeCouplings) have what acts on them there.
  template <int dim>
  ForcesAtUnknowns
  forces_at_unknowns(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const Vector &u, const Vector &lambda);

  /// Hands what acts at images and nodes of platens on to the unknowns that they follow: what is left does the same work on every
  /// displacement that the ties permit.
  template <int dim>
  void hand_over_at_ties(const Problem<dim> &problem, Vector &force);

  /// Which unknowns those are.
  template <int dim>
  std::vector<bool> tied_unknowns(const Problem<dim> &problem);
} // namespace unilateral
