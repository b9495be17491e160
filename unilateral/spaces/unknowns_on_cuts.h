// Which unknowns of a part of a mesh others have too.
#pragma once

#include "unilateral/base/shared_unknowns.h"
#include "unilateral/mesh/simplex_refinement.h"
#include "unilateral/mesh/subdomain.h"

#include <deal.II/dofs/dof_handler.h>

#include <array>
#include <map>
#include <set>
#include <vector>

namespace unilateral
{
  /// What others have too of the unknowns of a space of Lagrange elements on the part, refined uniformly. They are recognised without a
  /// message: a node on an edge or face of the mesh that was cut is a combination of the vertices of that edge or face with whole numbers
  /// for weights, and who has cells there is known to all. @p lines_cut_since: by each refinement of simplices.
  template <int dim>
  SharedUnknowns unknowns_on_cuts(const Subdomain<dim>          &subdomain,
                                  const dealii::DoFHandler<dim> &dof_handler,
                                  const std::vector<CutLines>   &lines_cut_since = {});

  /// All unknowns of nodes that are named by their first one.
  template <int dim>
  std::map<dealii::types::global_dof_index, std::array<dealii::types::global_dof_index, dim>>
  unknowns_of_nodes(const dealii::DoFHandler<dim> &dof_handler, const std::set<dealii::types::global_dof_index> &first);
} // namespace unilateral
