// Refinement of triangles and tetrahedra, everywhere or in places, that keeps their quality, and interpolation onto the finer mesh.
#pragma once

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace unilateral
{
  /// The lines of a mesh that refinement has cut, by the vertices at their ends: their midpoints are the last vertices of the finer mesh,
  /// in this order, and the vertices of the coarser one come first with the same numbers.
  using CutLines = std::vector<std::pair<unsigned, unsigned>>;

  /// A finer mesh of simplices, a triangulation of its own, and where its cells come from.
  template <int dim>
  struct RefinedSimplices
  {
    struct Child
    {
      unsigned                                parent;  ///< active cell index in the coarser mesh
      std::array<dealii::Point<dim>, dim + 1> corners; ///< in the parent's reference coordinates
    };
    std::unique_ptr<dealii::Triangulation<dim>> triangulation;
    std::vector<Child>                          children; ///< by active cell index of the finer mesh
    CutLines                                    cut_lines;
  };

  /// Cuts each triangle in 4, each tetrahedron in 8. Of the three ways to cut the octahedron inside a tetrahedron the one along its
  /// shortest diagonal is taken: refined again and again the cells then stay of a few shapes (deal.II 9.4 takes a fixed diagonal, with
  /// which they degenerate and P1 loses its order). Edge midpoints follow the manifold; boundary, material and manifold ids are kept.
  /// Reference: J. Bey, Tetrahedral grid refinement, Computing 55 (1995) 355-378.
  template <int dim>
  RefinedSimplices<dim> refine_simplices(const dealii::Triangulation<dim> &coarse);

  /// Cuts the @p chosen cells (by active cell index) in 4 or 8 and as many others as it takes that no node hangs. Lines are marked: all of
  /// the chosen cells, and the longest line of each triangle, in the mesh or between two tetrahedra, that has a marked one. Each cell is
  /// then bisected at its longest marked line, its parts likewise until none is left; as lines have one order everywhere, neighbours cut
  /// the triangle between them alike. Triangles keep at least half of their smallest angle however often that is done; for tetrahedra
  /// there is no proof, but long experience. What refine_simplices() says of midpoints and ids holds here.
  /// Reference: A. Plaza, G. F. Carey, Applied Numerical Mathematics 32 (2000) 195-218; in the plane M.-C. Rivara, IJNME 20 (1984) 745-756.
  template <int dim>
  RefinedSimplices<dim> refine_simplices(const dealii::Triangulation<dim> &coarse, const std::vector<bool> &chosen);

  /// How many cells that makes.
  template <int dim>
  std::size_t n_cells_after_refinement(const dealii::Triangulation<dim> &coarse, const std::vector<bool> &chosen);

  /// The values of functions of V_h cell by cell, kept while the triangulation under V_h is exchanged.
  template <int dim>
  class InterpolationToChildren
  {
  public:
    using VectorType = dealii::LinearAlgebra::distributed::Vector<double>;

    InterpolationToChildren(const dealii::DoFHandler<dim> &coarse, const std::vector<VectorType> &functions);

    /// The functions on the finer mesh, whose dofs @p fine numbers; exact, since V_h is in the finer space where cells are straight.
    void interpolate(const std::vector<typename RefinedSimplices<dim>::Child> &children,
                     const dealii::DoFHandler<dim>                            &fine,
                     std::vector<VectorType>                                  &functions) const;

  private:
    unsigned                         n_dofs_per_cell;
    std::vector<std::vector<double>> cell_values; ///< per function: n_cells x n_dofs_per_cell
  };
} // namespace unilateral
