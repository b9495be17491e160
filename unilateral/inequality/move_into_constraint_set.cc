#include "unilateral/inequality/move_into_constraint_set.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace unilateral
{
  MoveIntoConstraintSet::MoveIntoConstraintSet(const DiscreteProblem &problem) : problem(problem)
  {
    for (Vector *q : {&excess, &image, &sizes})
      problem.initialize_point_vector(*q);
    for (Vector *v : {&gradient, &step, &direction})
      problem.initialize_dof_vector(*v);
  }

  void MoveIntoConstraintSet::onto(const std::vector<bool> &contact, Vector &v)
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

  bool MoveIntoConstraintSet::out_of_obstacle(Vector &v)
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

  void MoveIntoConstraintSet::evaluate_excess(const Vector &v)
  {
    // The largest size met: a v that has become next to nothing still carries the rounding of what it was. Components may cancel in Bv:
    // |B| |v| counts. A bound far beyond what v reaches, as in place of none, leaves Bv - s negative whatever is rounded.
    const Vector &s = problem.obstacle();
    problem.apply_trace_to_sizes(sizes, v);
    const double reached = problem.largest(sizes);
    double       bound = 0;
    for (std::size_t i = 0; i < s.size(); ++i)
      bound = std::max(bound, std::min(std::abs(s(i)), 2 * reached));
    round_off = std::max(round_off, 4 * std::numeric_limits<double>::epsilon() * (reached + problem.processes().max(bound)));
    problem.apply_trace(excess, v);
    excess -= s;
  }

  double MoveIntoConstraintSet::weighted(const Vector &a, const Vector &b) const
  {
    return problem.sum_over_points([&](const std::size_t i) { return problem.weights()(i) * a(i) * b(i); });
  }

  /// step = diag(B'WB)^-1 B'W excess; returns its scalar product with the gradient.
  double MoveIntoConstraintSet::descent_step()
  {
    problem.apply_trace_transpose(gradient, excess);
    const Vector &mass = problem.trace_mass();
    for (std::size_t j = 0; j < gradient.size(); ++j)
      step(j) = mass(j) > 0 ? gradient(j) / mass(j) : 0.;
    return problem.dot(step, gradient);
  }
} // namespace unilateral
