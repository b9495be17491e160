// Refinement in places where a mesh is divided among processes: both sides of a cut are refined alike.
#pragma once

#include "unilateral/base/shared_unknowns.h"
#include "unilateral/mesh/subdomain.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/grid/tria.h>

#include <vector>

namespace unilateral
{
  /// Along the cuts of @p division a process needs to know no cells of others: faces on cuts are refined for both sides or for none, and in
  /// space a line on a cut, whole for some cells and halved for others, is so for each process that has it. In the plane no hanging node
  /// lies on a cut then; in space a process that has one has the nodes on which it depends, too.
  template <int dim>
  bool conforms_at_cuts(const dealii::Triangulation<dim> &whole, const Division &division);

  /// Adds to the @p chosen active cells of the whole mesh those that must be refined with them so that it conforms at cuts; cells whose
  /// neighbour across a cut is coarser are not refined this time. One refinement may not be enough: conforms_at_cuts() tells. @p whole is
  /// left as it was.
  template <int dim>
  void refine_alike_at_cuts(dealii::Triangulation<dim> &whole, const Division &division, std::vector<bool> &chosen);

  /// Of the part of a process, on which cells are flagged for refinement: flags those that must be refined with them so that no hanging
  /// nodes arise, for other processes' cells as well. @p quadratic: continuous functions of degree 2 on the part, @p shared: of those.
  /// Collective.
  template <int dim>
  void flag_alike_at_cuts(dealii::Triangulation<dim> &part, const dealii::DoFHandler<dim> &quadratic, const SharedUnknowns &shared);

  /// Of a part of simplices: marks the lines, by index, that other processes have marked, and says whether that marked any on any process.
  /// Functions as for flag_alike_at_cuts(). Collective.
  template <int dim>
  bool mark_alike_at_cuts(std::vector<bool> &lines, const dealii::DoFHandler<dim> &quadratic, const SharedUnknowns &shared);
} // namespace unilateral
