// Functions of V_h on a mesh of quadrilaterals or hexahedra that is refined in place.
#pragma once

#include <deal.II/base/geometry_info.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <array>
#include <vector>

namespace unilateral
{
  /// Carries functions over a refinement of all cells or of some. To be used like HermiteOnFinerMesh.
  /// What SolutionTransfer of deal.II does for any mesh, without its search trees, and better where it can be: the nodes of the cells that
  /// a refinement has made of one, of degree p, are those of a polynomial of degree 2p, which is taken between them.
  /// At hanging nodes functions get some value: they have to be distributed by the constraints of the finer mesh.
  template <int dim>
  class InterpolationToRefinedCells
  {
  public:
    using VectorType = dealii::LinearAlgebra::distributed::Vector<double>;

    /// @p smoothly: with twice the degree, where functions are continuous; else they stay the functions they are.
    InterpolationToRefinedCells(const dealii::DoFHandler<dim> &coarse, const std::vector<VectorType> &functions, bool smoothly);

    /// For a triangulation whose coarse cells are these of the one there was: what they know of their siblings is kept.
    void keep_cells(const std::vector<unsigned> &cells);

    /// The functions in terms of @p fine, which numbers the unknowns of the same triangulation, or of that of keep_cells(), after a
    /// refinement of some cells.
    void interpolate(const dealii::DoFHandler<dim> &fine, std::vector<VectorType> &functions) const;

  private:
    static constexpr unsigned n_children = dealii::GeometryInfo<dim>::max_children_per_cell;
    static constexpr unsigned none = -1;
    using Siblings = std::array<unsigned, n_children>;

    std::vector<std::vector<unsigned>> number;      ///< of the cells, by level and index; none: it has no values
    std::vector<std::vector<double>>   cell_values; ///< per function: cells x unknowns of a cell
    std::vector<Siblings>              families;    ///< the children of each cell that has only active ones; empty: there is none
    std::vector<unsigned>              family;      ///< of each cell, none: no such one; and which of the children it is
    std::vector<unsigned char>         child_of_family;
    std::vector<unsigned>              kept; ///< cells of keep_cells(); empty: all
  };
} // namespace unilateral
