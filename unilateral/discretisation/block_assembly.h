// A as a SymmetricBlockMatrix, cell by cell: it never exists in rows, which would take twice the memory.
#pragma once

#include "unilateral/algebra/symmetric_block_matrix.h"
#include "unilateral/discretisation/element_systems.h"

#include <deal.II/lac/vector.h>

namespace unilateral
{
  /// For forms that are symmetric and have terms on cells, boundary faces and at points only; @p volumes as in for_each_local_system().
  /// Adds to @p load, of as many entries as there are unknowns, what A and the prescribed values make of f. On the diagonal of unknowns
  /// that are prescribed or depend on others is a positive number.
  template <int dim>
  SymmetricBlockMatrix assemble_blocks(const Problem<dim> &problem, unsigned block_size, Volumes volumes, dealii::Vector<double> &load);

  /// Whether unknowns dim i, ..., dim i + dim - 1 are the components at one node, for every i.
  template <int dim>
  bool nodes_are_blocks(const Problem<dim> &problem);

  /// How many unknowns make a block of A: those at a node, or one.
  template <int dim>
  unsigned block_size(const Problem<dim> &problem)
  {
    return problem.form->n_components() > 1 && nodes_are_blocks(problem) ? problem.form->n_components() : 1;
  }
} // namespace unilateral
