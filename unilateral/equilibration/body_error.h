// The bound of the total error of elastic bodies.
#pragma once

#include "unilateral/discretisation/problem.h"
#include "unilateral/equilibration/total_error_parts.h"
#include "unilateral/evaluation/estimator.h"

#include <vector>

namespace unilateral
{
  /// For bodies in the plane or in space on meshes with straight cells. For v in K (FeasibleDisplacement), a pressure rho >= 0 and a
  /// symmetric stress tau in balance with the load but for an oscillation osc, with tau n = traction - pressure n - springs u_h - rho n
  /// where the displacement is free (EquilibratedTractions, CompositeStresses),
  ///     1/2 ||u - v||_a^2 + 1/2 ||C^(-1/2) (sigma(u) - tau)||^2 <= 1/2 ||C^(-1/2) (tau - sigma(v))||^2 + (rho, s - v.n) + (osc, v - u),
  /// and osc is orthogonal to the rigid body modes of each cell, so that |(osc, v - u)| is at most the sum of C_K ||osc||_K ||eps(v -
  /// u)||_K with Korn's constant. See "A bound of the total error" in doc/theory.md. @p u with its prescribed values; @p pressures:
  /// functions of V_h, by condition; @p flux: recovered from u. Throws InputError or std::domain_error where data have no value or a cell
  /// no stresses.
  template <int dim>
  TotalError body_error(const Problem<dim> &problem, const Vector &u, const std::vector<Vector> &pressures, const RecoveredFlux<dim> &flux);
} // namespace unilateral
