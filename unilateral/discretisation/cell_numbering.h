// The order of the unknowns of a cell, and of a patch of cells, in multigrid.
#pragma once

#include "unilateral/mesh/simplex_refinement.h"
#include "unilateral/multigrid/patch_shape.h"

#include <deal.II/fe/fe.h>

#include <array>
#include <map>
#include <vector>

namespace unilateral
{
  /// The unknowns of a cell of Lagrange elements node by node, components next to each other. Nodes of quadrilaterals and hexahedra in
  /// lexicographic order; those of triangles and tetrahedra in the order of the finite element on a cell whose corners are in sequence, so
  /// that cells that are refined alike have them in the same places.
  template <int dim>
  class CellNumbering
  {
  public:
    CellNumbering(const dealii::FiniteElement<dim> &fe, unsigned degree);

    /// Number here -> number of the finite element; simplices: on a cell with its corners in this @p order.
    const std::vector<unsigned> &element_index(const CornerOrder &order = in_sequence) const { return element_indices.at(order); }

    unsigned size() const { return element_index().size(); }

    const unsigned degree, n_components;
    const bool     simplex;

    /// Of each node: its place in each direction, from 0 to the degree; simplices: degree times its barycentric coordinates.
    using Place = std::array<unsigned, dim + 1>;
    std::vector<Place> nodes;

  private:
    void number_nodes_of_hypercube(const dealii::FiniteElement<dim> &fe);
    void number_nodes_of_simplex(const dealii::FiniteElement<dim> &fe);

    std::map<CornerOrder, std::vector<unsigned>> element_indices;
  };

  /// P_c for each child c of a cell: the cell's functions in terms of the child's, size()^2 numbers, row by row.
  template <int dim>
  std::vector<std::vector<double>> prolongations_to_children(const dealii::FiniteElement<dim> &fe, const CellNumbering<dim> &numbering);

  /// A patch of the cells that @p n_levels of refinement make of one: cells in the order of the hierarchy, their nodes on the lattice of
  /// the patch.
  template <int dim>
  PatchShape patch_shape(const CellNumbering<dim> &numbering, unsigned n_levels);

  /// As many levels of refinement, @p level at most, as keep what a patch gathers in the first-level cache; one at least, for the transfer
  /// between levels.
  template <int dim>
  unsigned levels_of_patch(const CellNumbering<dim> &numbering, unsigned level);
} // namespace unilateral
