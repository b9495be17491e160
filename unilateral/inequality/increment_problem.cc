#include "unilateral/inequality/increment_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace unilateral
{
  IncrementProblem::IncrementProblem(DiscreteProblem &original, const Vector &u_h, const Vector &lambda_h) : original(original)
  {
    original.initialize_dof_vector(contact_load);
    original.apply_trace_transpose(contact_load, lambda_h);
    // Entries that Dirichlet data fix have no load.
    Vector Bu;
    original.initialize_point_vector(Bu);
    original.apply_trace(Bu, u_h);
    gap = original.obstacle();
    const double last_digits = 1e3 * std::numeric_limits<double>::epsilon(), size = Bu.linfty_norm();
    for (std::size_t i = 0; i < gap.size(); ++i)
    {
      const double round_off = last_digits * (size + std::abs(gap(i)));
      gap(i) -= Bu(i);
      if (lambda_h(i) > 0 || gap(i) < round_off)
        gap(i) = 0;
    }
  }
} // namespace unilateral
