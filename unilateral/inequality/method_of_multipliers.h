// One solver for the penalty and the mixed method: the method of multipliers with a shift.
#pragma once

#include "unilateral/base/progress.h"
#include "unilateral/inequality/discrete_problem.h"

#include <string>
#include <vector>

namespace unilateral
{
  struct MultiplierParameters
  {
    double   epsilon = 0;      ///< penalty parameter; 0 is the mixed method (21)
    double   tolerance = 1e-8; ///< relative, on equilibrium (energy norm) and complementarity
    double   shift = 1e-3;     ///< r in units of the local compliance; the smaller, the fewer steps and the more round-off in lambda
    double   smallest_shift = 1e-9;
    unsigned patience = 40;            ///< Newton steps of one outer step after which another way is tried, see below
    double   largest_round_off = 1e-6; ///< relative residual or imbalance that rounding may leave; more is no solution
    unsigned polishing_steps = 10;     ///< at most, with R = tau, where a small shift cost lambda digits; if they lose the tolerance, the
                                       ///< state before them stands
    unsigned max_steps = 60;           ///< outer steps
    unsigned max_newton_steps = 200;   ///< over all outer steps
    double   data_round_off = 0;       ///< complementarity that the bounds themselves do not have, see data_round_off.h
  };

  /// The shift that measured best: small where the points are nodes, since a diagonal penalty spoils no preconditioner; a tenth of the
  /// compliance elsewhere, where a stiff penalty couples the unknowns of a cell and an algebraic multigrid does not see it.
  constexpr double suitable_shift(const bool at_nodes)
  {
    return at_nodes ? 1e-3 : 1e-1;
  }

  struct MultiplierResult
  {
    bool                    converged = false;
    std::string             reason;
    unsigned                outer_iterations = 0, linear_iterations = 0;
    std::size_t             flipped = 0;
    double                  equilibrium = 0;     ///< residual of A u + B'W lambda = f, relative to the energy norm of the solution
    double                  complementarity = 0; ///< see complementarity_residual(), relative
    std::vector<NewtonStep> history;             ///< all Newton steps

    /// The work of a later solve of the same system is added, its state replaces this one.
    MultiplierResult &operator+=(const MultiplierResult &later);
  };

  /// The method of multipliers
  ///     u_{k+1}      = argmin J(v) + 1/2 | (Bv - s + R lambda_k)^+ |^2  in the norm W (eps + R)^-1
  ///     lambda_{k+1} = (B u_{k+1} - s + R lambda_k)^+ / (eps + R)
  /// whose fixed point is exactly the penalty solution (7), (18) for eps > 0 and the mixed solution (21) for eps = 0. The shift R, a
  /// fraction of the local compliance, keeps the linear systems as well conditioned as A whatever eps is, and lambda never comes from
  /// a cancelling difference. Where eps alone is that large, R = 0 and one step is the penalty method itself. When a step gains less
  /// than a factor ten (rules with C_h = 0 or C_h ~ h^2), R is reduced. Where only contact holds the solution, or the form is not
  /// symmetric, and Newton's method loses patience, R is enlarged, up to tau. Elsewhere it starts from the solutions for shifts from as
  /// soft as the domain down to R, once.
  ///
  /// u and lambda are the start and the result. @p predicted_active, when not empty (N entries): the contact to start from, which is
  /// first improved around its boundary by relax_near_free_boundary(); see semismooth_newton().
  /// Where only contact holds the solution, lambda is then balanced with the load to the last digit, see restore_balance().
  /// What converges is held against objection_to_solution(), and not called converged where that objects.
  /// Throws Interrupted.
  MultiplierResult method_of_multipliers(DiscreteProblem            &problem,
                                         const MultiplierParameters &parameters,
                                         std::vector<bool>           predicted_active,
                                         Vector                     &u,
                                         Vector                     &lambda,
                                         Progress                   &progress);

  /// The natural residual c_i = lambda_i - (lambda_i + (Bu - s - eps lambda)_i / tau_i)^+ of the complementarity conditions
  /// lambda >= 0, Bu - s - eps lambda <= 0, lambda.(Bu - s - eps lambda) = 0, tau the local compliance; returns
  /// (sum w_i tau_i c_i^2)^1/2, which has the unit of the energy norm, and the same norm of lambda and of round-off.
  struct ComplementarityResidual
  {
    double norm = 0, lambda_norm = 0, round_off = 0;
  };
  ComplementarityResidual complementarity_residual(const DiscreteProblem &problem, double epsilon, const Vector &u, const Vector &lambda);
} // namespace unilateral
