// A bound of the distance to the solution of the continuous problem.
#pragma once

#include "unilateral/discretisation/problem.h"
#include "unilateral/equilibration/total_error_parts.h"
#include "unilateral/evaluation/estimator.h"
#include "unilateral/evaluation/run_result.h"

#include <vector>

namespace unilateral
{
  /// Of bodies see body_error(). For membranes without velocity on meshes with straight cells. For v in K and a flux y whose divergence
  /// balances the load, a pressure rho >= 0 and the reaction, but for an oscillation osc with mean zero on cells,
  ///     1/2 ||u - v||^2 + 1/2 ||k^(-1/2) (k grad u - y)||^2 <= 1/2 ||k^(-1/2) (y - k grad v)||^2 + (rho, v - psi) + (osc, v - u),
  /// and |(osc, v - u)| <= sum of h_K/pi ||k^(-1/2) osc||_K ||u - v||_K. See "A bound of the total error" in doc/theory.md.
  /// v is a FeasibleState; y takes its normal flux from @p flux, the recovered one, balanced by FaceBalance, and is chosen on each cell so
  /// that the misfit is least. @p u with its prescribed values; @p pressures: functions of V_h, by block of the constraint set.
  template <int dim>
  TotalError
  total_error(const Problem<dim> &problem, const Vector &u, const std::vector<Vector> &pressures, const RecoveredFlux<dim> &flux);

  /// What a run says of its error: the bound where there is one; else the indicator of the mesh's error, which is an estimate, together
  /// with what the certificate bounds. The parts add up: what the certificate does not explain is the mesh's.
  Estimate estimate_of(const TotalError &total, const Certificate &certificate, double discretisation_indicator, double epsilon);
} // namespace unilateral
