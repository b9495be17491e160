#include "unilateral/inequality/newton_iteration.h"

#include "unilateral/inequality/free_boundary_relaxation.h"
#include "unilateral/inequality/line_search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace unilateral
{
  NewtonIteration::NewtonIteration(const AugmentedProblem &augmented, Vector &u, Vector &Au)
    : augmented(augmented), problem(augmented.problem), u(u), Au(Au), penalty(augmented.penalty()), rigid_body(augmented, penalty)
  {
    for (Vector *v : {&residual, &solution, &dof_work, &direction, &A_direction})
      problem.initialize_dof_vector(*v);
    for (Vector *q : {&gap, &point_work, &gap_change, &stiffness_of_penalty})
      problem.initialize_point_vector(*q);
    augmented.shifted_gap(gap, u);
    n_points = gap.locally_owned_size();
    active.resize(n_points);
    find_active();
  }

  void NewtonIteration::evaluate_residual(const PointSet &set)
  {
    evaluate_pressure(point_work, set);
    problem.apply_trace_transpose(dof_work, point_work);
    const double *const __restrict f = problem.load().begin(), *const __restrict Au_of = Au.begin(),
                                   *const __restrict force = dof_work.begin();
    double *const __restrict r = residual.begin();
    for (std::size_t j = 0, n = residual.locally_owned_size(); j < n; ++j)
      r[j] = f[j] - Au_of[j] - force[j];
  }

  LinearSolve NewtonIteration::solve_for_direction(const PointSet &set, const SolveTolerance &tolerance)
  {
    const double *const __restrict c = penalty.begin();
    double *const __restrict on_set = stiffness_of_penalty.begin();
    for (std::size_t i = 0; i < n_points; ++i)
      on_set[i] = set[i] ? c[i] : 0.;
    for (const std::size_t i : rigid_body.supports(set))
      on_set[i] = c[i];
    solution = 0.;
    const LinearSolve solve = problem.solve_tangent(stiffness_of_penalty, residual, tolerance, solution, &dof_work); // A times it
    problem.apply_trace(point_work, solution);
    if (has_direction && solve.iterations > 0 && problem.symmetric() && combine_with_last_direction(dof_work, point_work))
      return solve;
    direction.swap(solution);
    A_direction.swap(dof_work);
    gap_change.swap(point_work);
    has_direction = true;
    curvature = problem.dot(direction, A_direction);
    descent = problem.dot(direction, residual);
    return solve;
  }

  double NewtonIteration::energy_step_length()
  {
    const double slope = problem.dot(direction, Au) - problem.dot(direction, problem.load());
    return exact_line_search(slope, curvature, counted(penalty), gap, gap_change, problem.processes());
  }

  double NewtonIteration::residual_step_length()
  {
    const double before = scaled_residual_norm(0);
    double       t = 1;
    while (t > 1e-3 && !(scaled_residual_norm(t) < (1 - 1e-4 * t) * before)) // also where it is not finite
      t *= 0.5;
    return t;
  }

  std::size_t NewtonIteration::move(const double t)
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

  void NewtonIteration::relax()
  {
    std::vector<bool> set(active.begin(), active.end());
    relax_near_free_boundary(augmented, set, u);
    problem.apply_stiffness(Au, u);
    augmented.shifted_gap(gap, u);
    find_active();
  }

  std::size_t NewtonIteration::move_with_rigid_body_modes(double &t)
  {
    const double                   slope = problem.dot(direction, Au) - problem.dot(direction, problem.load());
    const RigidBodyStep::Direction along{direction, A_direction, gap_change, slope, curvature};
    t = rigid_body.minimise(u, Au, gap, &along);
    const PointSet before = active;
    find_active();
    std::uint64_t flipped = 0;
    for (std::size_t i = 0; i < n_points; ++i)
      flipped += before[i] != active[i] && problem.owns_point(i);
    return problem.processes().sum(flipped);
  }

  void NewtonIteration::balance_rigid_body_modes()
  {
    if (!rigid_body.has_modes())
      return;
    rigid_body.minimise(u, Au, gap);
    find_active();
  }

  bool NewtonIteration::shows_lack_of_coercivity() const
  {
    const double round_off = 1e-10 * (std::abs(curvature) + std::abs(descent));
    return curvature < -round_off || descent < -round_off;
  }

  double NewtonIteration::round_off()
  {
    evaluate_pressure(point_work, active);
    problem.apply_trace_transpose(dof_work, point_work);
    const double sum = problem.sum_over_unknowns(
      [&](const std::size_t j)
      {
        const double diagonal = problem.stiffness_diagonal()(j);
        const double terms = std::abs(problem.load()(j)) + std::abs(Au(j)) + std::abs(dof_work(j)) + 2 * diagonal * std::abs(u(j));
        return terms * terms / diagonal;
      });
    return 32 * std::numeric_limits<double>::epsilon() * std::sqrt(sum);
  }

  std::size_t NewtonIteration::n_active() const
  {
    return std::llround(problem.sum_over_points([&](const std::size_t i) { return double(active[i]); }));
  }
  double NewtonIteration::decrement() const
  {
    return std::sqrt(std::abs(descent));
  }

  void NewtonIteration::find_active()
  {
    const double *const g = gap.begin();
    for (std::size_t i = 0; i < n_points; ++i)
      active[i] = g[i] > 0;
  }

  void NewtonIteration::evaluate_pressure(Vector &pressure, const PointSet &set) const
  {
    const double *const __restrict g = gap.begin(), *const __restrict r = augmented.shift.begin();
    double *const __restrict p = pressure.begin();
    for (std::size_t i = 0; i < n_points; ++i)
      p[i] = set[i] ? g[i] / (augmented.epsilon + r[i]) : 0.;
  }

  /// direction <- a solution + b direction with the least energy on the active set for which the system was solved.
  bool NewtonIteration::combine_with_last_direction(const Vector &A_solution, const Vector &gap_of_solution)
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
    for (const auto &[p, z] : {std::pair<Vector *, const Vector *>(&direction, &solution), std::pair(&A_direction, &A_solution),
                               std::pair(&gap_change, &gap_of_solution)})
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
  const Vector &NewtonIteration::counted(const Vector &q)
  {
    if (problem.processes().alone())
      return q;
    only_counted = q;
    for (std::size_t i = 0; i < n_points; ++i)
      if (!problem.owns_point(i))
        only_counted(i) = 0;
    return only_counted;
  }

  double NewtonIteration::scaled_residual_norm(const double t)
  {
    for (std::size_t i = 0; i < gap.size(); ++i)
      point_work(i) = std::max(gap(i) + t * gap_change(i), 0.) / (augmented.epsilon + augmented.shift(i));
    problem.apply_trace_transpose(dof_work, point_work);
    dof_work -= problem.load();
    dof_work.add(1., Au, t, A_direction);
    return std::sqrt(
      problem.sum_over_unknowns([&](const std::size_t j) { return dof_work(j) * dof_work(j) / problem.stiffness_diagonal()(j); }));
  }
} // namespace unilateral
