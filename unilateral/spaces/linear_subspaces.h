// The functions of degree 1 within V_h: on its mesh, and on the coarser ones that refinement came from.
#pragma once

#include "unilateral/algebra/sparse_rows.h"
#include "unilateral/algebra/vector.h"
#include "unilateral/spaces/function_space.h"

#include <vector>

namespace unilateral
{
  /// V_h > V_1 > V_2 > ...: piecewise (multi)linear functions that meet the homogeneous Dirichlet conditions of V_h, by their values at the
  /// vertices. V_1 has the mesh of V_h, unless that is of degree 1 itself; the next ones have the meshes before it.
  struct LinearSubspaces
  {
    /// Each space in terms of the one before: v = P w. Rows of unknowns that are fixed or depend on others are empty, and so are the
    /// columns of those that are fixed. The unknowns at a vertex have numbers in sequence.
    std::vector<OwnSparseRows> prolongations;

    /// For V_1, V_2, ... and each of their unknowns that of V_h with the same vertex and component; invalid_dof_index where no cell has the
    /// vertex.
    std::vector<std::vector<dealii::types::global_dof_index>> at_vertex;
  };

  /// A function of V_h at the vertices of such a space, zero where no cell has one.
  Vector values_at_vertices(const Vector &function, const std::vector<dealii::types::global_dof_index> &at_vertex);

  /// @p space: of a continuous Lagrange element. The meshes before it are known of simplices.
  template <int dim>
  LinearSubspaces linear_subspaces(const FunctionSpace<dim> &space);
} // namespace unilateral
