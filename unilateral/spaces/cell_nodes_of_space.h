// The cells of a mesh as they stand in CellFunctions.
#pragma once

#include "unilateral/functions/cell_functions.h"
#include "unilateral/spaces/function_space.h"

#include <deal.II/base/quadrature.h>

namespace unilateral
{
  /// The active cells of the mesh, by their numbers, for functions of degree @p degree, whose values follow each other cell by cell. Curved
  /// sides are polynomials of the element's degree.
  template <int dim>
  CellNodes cell_nodes_of(const FunctionSpace<dim> &space, unsigned degree);

  /// The points of a lattice of spacing 1/@p degree on the reference cell, in the order of CellNodes.
  template <int dim>
  dealii::Quadrature<dim> lattice_points(const CellNodes &nodes, unsigned degree);
} // namespace unilateral
