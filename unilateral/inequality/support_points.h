// Contact points that stop the rigid body modes which would be free without them.
#pragma once

#include "unilateral/inequality/discrete_problem.h"

#include <Eigen/Core>

#include <vector>

namespace unilateral
{
  /// A point of the constraint that has been chosen, of any process.
  struct SupportPoint
  {
    /// Where this process has it. A point at a node on a cut is one on every process that has the node; others have nothing here.
    std::vector<std::size_t> places;
  };

  /// The k-th of at most @p n points is the one whose column of @p effects is the largest outside the span of the columns of those before;
  /// the same points on all processes. Column i: what point i of this process does on a few modes; of points that another process owns
  /// columns are not looked at. Ends early where what is left is not larger than the largest column times @p negligible.
  std::vector<SupportPoint>
  choose_support_points(const DiscreteProblem &problem, Eigen::MatrixXd effects, std::size_t n, double negligible);
} // namespace unilateral
