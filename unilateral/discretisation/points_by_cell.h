// Where the points of a constraint set came from: the rule on each cell or face.
#pragma once

#include "unilateral/discretisation/problem.h"

#include <optional>
#include <vector>

namespace unilateral
{
  /// The rule of a constraint on one cell, or on one face of the part where it holds.
  template <int dim>
  struct RuleOnCell
  {
    typename dealii::DoFHandler<dim>::active_cell_iterator cell;
    std::optional<unsigned>                                face;
    std::vector<dealii::Point<dim>>                        locations; ///< of the rule's points, in its order
    std::vector<std::size_t>                               points;    ///< their indices; ConstraintSet::size() for one that was dropped
  };

  /// Where the points of a block came from, in the mesh's order. Points that cells share appear with each of them.
  template <int dim>
  std::vector<RuleOnCell<dim>> rule_on_cells(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, std::size_t block);

  /// Numbers of each of several processes @p at_points become their sum at points that lie at nodes on cuts. Collective.
  template <int dim>
  void add_at_cuts(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, std::vector<double> &at_points);
} // namespace unilateral
