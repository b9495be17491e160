// The paper's own bound (22) for a run.
#pragma once

#include "unilateral/discretisation/problem.h"
#include "unilateral/inequality/certificate.h"

namespace unilateral
{
  /// Fills `theorem3_bound`, the first inequality of (22): ||u_h - u_eps||_m <= (M/m) ||p_h||_0 eps / C_h in the full H^m norm, with C_h of
  /// all of Q_h and ||p_h||_0 from the certificate's step. Or says in `theorem3_reason` why there is none: C_h = 0, a not coercive, or more
  /// unknowns and points than can be looked at in passing.
  template <int dim>
  void add_theorem3_bound(Certificate &certificate, const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, double epsilon);
} // namespace unilateral
