#include "unilateral/semismooth_newton.h"

#include "unilateral/local_relaxation.h"

#include <Eigen/Eigenvalues>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

namespace unilateral
{
  void AugmentedProblem::shifted_gap(Vector &g, const Vector &u) const
  {
    problem.apply_trace(g, u);
    const double *const __restrict s = problem.obstacle().begin(), *const __restrict r = shift.begin(),
                                   *const __restrict lambda = multiplier.begin();
    double *const __restrict gap = g.begin();
    for (std::size_t i = 0, n = g.locally_owned_size(); i < n; ++i)
      gap[i] += r[i] * lambda[i] - s[i];
  }

  void AugmentedProblem::next_multiplier(Vector &next, const Vector &u) const
  {
    shifted_gap(next, u);
    const double *const __restrict r = shift.begin();
    double *const __restrict lambda = next.begin();
    for (std::size_t i = 0, n = next.locally_owned_size(); i < n; ++i)
      lambda[i] = std::max(lambda[i], 0.) / (epsilon + r[i]);
  }

  std::vector<bool> positive(const Vector &q)
  {
    std::vector<bool> active(q.size());
    for (std::size_t i = 0; i < q.size(); ++i)
      active[i] = q(i) > 0;
    return active;
  }

  double exact_line_search(
    const double slope, const double curvature, const Vector &c, const Vector &g, const Vector &b, const Processes &processes)
  {
    // Up to t = 2 the derivative is that at t = 0 but for the few points that change sides on the way: one pass over all finds them.
    struct Crossing
    {
      double c, g, b;
    };
    constexpr double      known_up_to = 2;
    std::vector<Crossing> crossings;
    double                at_0[2] = {0, 0};
    const std::size_t     n = c.locally_owned_size();
    const double *const __restrict c_of = c.begin(), *const __restrict g_of = g.begin(), *const __restrict b_of = b.begin();
    for (std::size_t i = 0; i < n; ++i)
    {
      const double gap = g_of[i], change = b_of[i];
      if (gap > 0)
      {
        at_0[0] += c_of[i] * gap * change;
        at_0[1] += c_of[i] * change * change;
      }
      if ((gap > 0) != (gap + known_up_to * change > 0))
        crossings.push_back({c_of[i], gap, change});
    }
    processes.sum(at_0, 2);
    // The derivative of the energy at t and its own.
    const auto derivative = [&](const double t)
    {
      double sums[2] = {0, 0};
      if (t <= known_up_to)
      {
        for (const auto &point : crossings)
        {
          const double gap = point.g + t * point.b;
          if ((gap > 0) == (point.g > 0))
            continue;
          const double sign = gap > 0 ? 1 : -1;
          sums[0] += sign * point.c * gap * point.b;
          sums[1] += sign * point.c * point.b * point.b;
        }
        processes.sum(sums, 2);
        return std::pair(slope + at_0[0] + t * (curvature + at_0[1]) + sums[0], curvature + at_0[1] + sums[1]);
      }
      for (std::size_t i = 0; i < n; ++i)
        if (const double gap = g_of[i] + t * b_of[i]; gap > 0)
        {
          sums[0] += c_of[i] * gap * b_of[i];
          sums[1] += c_of[i] * b_of[i] * b_of[i];
        }
      processes.sum(sums, 2);
      return std::pair(slope + t * curvature + sums[0], curvature + sums[1]);
    };
    // Newton's method on a convex-by-pieces linear function, kept inside a bracket: it ends on the right piece after a few steps.
    const double start = std::abs(slope + at_0[0]);
    double       lower = 0, upper = std::numeric_limits<double>::infinity(), t = 1;
    for (unsigned step = 0; step < 100; ++step)
    {
      const auto [value, second] = derivative(t);
      if (std::abs(value) <= 1e-8 * start)
        break;
      (value < 0 ? lower : upper) = t;
      double next = second > 0 ? t - value / second : 2 * t;
      if (!(next > lower && next < upper))
        next = std::isfinite(upper) ? 0.5 * (lower + upper) : 2 * t;
      if (std::abs(next - t) <= 1e-15 * t)
        break;
      t = next;
    }
    return t;
  }

