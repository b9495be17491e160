// Continuous P1, P2 and P3 on triangles and tetrahedra.
#pragma once

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe.h>

#include <memory>

namespace unilateral
{
  /// The Lagrange element of degree 1, 2 or 3 with equally spaced nodes, alpha / degree for |alpha| <= degree, on triangles and tetrahedra.
  /// Its order of nodes is deal.II's: vertices, lines (from their first vertex to their second), faces, cell. Degrees 1 and 2 are
  /// FE_SimplexP. Degree 3 has prolongation to the children of a refined cell, exact; neither hanging nodes nor different degrees in one
  /// mesh. On segments it is the element of FE_Q with these nodes.
  /// @p in_system: as the base element of a FESystem. Throws std::invalid_argument for other degrees.
  template <int dim>
  std::unique_ptr<dealii::FiniteElement<dim>> make_simplex_element(unsigned degree, bool in_system = false);

  /// To be called after each distribute_dofs() (and renumbering) when lines hold more than one node: makes the two cells at a line
  /// agree on which of its nodes is which, so that V_h is continuous. The nodes of a line go from its first vertex to its second; a
  /// cell that sees the line the other way gets them in reverse order. Where lines hold one node at most, and on other cells than
  /// triangles and tetrahedra, nothing is to be done. The DoFs of the levels of a multigrid hierarchy (distribute_mg_dofs) are not
  /// matched. V_h may be a system of equal elements.
  template <int dim>
  void match_line_nodes(dealii::DoFHandler<dim> &dof_handler);
} // namespace unilateral
