// Values of a discrete solution at single points.
#pragma once

#include "unilateral/discretisation/problem.h"
#include "unilateral/evaluation/estimator.h"
#include "unilateral/evaluation/run_result.h"

#include <deal.II/lac/la_parallel_vector.h>

namespace unilateral
{
  /// u at the [output] probes, with the stress of an elastic body as in @p flux, recovered from u, or the moments of a beam or plate; NaN
  /// outside the mesh, where Problem warns or throws before anything is solved.
  template <int dim>
  std::vector<ProbeResult>
  probe_values(const Problem<dim> &problem, const dealii::LinearAlgebra::distributed::Vector<double> &u, const RecoveredFlux<dim> &flux);

  /// Throws InputError that names every probe of the case that lies outside the mesh, by more than straight sides miss a curve.
  template <int dim>
  void check_probes(const Problem<dim> &problem);
} // namespace unilateral
