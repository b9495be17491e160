#include "unilateral/inequality/multiplier_space.h"

#include <algorithm>
#include <cmath>

namespace unilateral
{
  double MultiplierSpace::inner_product(const Vector &p, const Vector &q) const
  {
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
      sum += problem.weights()(i) * p(i) * q(i);
    return sum;
  }

  double MultiplierSpace::norm(const Vector &q) const
  {
    return std::sqrt(inner_product(q, q));
  }

  double MultiplierSpace::pairing(const Vector &q, const Vector &v) const
  {
    Vector Bv;
    problem.initialize_point_vector(Bv);
    problem.apply_trace(Bv, v);
    return inner_product(q, Bv);
  }

  bool MultiplierSpace::in_N_h(const Vector &q) const
  {
    return std::all_of(q.begin(), q.end(), [](const double value) { return value <= 0; });
  }

  Vector MultiplierSpace::excess(const Vector &v) const
  {
    Vector result;
    problem.initialize_point_vector(result);
    problem.apply_trace(result, v);
    result -= problem.obstacle();
    return result;
  }

  double MultiplierSpace::violation(const Vector &v) const
  {
    Vector positive_part = excess(v);
    for (double &value : positive_part)
      value = std::max(value, 0.);
    return norm(positive_part);
  }

  bool MultiplierSpace::in_K_h(const Vector &v, const double tolerance) const
  {
    const Vector difference = excess(v);
    return std::all_of(difference.begin(), difference.end(), [&](const double value) { return value <= tolerance; });
  }
} // namespace unilateral
