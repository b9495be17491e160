// The error of a number computed from the solution: a contact force, a reaction, or u at a point.
#pragma once

#include "unilateral/discretisation/problem.h"
#include "unilateral/evaluation/estimator.h"
#include "unilateral/evaluation/run_result.h"
#include "unilateral/inequality/discrete_problem.h"

#include <vector>

namespace unilateral
{
  /// Throws InputError where the goal of mesh.adapt is a number that the problem does not have, or one whose error cannot be estimated: the
  /// adjoint of a form with a velocity is another form.
  template <int dim>
  void check_goal(const Problem<dim> &problem);

  struct GoalError
  {
    Estimate::Goal estimate;
    std::vector<double>
      cell_squares; ///< by active cell: the product of the indicators of u and z; empty where there is no adjoint solution
  };

  /// The error of the goal J(u), estimated with the adjoint solution z of the problem on its contact set,
  ///     a(v, z) + r . v = J(v) for all v, z = 0 in contact;     for the contact force J = 0 here, z = 1 in contact,
  ///                                                             for a reaction J = 0 here, z = -1 where the support holds the body,
  /// with forces r in contact. Where the contact set is that of u,
  ///     J(u) - J(u_h) = a(u - u_h, z - z_h) + r . (s - u_h) - int k dz/dn (g - u_h).
  /// The fluxes of both errors are estimated by recovery: on each cell
  ///     e_K = int_K (G(u_h) - q(u_h)) . C^-1 (G(z_h) - q(z_h)) + its part of the other terms,
  /// which are computed for membranes: bounds s in the domain and prescribed values g that are no functions of V_h. The error given is
  /// sum |e_K|, what the end of contact may change between two points of I_G, what a finer rule makes of data that jump within cells
  /// (work_of_unresolved_load()), and what penalty and solver add, their certified bound times
  /// the energy norm of z. Nothing of this is
  /// guaranteed. @p u with its prescribed values, @p flux recovered from it.
  /// References: R. Becker, R. Rannacher, Acta Numerica 10 (2001) 1-102; for inequalities: H. Blum, F.-T. Suttmeier, Computing 65 (2000)
  /// 119-134. See "The error of a number" in doc/theory.md.
  template <int dim>
  GoalError goal_error(const Problem<dim>       &problem,
                       DiscreteProblem          &discrete,
                       const ConstraintSet<dim> &K_h,
                       const Vector             &u,
                       const Vector             &lambda,
                       const RecoveredFlux<dim> &flux,
                       double                    penalty_error_bound);
} // namespace unilateral
