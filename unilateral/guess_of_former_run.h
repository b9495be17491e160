// A solution, or an iterate, that goes from one run to another.
#pragma once

#include "unilateral/functions/former_level.h"
#include "unilateral/nested_iteration.h"
#include "unilateral/solution.h"

#include <memory>

namespace unilateral
{
  /// guess_from() on cells: "u", and "pressure0" and so on by constraint block, of a vector-valued u their components by "x", "y", "z"
  /// behind that. Where several processes share the mesh each has its part.
  template <int dim>
  std::shared_ptr<const CellFunctions> guess_on_cells(const Solution<dim> &solution);

  /// The guess on the mesh of @p problem, which is that of @p former, whatever parts it is in; for @p n_blocks of constraints. Empty where
  /// @p former has not these functions.
  template <int dim>
  StartingGuess guess_of(const FormerLevel &former, const Problem<dim> &problem, std::size_t n_blocks);
} // namespace unilateral
