// Which epsilon a run uses, and why.
#pragma once

#include "unilateral/inequality/certificate.h"
#include "unilateral/inequality/discrete_problem.h"
#include "unilateral/inequality/method.h"

#include <string>

namespace unilateral
{
  /// The user's epsilon, 0 for the mixed method, or "auto": an epsilon whose certified error is below a fraction of the
  /// discretisation error, or below [method] penalty_tolerance. The search begins at a thousandth of the local compliance tau (about
  /// h^2/k for a membrane) and goes down, by what the certified error asks for, until that holds. The cap keeps the penetration epsilon p
  /// out of sight in every norm, not only in the energy: it is a thousandth of tau p, which is what the mesh does to u; and a larger
  /// epsilon would not be cheaper to solve for. On a boundary tau is about h/E while the error of u is of order h^2: there the search
  /// begins at a millionth. Kept as a multiple of tau, epsilon scales with material and mesh, and units are irrelevant.
  class PenaltyParameter
  {
  public:
    struct Parameters
    {
      double   fraction = 0.1;             ///< of the discretisation indicator that the penalty may add
      double   largest_factor = 1e-3;      ///< epsilon / tau where the search begins, when the constraint acts in the domain,
      double   largest_on_boundary = 1e-6; ///< and on a boundary
      double   smallest_factor = 1e-9;     ///< where it ends when nothing is small enough
      double   uncertified_factor = 1e-6;  ///< where there is no certificate
      unsigned max_trials = 6;             ///< solves on the finest level
    };

    /// @p on_boundary: a constraint acts on a part of the boundary.
    explicit PenaltyParameter(const Method &method, const bool on_boundary = false) : PenaltyParameter(method, on_boundary, Parameters()) {}
    PenaltyParameter(const Method &method, bool on_boundary, const Parameters &parameters);

    /// Takes the compliance of the level's mesh.
    void start_level(const DiscreteProblem &problem);

    double epsilon() const { return value; }

    /// After a solve on the finest level: is it good enough? If not, epsilon has changed and the level is solved again.
    /// @p indicator is the discretisation error of estimator.h in the energy norm.
    bool accept(const Certificate &certificate, double indicator);

    /// One sentence for people.
    const std::string &reason() const { return explanation; }

  private:
    bool search() const { return method.formulation == Method::Formulation::penalty && !method.epsilon; }
    void set_factor(double new_factor);

    Method      method;
    Parameters  parameters;
    double      factor, tau = 1, value = 0;
    unsigned    trials = 0;
    std::string explanation;
  };

  /// The largest error bound that the case allows: [method] penalty_tolerance times the energy norm; infinity when it is not given.
  double asked_penalty_error(const Method &method, const Certificate &certificate);
} // namespace unilateral
