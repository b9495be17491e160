// Integrals of a discrete solution: energy, norms, errors against an exact solution, values at points.
#pragma once

#include "unilateral/discretisation/problem.h"
#include "unilateral/evaluation/estimator.h"
#include "unilateral/evaluation/run_result.h"

#include <deal.II/lac/la_parallel_vector.h>

namespace unilateral
{
  struct SolutionNorms
  {
    double energy = 0; ///< 1/2 a(u,u) - f(u), boundary flux and springs included
    double L2 = 0, H1_semi = 0;
    double H2_semi = 0;      ///< m = 2; cell by cell
    double min = 0, max = 0; ///< over the nodes, and the components of u
  };

  template <int dim>
  SolutionNorms solution_norms(const Problem<dim> &problem, const dealii::LinearAlgebra::distributed::Vector<double> &u);

  /// max (u - bound)^+ (of a lower bound (bound - u)^+) over a lattice in every cell, four times as fine as the nodes.
  template <int dim>
  double largest_violation(const Problem<dim>                                       &problem,
                           const UnilateralCondition                                &condition,
                           const dealii::LinearAlgebra::distributed::Vector<double> &u);

  /// Errors against [exact]: L2 and H1 seminorm by quadrature of degree p + 3 points a direction, max and mean over all nodes of V_h and
  /// the components of u,
  /// pressure in I_G(.^2)^(1/2) over the points of the first constraint.
  template <int dim>
  Errors solution_errors(const Problem<dim>                                       &problem,
                         const ConstraintSet<dim>                                 &constraint_set,
                         const dealii::LinearAlgebra::distributed::Vector<double> &u,
                         const dealii::LinearAlgebra::distributed::Vector<double> &contact_pressure);

  /// u at the [output] probes, with the stress of an elastic body as in @p flux, recovered from u, or the moments of a beam or plate; NaN
  /// outside the mesh, where Problem warns or throws before anything is solved.
  template <int dim>
  std::vector<ProbeResult>
  probe_values(const Problem<dim> &problem, const dealii::LinearAlgebra::distributed::Vector<double> &u, const RecoveredFlux<dim> &flux);

  /// Throws InputError that names every probe of the case that lies outside the mesh, by more than straight sides miss a curve.
  template <int dim>
  void check_probes(const Problem<dim> &problem);
} // namespace unilateral