  namespace
  {
    /// Which points take part: quicker than bits.
    using PointSet = std::vector<unsigned char>;

    /// What Newton's method knows at a point u: everything is updated along a step, nothing is evaluated twice.
    class NewtonIteration
    {
    public:
      NewtonIteration(const AugmentedProblem &augmented, Vector &u, Vector &Au)
        : augmented(augmented), problem(augmented.problem), u(u), Au(Au)
      {
        for (Vector *v : {&residual, &solution, &A_solution, &direction, &A_direction})
          problem.initialize_dof_vector(*v);
        for (Vector *q : {&gap, &gap_of_solution, &gap_change, &penalty, &stiffness_of_penalty})
          problem.initialize_point_vector(*q);
        augmented.shifted_gap(gap, u);
        n_points = gap.locally_owned_size();
        active.resize(n_points);
        const double *const w = problem.weights().begin(), *const r = augmented.shift.begin(), *const g = gap.begin();
        double *const c = penalty.begin();
        for (std::size_t i = 0; i < n_points; ++i)
        {
          active[i] = g[i] > 0;
          c[i] = w[i] / (augmented.epsilon + r[i]);
        }
        for (const Vector &motion : problem.kernel())
        {
          problem.initialize_point_vector(traces_of_kernel.emplace_back());
          problem.apply_trace(traces_of_kernel.back(), motion);
        }
      }

      /// residual = f - A u - B' W (g on @p set) / (eps + R); with the true active set that is minus the gradient of the energy.
      void evaluate_residual(const PointSet &set)
      {
        evaluate_pressure(set);
        problem.apply_trace_transpose(work, pressure);
        const double *const __restrict f = problem.load().begin(), *const __restrict Au_of = Au.begin(),
                                       *const __restrict force = work.begin();
        double *const __restrict r = residual.begin();
        for (std::size_t j = 0, n = residual.locally_owned_size(); j < n; ++j)
          r[j] = f[j] - Au_of[j] - force[j];
      }

      /// Do the points of @p set stop every motion on which A vanishes? One point under a body that can roll does not.
      bool holds_kernel(const PointSet &set) const
      {
        const std::size_t n = traces_of_kernel.size();
        Eigen::MatrixXd   all = Eigen::MatrixXd::Zero(n, n), held = all;
        for (std::size_t i = 0; i < set.size(); ++i)
          for (std::size_t k = 0; k < n; ++k)
            for (std::size_t l = 0; l < n; ++l)
            {
              const double product = traces_of_kernel[k](i) * traces_of_kernel[l](i);
              all(k, l) += product;
              if (set[i])
                held(k, l) += product;
            }
        const double scale = all.diagonal().sum() / std::max<std::size_t>(1, set.size());
        return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(held, Eigen::EigenvaluesOnly).eigenvalues()(0) > 1e-9 * scale;
      }

      /// An inexact solution is combined with the direction of the step before to what is best on @p set: while the active set changes
      /// little, steps are those of conjugate gradients.
      LinearSolve solve_for_direction(const PointSet &set, const SolveTolerance &tolerance)
      {
        // Without a hold, as if everything were in contact: the step is short, but in a direction that exists.
        const bool everywhere = !traces_of_kernel.empty() && !holds_kernel(set);
        const double *const __restrict c = penalty.begin();
        double *const __restrict on_set = stiffness_of_penalty.begin();
        for (std::size_t i = 0; i < n_points; ++i)
          on_set[i] = set[i] || everywhere ? c[i] : 0.;
        solution = 0.;
        const LinearSolve solve = problem.solve_tangent(stiffness_of_penalty, residual, tolerance, solution, &A_solution);
        problem.apply_trace(gap_of_solution, solution);
        if (has_direction && solve.iterations > 0 && problem.symmetric() && combine_with_last_direction())
          return solve;
        direction.swap(solution);
        A_direction.swap(A_solution);
        gap_change.swap(gap_of_solution);
        has_direction = true;
        curvature = problem.dot(direction, A_direction);
        descent = problem.dot(direction, residual);
        return solve;
      }

