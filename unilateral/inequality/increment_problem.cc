#include "unilateral/inequality/increment_problem.h"

#include <algorithm>
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
    const double round_off = 1e3 * std::numeric_limits<double>::epsilon() * (Bu.linfty_norm() + gap.linfty_norm());
    gap -= Bu;
    for (std::size_t i = 0; i < gap.size(); ++i)
      if (lambda_h(i) > 0 || gap(i) < round_off)
        gap(i) = 0;
  }
} // namespace unilateral
