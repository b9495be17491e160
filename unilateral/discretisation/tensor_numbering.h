// The order of the unknowns of a cell, and of a patch of cells, in multigrid.
#pragma once

#include "unilateral/multigrid/cell_operator.h"

#include <deal.II/fe/fe.h>

#include <array>
#include <vector>

namespace unilateral
{
  /// The unknowns of a cell node by node, nodes in lexicographic order, components next to each other.
  template <int dim>
  class TensorNumbering
  {
  public:
    TensorNumbering(const dealii::FiniteElement<dim> &fe, unsigned degree);

    unsigned                               degree, n_components;
    std::vector<unsigned>                  element_index; ///< number here -> number of the finite element
    std::vector<std::array<unsigned, dim>> position;      ///< of each unknown of the finite element among the nodes
  };

  /// A patch of the cells that @p n_levels of refinement make of one: cells in the order of the hierarchy, their nodes on the lattice of
  /// the patch.
  template <int dim>
  CellOperator::PatchShape patch_shape(const TensorNumbering<dim> &numbering, unsigned n_levels);

  /// As many levels of refinement as keep what a patch gathers in the first-level cache; one at least, for the transfer between levels.
  template <int dim>
  unsigned levels_of_patch(unsigned level, unsigned degree, unsigned n_components);
} // namespace unilateral