      double energy_step_length()
      {
        const double slope = problem.dot(direction, Au) - problem.dot(direction, problem.load());
        return exact_line_search(slope, curvature, counted(penalty), gap, gap_change, problem.processes());
      }

      /// Halves the step until the residual falls (in the norm of the inverse diagonal of A); 2^-10 when it never does.
      double residual_step_length()
      {
        const double before = scaled_residual_norm(0);
        double       t = 1;
        for (; t > 1e-3; t *= 0.5)
          if (scaled_residual_norm(t) < (1 - 1e-4 * t) * before)
            break;
        return t;
      }

      /// Returns how many points changed sides.
      std::size_t move(const double t)
      {
        const double *const __restrict p = direction.begin(), *const __restrict Ap = A_direction.begin(),
                                       *const __restrict Bp = gap_change.begin();
        double *const __restrict u_of = u.begin(), *const __restrict Au_of = Au.begin(), *const __restrict g = gap.begin();
        for (std::size_t j = 0, n = u.locally_owned_size(); j < n; ++j)
        {
          u_of[j] += t * p[j];
          Au_of[j] += t * Ap[j];
        }
        std::uint64_t flipped = 0;
        unsigned char *const __restrict side = active.data();
        for (std::size_t i = 0; i < n_points; ++i)
        {
          g[i] += t * Bp[i];
          const unsigned char now = g[i] > 0;
          flipped += now != side[i] && problem.owns_point(i);
          side[i] = now;
        }
        return problem.processes().sum(flipped);
      }

      /// Where a step ends on another active set the boundary of that is not where it belongs: see relax_near_free_boundary().
      void relax()
      {
        std::vector<bool> set(active.begin(), active.end());
        relax_near_free_boundary(augmented, set, u);
        problem.apply_stiffness(Au, u);
        augmented.shifted_gap(gap, u);
        const double *const g = gap.begin();
        for (std::size_t i = 0; i < n_points; ++i)
          active[i] = g[i] > 0;
      }

      /// The energy curves upward and falls along Newton's direction, unless a is not coercive.
      bool shows_lack_of_coercivity() const
      {
        const double round_off = 1e-10 * (std::abs(curvature) + std::abs(descent));
        return curvature < -round_off || descent < -round_off;
      }

      /// What rounding leaves of the residual of an exact solution, in the norm of diag(A)^-1; the energy norm of smooth parts of it is
      /// larger, hence the factor.
      double round_off()
      {
        evaluate_pressure(active);
        problem.apply_trace_transpose(work, pressure);
        const double sum = problem.sum_over_unknowns(
          [&](const std::size_t j)
          {
            const double diagonal = problem.stiffness_diagonal()(j);
            const double terms = std::abs(problem.load()(j)) + std::abs(Au(j)) + std::abs(work(j)) + 2 * diagonal * std::abs(u(j));
            return terms * terms / diagonal;
          });
        return 32 * std::numeric_limits<double>::epsilon() * std::sqrt(sum);
      }

      std::size_t n_active() const
      {
        return std::llround(problem.sum_over_points([&](const std::size_t i) { return double(active[i]); }));
      }
      double decrement() const { return std::sqrt(std::abs(descent)); }

      PointSet active;

    private:
      void evaluate_pressure(const PointSet &set)
      {
        const double *const __restrict g = gap.begin(), *const __restrict r = augmented.shift.begin();
        double *const __restrict p = pressure.begin();
        for (std::size_t i = 0; i < n_points; ++i)
          p[i] = set[i] ? g[i] / (augmented.epsilon + r[i]) : 0.;
      }

