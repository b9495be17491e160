#include "unilateral/inequality/augmented_problem.h"

#include <algorithm>

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

  Vector AugmentedProblem::penalty() const
  {
    Vector c;
    problem.initialize_point_vector(c);
    const double *const w = problem.weights().begin(), *const r = shift.begin();
    for (std::size_t i = 0, n = c.locally_owned_size(); i < n; ++i)
      c.begin()[i] = w[i] / (epsilon + r[i]);
    return c;
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
} // namespace unilateral
