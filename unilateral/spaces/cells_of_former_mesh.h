// A mesh beside the one that an unfinished run had come to.
#pragma once

#include "unilateral/mesh/former_mesh.h"
#include "unilateral/spaces/function_space.h"

#include <vector>

namespace unilateral
{
  /// What another run needs to come to this mesh; of several processes each records its part.
  template <int dim>
  FormerMesh record_of(const FunctionSpace<dim> &space);

  /// For each active cell, how many cells of @p former have their centre in it; what lies in none, as in the parts of other processes, is
  /// not counted.
  template <int dim>
  std::vector<unsigned> n_former_cells(const FunctionSpace<dim> &space, const FormerMesh &former);
} // namespace unilateral