      /// direction <- a solution + b direction with the least energy on the active set for which the system was solved.
      bool combine_with_last_direction()
      {
        double        of_penalty[3] = {0, 0, 0};
        const Vector &stiffness = counted(stiffness_of_penalty);
        const double *const __restrict c = stiffness.begin(), *const __restrict Bz = gap_of_solution.begin(),
                                       *const __restrict Bp = gap_change.begin();
        for (std::size_t i = 0; i < n_points; ++i)
          if (c[i] != 0)
          {
            of_penalty[0] += c[i] * Bz[i] * Bz[i];
            of_penalty[1] += c[i] * Bz[i] * Bp[i];
            of_penalty[2] += c[i] * Bp[i] * Bp[i];
          }
        problem.processes().sum(of_penalty, 3);
        const double zz = problem.dot(solution, A_solution) + of_penalty[0], zp = problem.dot(solution, A_direction) + of_penalty[1],
                     pp = curvature + of_penalty[2];
        const double rz = problem.dot(residual, solution), rp = problem.dot(residual, direction), determinant = zz * pp - zp * zp;
        // Nearly parallel: nothing to be gained.
        if (!(zz > 0 && determinant > 1e-10 * zz * pp))
          return false;
        const double a = (rz * pp - rp * zp) / determinant, b = (rp * zz - rz * zp) / determinant;
        for (const auto &[p, z] :
             {std::pair(&direction, &solution), std::pair(&A_direction, &A_solution), std::pair(&gap_change, &gap_of_solution)})
        {
          double *const __restrict p_of = p->begin();
          const double *const __restrict z_of = z->begin();
          for (std::size_t j = 0, n = p->locally_owned_size(); j < n; ++j)
            p_of[j] = a * z_of[j] + b * p_of[j];
        }
        curvature = problem.dot(direction, A_direction);
        descent = a * rz + b * rp;
        return true;
      }

      /// The same, 0 where another process counts the point.
      const Vector &counted(const Vector &q)
      {
        if (problem.processes().alone())
          return q;
        only_counted = q;
        for (std::size_t i = 0; i < n_points; ++i)
          if (!problem.owns_point(i))
            only_counted(i) = 0;
        return only_counted;
      }

      double scaled_residual_norm(const double t)
      {
        for (std::size_t i = 0; i < gap.size(); ++i)
          pressure(i) = std::max(gap(i) + t * gap_change(i), 0.) / (augmented.epsilon + augmented.shift(i));
        problem.apply_trace_transpose(work, pressure);
        work -= problem.load();
        work.add(1., Au, t, A_direction);
        return std::sqrt(
          problem.sum_over_unknowns([&](const std::size_t j) { return work(j) * work(j) / problem.stiffness_diagonal()(j); }));
      }

      const AugmentedProblem &augmented;
      DiscreteProblem        &problem;
      Vector                 &u, &Au;
      Vector                  residual, solution, A_solution, direction, A_direction;
      Vector                  gap, gap_of_solution, gap_change, stiffness_of_penalty;
      Vector                  penalty; ///< w_i / (eps + r_i): stiffness of an active point
      Vector                  only_counted;
      std::size_t             n_points = 0;
      Vector                 &pressure = gap_of_solution, &work = A_solution; ///< where these are not in use: memory is dear to touch
      bool                    has_direction = false;
      double                  curvature = 0, descent = 0; ///< direction' A direction, direction' residual
      std::vector<Vector>     traces_of_kernel;           ///< B r for the motions r on which A vanishes
    };
  } // namespace

