// Points of all processes -> parts, where no process has all of them.
#pragma once

#include "unilateral/base/processes.h"

#include <deal.II/base/point.h>

#include <vector>

namespace unilateral
{
  /// For each of the points of this process the part that it belongs to, of as many parts as there are processes and of about the same
  /// number of points: recursive coordinate bisection by Zoltan. Collective.
  template <int dim>
  std::vector<unsigned> bisect_shared(const std::vector<dealii::Point<dim>> &points, const Processes &processes);
} // namespace unilateral
