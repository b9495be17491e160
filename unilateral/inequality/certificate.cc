#include "unilateral/inequality/certificate.h"

#include "unilateral/inequality/move_into_constraint_set.h"
#include "unilateral/inequality/residual_norm.h"
#include "unilateral/inequality/round_off.h"
#include "unilateral/inequality/semismooth_newton.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace unilateral
{
  namespace
  {
    /// A bound at most so many times the length of the step to the mixed solution leaves nothing to gain.
    constexpr double sharp_enough = 1.1;

    /// The energy norm of rounding is at most so many times its norm in diag(A)^-1: the root of a condition number.
    constexpr double most_over_diagonal = 1e4;

    /// A part of a step that may be added to its bound unseen.
    constexpr double negligible = 0.01;

    /// What is lost of the energy norm of u - w when both are stored in double precision, relative to that of u.
    constexpr double digits = 1e-15;

    /// w, one step of the method of multipliers with eps = 0 from (u, lambda).
    struct StepToMixedSolution
    {
      Vector w, Aw, lambda; ///< lambda of w
    };

    StepToMixedSolution step_to_mixed_solution(DiscreteProblem &problem,
                                               const double     shift,
                                               const Vector    &u,
                                               const Vector    &Au,
                                               const Vector    &lambda,
                                               const double     energy_norm,
                                               Progress        &progress)
    {
      AugmentedProblem mixed{problem, 0., problem.compliance(), lambda};
      mixed.shift *= shift;
      NewtonParameters newton;
      newton.tolerance = 1e-13 * energy_norm;
      // At rules that are not of nodes the bound is up to twice as large with 1e-2, and depends on the solver.
      newton.relative_tolerance = 1e-4;
      newton.max_steps = 20; // any v gives a bound: more steps would only sharpen it, and cost more than the solution did
      StepToMixedSolution step{u, Au, lambda};
      semismooth_newton(mixed, newton, positive(lambda), step.w, step.Aw, progress);
      mixed.next_multiplier(step.lambda, step.w);
      return step;
    }

    /// A u + B'W lambda - f.
    Vector residual_of(const DiscreteProblem &problem, Vector Au, const Vector &lambda)
    {
      Vector contact_force;
      problem.initialize_dof_vector(contact_force);
      problem.apply_trace_transpose(contact_force, lambda);
      Au += contact_force;
      Au -= problem.load();
      return Au;
    }

    double energy_norm_of(const DiscreteProblem &problem, const Vector &v)
    {
      Vector Av;
      problem.initialize_dof_vector(Av);
      problem.apply_stiffness(Av, v);
      return std::sqrt(std::max(0., problem.dot(v, Av)));
    }

    /// The energy norm of what rounding may hide in the residual of (u, lambda), of the kind that all rows share, or of any kind.
    double norm_of_rounding(const DiscreteProblem &problem, ResidualNorm &norm_of, const Vector &u, const Vector &lambda)
    {
      double largest = 0;
      for (const bool alike : {true, false})
      {
        double norm = 0; // a bound whether the solve in it converged or not
        norm_of(residual_round_off(problem, u, lambda, alike), norm);
        if (!std::isfinite(norm))
          return norm;
        largest = std::max(largest, norm);
      }
      return largest;
    }

    /// The least duality gap [12] of doc/theory.md that is found with a v of K_h close to w.
    class DualityGap
    {
    public:
      /// Keeps references to the problem and to @p w. Contact is where the step to w says; where the pressure is not unique the step may
      /// pass over points that carry @p lambda: they are tried as well.
      DualityGap(const DiscreteProblem &problem, const Vector &w, const Vector &lambda_of_w, const Vector &lambda)
        : problem(problem), w(w), contact(positive(lambda_of_w)), wider_contact(contact), move(problem)
      {
        for (std::size_t i = 0; i < wider_contact.size(); ++i)
          if (lambda(i) > 0)
            wider_contact[i] = true;
        problem.initialize_dof_vector(A_difference);
        problem.initialize_point_vector(trace);
      }

      /// For (u, lambda) with the residual r; infinite where no v was found.
      double least(const Vector &u, const Vector &lambda, const Vector &r)
      {
        double gap = std::numeric_limits<double>::infinity();
        for (const std::vector<bool> *const points : {&contact, &wider_contact})
        {
          if (points == &wider_contact && !problem.processes().any(wider_contact != contact))
            break;
          v = w;
          move.onto(*points, v);
          if (move.out_of_obstacle(v))
            gap = std::min(gap, of_v(u, lambda, r));
        }
        return gap;
      }

      /// What rounding of the bounds s adds to an error bound.
      double bound_round_off() const { return unilateral::bound_round_off(problem, wider_contact, move.round_off_met()); }

    private:
      /// 1/2 d'Ad + r'd + (lambda, s - Bv)_G, d = v - u.
      double of_v(const Vector &u, const Vector &lambda, const Vector &r)
      {
        difference = v;
        difference -= u;
        problem.apply_stiffness(A_difference, difference);
        problem.apply_trace(trace, v);
        const double complementarity = problem.sum_over_points(
          [&](const std::size_t i) { return problem.weights()(i) * lambda(i) * std::max(problem.obstacle()(i) - trace(i), 0.); });
        const double quadratic = 0.5 * problem.dot(difference, A_difference), linear = problem.dot(r, difference);
        // Sums of many terms lose a few of the sixteen digits.
        return std::max(0., quadratic + linear + complementarity) + 1e-14 * (quadratic + std::abs(linear) + complementarity);
      }

      const DiscreteProblem &problem;
      const Vector          &w;
      std::vector<bool>      contact, wider_contact;
      MoveIntoConstraintSet  move;
      Vector                 v, difference, A_difference, trace;
    };

    /// Of ||u_h - u||_a: [13] of doc/theory.md.
    double bound_by_gap(const double gap, const double rho)
    {
      return std::sqrt(2 * gap + rho * rho) + rho;
    }
  } // namespace

  Certificate certify(
    DiscreteProblem &problem, const double epsilon, const double shift, const Vector &u, const Vector &given_lambda, Progress &progress)
  {
    Certificate certificate;
    const auto  not_available = [&](const std::string &reason)
    {
      certificate.reason = reason;
      return certificate;
    };
    if (!problem.symmetric())
      return not_available("the form a is not symmetric: there is no energy");
    Vector Au, lambda(given_lambda);
    problem.initialize_dof_vector(Au);
    problem.apply_stiffness(Au, u);
    certificate.energy_norm = std::sqrt(std::abs(problem.dot(u, Au)));
    const double rounding_in_diagonal = smallest_round_off(problem, u, Au, lambda);

    StepToMixedSolution step = step_to_mixed_solution(problem, shift, u, Au, lambda, certificate.energy_norm, progress);

    // rho = ||u - u*||_a, u* the minimum of the energy under the pressure lambda.
    Vector       residual = residual_of(problem, std::move(Au), lambda);
    ResidualNorm norm_of(problem, shift, lambda);
    if (!norm_of.exists())
      return not_available("only contact holds the solution, and it is in contact at too few points to hold it firmly");
    if (!norm_of.balance(lambda, residual) || !norm_of(residual, certificate.algebraic_error))
      return not_available("the algebraic error could not be bounded");
    // What of the residual is rounding. Where the step is far above it, a crude bound does.
    Vector to_w(step.w);
    to_w -= u;
    const double step_length = energy_norm_of(problem, to_w), most_rounding = most_over_diagonal * rounding_in_diagonal;
    const double rounding = most_rounding < negligible * step_length ? most_rounding : norm_of_rounding(problem, norm_of, u, lambda);
    if (!std::isfinite(rounding))
      return not_available("what rounding hides could not be bounded");
    certificate.algebraic_error += rounding;
    const double pressure_norm =
      problem.sum_over_points([&](const std::size_t i) { return problem.weights()(i) * step.lambda(i) * step.lambda(i); });
    certificate.lbb_free_bound = 0.5 * std::sqrt(epsilon * pressure_norm);

    // The pair (u, lambda).
    DualityGap   gap(problem, step.w, step.lambda, lambda);
    const double energy_gap = gap.least(u, lambda, residual);
    if (std::isinf(energy_gap))
      return not_available("no function of the constraint set was found near the solution");
    certificate.energy_gap = energy_gap;
    certificate.penalty_error_bound = bound_by_gap(certificate.energy_gap, certificate.algebraic_error);

    // The pair (w, lambda of w): what is between w and u is known, and its gap bounds the rest. This is the sharper way where lambda is far
    // from every multiplier of the mixed method though u is close to u_h.
    if (certificate.penalty_error_bound > sharp_enough * step_length)
    {
      Vector residual_of_w = residual_of(problem, std::move(step.Aw), step.lambda);
      double rho = 0;
      if (norm_of.balance(step.lambda, residual_of_w) && norm_of(residual_of_w, rho))
        certificate.penalty_error_bound = std::min(
          certificate.penalty_error_bound, step_length + bound_by_gap(gap.least(step.w, step.lambda, residual_of_w), rho + rounding));
    }
    // Of the bounds s, of u and of w, and of A.
    const double of_data = gap.bound_round_off() + digits * certificate.energy_norm + energy_round_off(problem, to_w);
    certificate.penalty_error_bound += of_data;
    certificate.round_off = 2 * rounding + of_data;
    certificate.available = true; // whatever v the step gave: it only decides how sharp the bound is
    return certificate;
  }
} // namespace unilateral