  NewtonResult semismooth_newton(const AugmentedProblem  &augmented,
                                 const NewtonParameters  &parameters,
                                 const std::vector<bool> &predicted_active,
                                 Vector                  &u,
                                 Vector                  &Au,
                                 Progress                &progress)
  {
    NewtonResult       result;
    NewtonIteration    iteration(augmented, u, Au);
    const bool         symmetric = augmented.problem.symmetric();
    std::set<PointSet> visited; // active sets, only kept where a cycle is possible
    const PointSet     prediction(predicted_active.begin(), predicted_active.end());
    bool               damp = false, active_set_rests = false;
    double             tolerance = parameters.tolerance;
    // On an active set that rests the problem is linear: a step that gains nothing is round-off, or a linear solver that cannot do better.
    constexpr unsigned most_idle_steps = 4;
    unsigned           n_idle_steps = 0;
    double             least_decrement = std::numeric_limits<double>::max();

    // Where contact and pressure are zero alike, which points touch is decided by rounding, and relaxation would never leave it as it is.
    constexpr double   negligible_for_relaxation = 1e-6;
    constexpr unsigned most_relaxations = 40;
    unsigned           n_relaxations = 0;
    double             largest_decrement = 0;

    while (result.history.size() < parameters.max_steps)
    {
      if (augmented.problem.processes().any(progress.stop_requested()))
        throw Interrupted();
      const bool     predicted = result.history.empty() && augmented.problem.processes().any(!prediction.empty());
      const PointSet set = predicted ? prediction : iteration.active;
      iteration.evaluate_residual(set);
      LinearSolve solve;
      try
      {
        solve = iteration.solve_for_direction(set, active_set_rests
                                                     ? SolveTolerance{tolerance, 0.}
                                                     : SolveTolerance{tolerance, parameters.forcing, parameters.enough_iterations});
      }
      catch (const std::runtime_error &failure)
      {
        result.reason = failure.what();
        return result;
      }
      const double decrement = iteration.decrement();
      if (result.history.empty())
        tolerance = std::max(tolerance, parameters.relative_tolerance * decrement);

      if (symmetric && iteration.shows_lack_of_coercivity())
      {
        result.reason = "the form a is not coercive: its energy has no minimum";
        return result;
      }
      if (!symmetric && !predicted && !damp)
        damp = !visited.insert(set).second;
      const double t = predicted ? 1. : symmetric ? iteration.energy_step_length() : damp ? iteration.residual_step_length() : 1.;
      if (!(t < 1e8))
      {
        result.reason = "the form a is not coercive: its energy has no minimum";
        return result;
      }
      const std::size_t flipped = iteration.move(t);
      const bool        set_is_left = augmented.problem.processes().any(set != iteration.active);
      if (!predicted)
        largest_decrement = std::max(largest_decrement, decrement);
      if (set_is_left && symmetric && decrement > negligible_for_relaxation * largest_decrement && n_relaxations < most_relaxations)
      {
        ++n_relaxations;
        iteration.relax();
      }

      NewtonStep step;
      step.active = iteration.n_active();
      step.flipped = flipped;
      step.linear_iterations = solve.iterations;
      step.step_length = t;
      step.residual = decrement;
      result.history.push_back(step);
      result.linear_iterations += solve.iterations;
      result.flipped += flipped;
      result.residual = solve.residual;

      if (!solve.converged && solve.residual > tolerance)
      {
        result.reason = solve.failure;
        return result;
      }
      active_set_rests = !predicted && flipped == 0;
      const bool solved_on_this_set = !set_is_left && std::abs(t - 1) < 1e-3;
      if ((solved_on_this_set && solve.residual <= tolerance) || (!predicted && decrement <= tolerance))
      {
        result.converged = true;
        result.reason = "the active set rests";
        return result;
      }
      // A direct solve leaves nothing to gain on the same set; the residual is then round-off above the tolerance.
      if (solved_on_this_set && solve.iterations == 0)
      {
        result.converged = result.at_round_off = true;
        result.reason = "the active set rests, residual at round-off";
        return result;
      }
      n_idle_steps = active_set_rests && decrement > 0.9 * least_decrement ? n_idle_steps + 1 : 0;
      least_decrement = std::min(least_decrement, decrement);
      if (n_idle_steps == most_idle_steps)
      {
        result.converged = result.at_round_off = decrement <= iteration.round_off();
        result.reason = result.converged ? "the active set rests, residual at round-off"
                                         : fmt::format("Newton's method stalls: the residual stays {:.1g} times above the tolerance",
                                                       decrement / tolerance);
        return result;
      }
    }
    result.reason = "no rest after " + std::to_string(parameters.max_steps) + " Newton steps" + (damp ? ": the active sets repeat" : "");
    return result;
  }

  NewtonResult semismooth_newton(const AugmentedProblem  &augmented,
                                 const NewtonParameters  &parameters,
                                 const std::vector<bool> &predicted_active,
                                 Vector                  &u,
                                 Progress                &progress)
  {
    Vector Au;
    augmented.problem.initialize_dof_vector(Au);
    augmented.problem.apply_stiffness(Au, u);
    return semismooth_newton(augmented, parameters, predicted_active, u, Au, progress);
  }
} // namespace unilateral
