// How far the computed penalty solution is from the mixed one: a guaranteed bound from the duality gap.
#pragma once

#include "unilateral/base/progress.h"
#include "unilateral/inequality/discrete_problem.h"

#include <optional>
#include <string>

namespace unilateral
{
  /// A bound of || u_h - u ||_a, u_h the solution of the mixed method (21) on the same V_h and K_h, u what was computed: the penalty's
  /// error and the algebraic one together. All norms are energy norms, ||v||_a^2 = a(v, v).
  struct Certificate
  {
    bool        available = false;
    std::string reason; ///< why it is not available

    double                energy_gap = 0;          ///< 1/2 d'Ad + r'd + (lambda, s - Bv)_G, the duality gap for a feasible v, see certify()
    double                penalty_error_bound = 0; ///< of || u_h - u ||_a, the smaller of the two that certify() finds
    double                algebraic_error = 0;     ///< (r' A^-1 r)^1/2, r = A u + B'W lambda - f, and what rounding hides of it
    double                round_off = 0;           ///< what rounding alone adds to that bound: no solver can make it smaller
    double                lbb_free_bound = 0; ///< 1/2 sqrt(eps) ||lambda_h||_0: Theorem 3 without C_h, from the term that its proof drops
    std::optional<double> theorem3_bound;     ///< (22), of ||u_h - u||_m: see theorem3_bound.h
    std::string           theorem3_reason;    ///< why there is none

    double energy_norm = 0; ///< ||u||_a without its Dirichlet lift, for relative figures
  };

  /// For any v in K_h and lambda >= 0, with r = A u + B'W lambda - f and d = v - u,
  ///     1/2 || u_h - u ||^2  <=  1/2 d'Ad + r'd + (lambda, s - Bv)_G      (r = 0)
  /// which is the duality gap J(v) - [ J(u) + (1/eps) I_G(((u - s)^+)^2) ] written so that nothing cancels. A residual r adds
  /// rho = (r'A^-1 r)^1/2:  || u_h - u || <= (2 gap + rho^2)^1/2 + rho. The bound is sharp when v is close to u_h: v is one step of the
  /// method of multipliers with eps = 0 from (u, lambda), moved onto the obstacle where that step sees contact and below it elsewhere.
  /// Where the bound is far from the length of that step, its state is taken as a second pair with a gap of its own; what lies between it
  /// and u is added, and the smaller bound counts.
  /// @p shift: of that step, in units of the local compliance.
  /// What rounding can hide in r and in the bounds s is added, see round_off.h. With an iterative linear solver rho is computed to five per
  /// cent and rounded up.
  /// Not available when a is not symmetric: there is no energy. Where only contact holds the solution, ||.||_a does not see it move as a
  /// whole: the bound is of everything else. It needs an r that does no work on such modes, which a change of lambda within the
  /// solver's tolerance gives.
  /// Reference: I. Ekeland, R. Temam, Convex Analysis and Variational Problems, ch. III; S. Repin, A Posteriori Estimates for PDEs, ch. 8.
  Certificate certify(DiscreteProblem &problem, double epsilon, double shift, const Vector &u, const Vector &lambda, Progress &progress);
} // namespace unilateral
