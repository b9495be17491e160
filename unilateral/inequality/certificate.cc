#include "unilateral/inequality/certificate.h"

#include "unilateral/algebra/dense_solvers.h"
#include "unilateral/inequality/round_off.h"
#include "unilateral/inequality/semismooth_newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace unilateral
{
  namespace
  {
    /// A bound at most so many times the length of the step to the mixed solution leaves nothing to gain.
    constexpr double sharp_enough = 1.1;

    /// The energy norm of rounding is at most so many times its norm in diag(A)^-1: the root of a condition number.
    constexpr double far_above_rounding = 1e4;

    /// The energy norm of a residual, (r'A^-1 r)^1/2.
    ///
    /// Where A vanishes on modes R of a body that only contact holds, A^-1 r means any x with A x = r, and there is one if r'R = 0. As
    /// many contact points as there are modes, chosen so that they stop each of them, serve as supports: they are statically
    /// determinate, so that they carry nothing of an r in balance, and x solves A x = r all the same. The multiplier at these points is
    /// changed by what brings r into balance.
    class ResidualNorm
    {
    public:
      ResidualNorm(DiscreteProblem &problem, const double shift, const Vector &lambda)
        : problem(problem), n_modes(problem.null_space().size())
      {
        problem.initialize_point_vector(support_stiffness);
        if (n_modes == 0)
          return;
        for (const Vector &mode : problem.null_space())
        {
          problem.initialize_point_vector(traces.emplace_back());
          problem.apply_trace(traces.back(), mode);
        }
        // Greedy: the point whose trace is the largest outside the span of those before, by its share of the contact force.
        Eigen::MatrixXd rest(n_modes, lambda.size());
        for (std::size_t k = 0; k < n_modes; ++k)
          for (std::size_t i = 0; i < lambda.size(); ++i)
            rest(k, i) = traces[k](i) * problem.weights()(i) * lambda(i);
        const double largest = lambda.size() > 0 ? rest.colwise().norm().maxCoeff() : 0;
        for (std::size_t k = 0; k < n_modes; ++k)
        {
          Eigen::Index i = 0;
          if (lambda.size() == 0 || rest.colwise().norm().maxCoeff(&i) <= 1e-8 * largest)
            return;
          const Eigen::VectorXd direction = rest.col(i).normalized();
          rest -= direction * (direction.transpose() * rest).eval();
          supports.push_back(i);
          support_stiffness(i) = problem.weights()(i) / (shift * problem.compliance()(i));
        }
        available = true;
      }

      /// Contact stops every mode.
      bool exists() const { return n_modes == 0 || available; }

      /// Changes lambda at the supports, and r = A u + B'W lambda - f with it, so that r'R = 0. False where lambda would become negative.
      bool balance(Vector &lambda, Vector &r) const
      {
        if (n_modes == 0)
          return true;
        Eigen::MatrixXd work(n_modes, n_modes);
        Eigen::VectorXd excess(n_modes);
        for (unsigned repetition = 0; repetition < 2; ++repetition) // once more for the rounding of the first
        {
          for (std::size_t k = 0; k < n_modes; ++k)
          {
            excess(k) = problem.dot(problem.null_space()[k], r);
            for (std::size_t i = 0; i < n_modes; ++i)
              work(k, i) = traces[k](supports[i]) * problem.weights()(supports[i]);
          }
          const Eigen::VectorXd change = work.fullPivLu().solve(-excess);
          Vector                at_points, BtW_change;
          problem.initialize_point_vector(at_points);
          problem.initialize_dof_vector(BtW_change);
          for (std::size_t i = 0; i < n_modes; ++i)
          {
            at_points(supports[i]) = change(i);
            lambda(supports[i]) += change(i);
            if (!(lambda(supports[i]) >= 0))
              return false;
          }
          problem.apply_trace_transpose(BtW_change, at_points);
          r += BtW_change;
        }
        return true;
      }

      /// Rounded up by what the linear solve leaves open.
      bool operator()(const Vector &r, double &norm)
      {
        norm = 0;
        if (problem.largest(r) == 0)
          return true;
        Vector z, Tz, trace, support;
        problem.initialize_dof_vector(z);
        problem.initialize_dof_vector(Tz);
        const LinearSolve solve = problem.solve_tangent(support_stiffness, r, {0, 1e-2}, z);
        problem.apply_stiffness(Tz, z);
        double on_supports = 0;
        if (n_modes > 0)
        {
          problem.initialize_point_vector(trace);
          problem.apply_trace(trace, z);
          for (const std::size_t i : supports)
            on_supports += support_stiffness(i) * trace(i) * trace(i);
        }
        // r'T^-1 r = 2 r'z - z'Tz + rest, rest >= 0 of second order in the residual of the solve.
        norm = 1.05 * std::sqrt(std::max(0., 2 * problem.dot(r, z) - problem.dot(z, Tz) - on_supports)) + solve.residual;
        return solve.converged && std::isfinite(norm);
      }

    private:
      DiscreteProblem         &problem;
      std::size_t              n_modes;
      std::vector<Vector>      traces; ///< B r for each mode
      std::vector<std::size_t> supports;
      Vector                   support_stiffness;
      bool                     available = false;
    };

    /// Moves a function of V_h into K_h by changes as small as they can be, in the norm of diag(B'WB).
    class MoveIntoConstraintSet
    {
    public:
      explicit MoveIntoConstraintSet(const DiscreteProblem &problem) : problem(problem)
      {
        for (Vector *q : {&excess, &image})
          problem.initialize_point_vector(*q);
        for (Vector *v : {&gradient, &step, &direction})
          problem.initialize_dof_vector(*v);
      }

      /// Onto the obstacle at the points of @p contact: conjugate gradients for min |Bv - s| there. At a rule of nodes one step is exact;
      /// where points contradict each other (rules with a kernel) a remainder stays.
      void onto(const std::vector<bool> &contact, Vector &v)
      {
        double previous = 0;
        for (unsigned iteration = 0; iteration < 80; ++iteration)
        {
          evaluate_excess(v);
          bool done = true;
          for (std::size_t i = 0; i < excess.size(); ++i)
          {
            done &= !contact[i] || std::abs(excess(i)) <= round_off;
            if (!contact[i])
              excess(i) = 0;
          }
          if (!problem.processes().any(!done))
            return;
          const double now = descent_step();
          if (now == 0)
            return;
          if (iteration == 0)
            direction = step;
          else
            direction.sadd(now / previous, 1., step);
          previous = now;
          problem.apply_trace(image, direction);
          for (std::size_t i = 0; i < image.size(); ++i)
            if (!contact[i])
              image(i) = 0;
          const double curvature = weighted(image, image);
          if (!(curvature > 0))
            return;
          v.add(weighted(image, excess) / -curvature, direction);
        }
      }

      /// Out of the obstacle everywhere: steepest descent on the excess over s - slack, the slack shrinking with the excess.
      bool out_of_obstacle(Vector &v)
      {
        for (unsigned iteration = 0; iteration < 400; ++iteration)
        {
          evaluate_excess(v);
          double worst = 0;
          for (std::size_t i = 0; i < excess.size(); ++i)
            worst = std::max(worst, excess(i) - round_off);
          worst = problem.processes().max(worst);
          if (worst <= 0)
            return true;
          for (std::size_t i = 0; i < excess.size(); ++i)
            excess(i) = excess(i) > round_off ? excess(i) + 0.1 * worst : 0.;
          if (descent_step() == 0)
            return false;
          problem.apply_trace(image, step);
          for (std::size_t i = 0; i < image.size(); ++i)
            if (excess(i) == 0)
              image(i) = 0;
          const double curvature = weighted(image, image);
          if (!(curvature > 0))
            return false;
          v.add(weighted(image, excess) / -curvature, step);
        }
        return false;
      }

      /// By how much v may be beyond the obstacle all the same.
      double round_off_met() const { return round_off; }

    private:
      void evaluate_excess(const Vector &v)
      {
        problem.apply_trace(excess, v);
        // The largest size met: a v that has become next to nothing still carries the rounding of what it was.
        // Components may cancel in Bv: v counts with its own size.
        round_off = std::max(round_off, 4 * std::numeric_limits<double>::epsilon() *
                                          (problem.largest(excess) + problem.largest(problem.obstacle()) + problem.largest(v)));
        excess -= problem.obstacle();
      }

      double weighted(const Vector &a, const Vector &b) const
      {
        return problem.sum_over_points([&](const std::size_t i) { return problem.weights()(i) * a(i) * b(i); });
      }

      /// step = diag(B'WB)^-1 B'W excess; returns its scalar product with the gradient.
      double descent_step()
      {
        problem.apply_trace_transpose(gradient, excess);
        const Vector &mass = problem.trace_mass();
        for (std::size_t j = 0; j < gradient.size(); ++j)
          step(j) = mass(j) > 0 ? gradient(j) / mass(j) : 0.;
        return problem.dot(step, gradient);
      }

      const DiscreteProblem &problem;
      Vector                 excess, image, gradient, step, direction;
      double                 round_off = 0;
    };
  } // namespace

  Certificate certify(
    DiscreteProblem &problem, const double epsilon, const double shift, const Vector &u, const Vector &given_lambda, Progress &progress)
  {
    Certificate certificate;
    if (!problem.symmetric())
    {
      certificate.reason = "the form a is not symmetric: there is no energy";
      return certificate;
    }
    Vector Au, residual, work, lambda(given_lambda);
    for (Vector *v : {&Au, &residual, &work})
      problem.initialize_dof_vector(*v);
    problem.apply_stiffness(Au, u);
    certificate.energy_norm = std::sqrt(std::abs(problem.dot(u, Au)));

    // A step of the method of multipliers for the mixed problem.
    AugmentedProblem mixed{problem, 0., problem.compliance(), lambda};
    mixed.shift *= shift;
    NewtonParameters newton;
    newton.tolerance = 1e-13 * certificate.energy_norm;
    // At rules that are not of nodes the bound is up to twice as large with 1e-2, and depends on the solver.
    newton.relative_tolerance = 1e-4;
    newton.max_steps = 20; // any v gives a bound: more steps would only sharpen it, and cost more than the solution did
    const double rounding_in_diagonal = smallest_round_off(problem, u, Au, lambda);
    Vector       v(u), Av(Au);
    semismooth_newton(mixed, newton, positive(lambda), v, Av, progress);
    Vector lambda_h(lambda);
    mixed.next_multiplier(lambda_h, v);

    problem.apply_trace_transpose(work, lambda);
    residual = Au;
    residual += work;
    residual -= problem.load();
    ResidualNorm dual_norm(problem, shift, lambda);
    if (!dual_norm.exists())
    {
      certificate.reason = "only contact holds the solution, and it is in contact at too few points to hold it firmly";
      return certificate;
    }
    if (!dual_norm.balance(lambda, residual) || !dual_norm(residual, certificate.algebraic_error))
    {
      certificate.reason = "the algebraic error could not be bounded";
      return certificate;
    }

    // The gap between a feasible v and the pair (u, lambda) with the residual r: 1/2 d'Ad + r'd + (lambda, s - Bv)_G, d = v - u.
    Vector difference(v), trace;
    problem.initialize_point_vector(trace);
    const auto gap_of = [&](const Vector &v, const Vector &u, const Vector &lambda, const Vector &r)
    {
      difference = v;
      difference -= u;
      problem.apply_stiffness(work, difference);
      problem.apply_trace(trace, v);
      const double complementarity = problem.sum_over_points(
        [&](const std::size_t i) { return problem.weights()(i) * lambda(i) * std::max(problem.obstacle()(i) - trace(i), 0.); });
      const double quadratic = 0.5 * problem.dot(difference, work), linear = problem.dot(r, difference);
      // Sums of many terms lose a few of the sixteen digits.
      return std::max(0., quadratic + linear + complementarity) + 1e-14 * (quadratic + std::abs(linear) + complementarity);
    };

    const Vector after_step(v);
    difference = after_step;
    difference -= u;
    problem.apply_stiffness(work, difference);
    const double step_length = std::sqrt(std::max(0., problem.dot(difference, work)));

    // What of the residual is rounding: of the kind that all rows share, or of any kind. Not looked for where the step is far above it.
    double rounding = 0;
    for (const bool alike : {true, false})
    {
      double norm = 0;
      if (step_length > far_above_rounding * rounding_in_diagonal)
        break;
      dual_norm(residual_round_off(problem, u, lambda, alike), norm);
      rounding = std::max(rounding, norm);
    }
    certificate.algebraic_error += rounding;

    // Contact is where the step says; where the pressure is not unique it may pass over points that carry lambda: they are tried as well.
    MoveIntoConstraintSet move(problem);
    std::vector<bool>     contact = positive(lambda_h), wider = contact;
    for (std::size_t i = 0; i < wider.size(); ++i)
      if (lambda(i) > 0)
        wider[i] = true;
    const auto least_gap = [&](const Vector &u, const Vector &lambda, const Vector &r)
    {
      double gap = std::numeric_limits<double>::infinity();
      for (const std::vector<bool> *const points : {&contact, &wider})
      {
        if (points == &wider && !problem.processes().any(wider != contact))
          break;
        v = after_step;
        move.onto(*points, v);
        if (move.out_of_obstacle(v))
          gap = std::min(gap, gap_of(v, u, lambda, r));
      }
      return gap;
    };
    const auto bound = [](const double gap, const double rho) { return std::sqrt(2 * gap + rho * rho) + rho; };
    certificate.energy_gap = least_gap(u, lambda, residual);
    if (std::isinf(certificate.energy_gap))
    {
      certificate.energy_gap = 0;
      certificate.reason = "no function of the constraint set was found near the solution";
      return certificate;
    }
    certificate.penalty_error_bound = bound(certificate.energy_gap, certificate.algebraic_error);

    // The state of the step is a pair of its own, (v, lambda_h): what is between it and u is known, and its gap bounds the rest. This is
    // the sharper way where lambda is far from every multiplier of the mixed method though u is close to u_h.
    if (certificate.penalty_error_bound > sharp_enough * step_length)
    {
      Vector &residual_of_step = Av;
      problem.apply_trace_transpose(work, lambda_h);
      residual_of_step += work;
      residual_of_step -= problem.load();
      double rho = 0;
      if (dual_norm.balance(lambda_h, residual_of_step) && dual_norm(residual_of_step, rho))
        certificate.penalty_error_bound =
          std::min(certificate.penalty_error_bound, step_length + bound(least_gap(after_step, lambda_h, residual_of_step), rho + rounding));
    }
    certificate.penalty_error_bound += bound_round_off(problem, wider, move.round_off_met());
    const double pressure_norm =
      problem.sum_over_points([&](const std::size_t i) { return problem.weights()(i) * lambda_h(i) * lambda_h(i); });
    certificate.lbb_free_bound = 0.5 * std::sqrt(epsilon * pressure_norm);
    certificate.available = true; // whatever v the step gave: it only decides how sharp the bound is
    return certificate;
  }
} // namespace unilateral
