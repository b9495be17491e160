#include "unilateral/evaluation/data_round_off.h"

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  double data_round_off(const Problem<dim> &problem, const ConstraintSet<dim> &set, const DiscreteProblem &discrete)
  {
    const auto corners = BoundingBox<dim>(problem.space.mesh.triangulation->get_vertices()).get_boundary_points();
    double     largest = 0;
    for (unsigned d = 0; d < dim; ++d)
      largest = std::max({largest, std::abs(corners.first[d]), std::abs(corners.second[d])});
    if (!problem.space.processes().any(largest > 100 * corners.first.distance(corners.second)))
      return 0;
    const double        eta = std::numeric_limits<double>::epsilon() * largest;
    std::vector<double> delta(set.size(), 0.);
    for (std::size_t b = 0; b < set.blocks.size(); ++b)
      for (std::size_t i = set.blocks[b].begin; i < set.blocks[b].end; ++i)
      {
        const auto &condition = problem.conditions[b];
        if (condition.surface)
        {
          delta[i] = 2 * eta;
          continue;
        }
        for (unsigned d = 0; d < dim; ++d)
        {
          Point<dim> before = set.points[i].x, after = before;
          before[d] -= eta;
          after[d] += eta;
          try
          {
            delta[i] += std::abs(condition.bound.value(after) - condition.bound.value(before));
          }
          catch (const InputError &)
          {
          } // the bound ends here
        }
      }
    return std::sqrt(discrete.sum_over_points([&](const std::size_t i)
                                              { return discrete.weights()(i) * delta[i] * delta[i] / discrete.compliance()(i); }));
  }

  template double data_round_off(const Problem<1> &, const ConstraintSet<1> &, const DiscreteProblem &);
  template double data_round_off(const Problem<2> &, const ConstraintSet<2> &, const DiscreteProblem &);
  template double data_round_off(const Problem<3> &, const ConstraintSet<3> &, const DiscreteProblem &);
} // namespace unilateral
