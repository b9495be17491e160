// From a refined mesh to the levels of multigrid: element matrices, the order of cells and patches, prolongation.
#pragma once

#include "unilateral/discretisation/problem.h"
#include "unilateral/inequality/discrete_problem.h"
#include "unilateral/multigrid/level_hierarchy.h"

#include <string>

namespace unilateral
{
  /// Why geometric multigrid cannot serve this problem, whatever the level; empty: it can. It takes Lagrange elements on
  /// quadrilaterals, hexahedra and triangles (any number on the coarse mesh that can be factorised), and a form of second order in which
  /// convection does not outweigh diffusion. Triangles have straight sides and are refined everywhere.
  template <int dim>
  std::string obstacle_to_multigrid(const Problem<dim> &problem);

  /// Adds the current level of @p problem, which must be one refinement finer than what @p hierarchy has, and returns the load f without
  /// what Dirichlet data fix. Cells that are parallel shifts of each other with the same constant coefficients are integrated once.
  /// Throws InputError where a coefficient has no value.
  template <int dim>
  Vector add_level(LevelHierarchy &hierarchy, const Problem<dim> &problem);

  /// The load f, without what Dirichlet data fix, of other data on the level that @p hierarchy ends with; A must be the same.
  template <int dim>
  Vector load_on_finest(const LevelHierarchy &hierarchy, const Problem<dim> &problem);

  /// After FunctionSpace::keep_own_part(): the cut of @p hierarchy at its finest level, which the processes of @p group had as a whole.
  template <int dim>
  void add_own_part(LevelHierarchy &hierarchy, const Problem<dim> &problem, const Processes &group);
} // namespace unilateral
