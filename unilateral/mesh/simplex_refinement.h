// Refinement of triangles and tetrahedra, everywhere or in places, that keeps their quality, and interpolation onto the finer mesh.
#pragma once

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace unilateral
{
  /// The lines of a mesh that refinement has cut, by the vertices at their ends: their midpoints are the last vertices of the finer mesh,
  /// in this order, and the vertices of the coarser one come first with the same numbers.
  using CutLines = std::vector<std::pair<unsigned, unsigned>>;

  /// The corners of a cell in the order in which refine_simplices() sees them.
  using CornerOrder = std::array<unsigned char, 4>;
  constexpr CornerOrder in_sequence = {0, 1, 2, 3};

  /// A corner of a child as the middle of two corners of the parent: a vertex (i, i) or the midpoint of an edge (i, j).
  using Corner = std::pair<unsigned, unsigned>;

  /// That corner in the parent's reference coordinates.
  template <int dim>
  dealii::Point<dim> reference_point(const Corner &corner)
  {
    dealii::Point<dim> x;
    for (const unsigned i : {corner.first, corner.second})
      if (i > 0)
        x[i - 1] += 0.5;
    return x;
  }

  /// The children of a cell whose corners are in their order, and the corners of each child in its own. The children of a triangle are
  /// similar to it, the last one turned by 180 degrees; those of a tetrahedron are of three shapes, and so are theirs.
  template <int dim>
  const std::vector<std::array<Corner, dim + 1>> &children_of_simplex();

  /// For each active cell an order in which its octahedron is cut along its shortest diagonal. In the plane that of the cell itself.
  template <int dim>
  std::vector<CornerOrder> orders_by_shortest_diagonal(const dealii::Triangulation<dim> &mesh);

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
    std::vector<Child>                          children;      ///< by active cell index of the finer mesh
    std::vector<CornerOrder>                    corner_orders; ///< likewise; after refinement in places as for a coarse mesh
    CutLines                                    cut_lines;
  };

  /// Cuts each triangle in 4, each tetrahedron in 8, those of a cell one after the other. The octahedron inside a tetrahedron is cut along
  /// the diagonal between the midpoints of corners 0, 2 and 1, 3 in the order that is given; with the orders that this makes for the
  /// children, a tetrahedron refined again and again has descendants of three shapes, of which the worst is as good as if each time the
  /// shortest diagonal were taken (deal.II 9.4 takes a fixed one; cells then degenerate and P1 loses its order). Edge midpoints follow the
  /// manifold; boundary, material and manifold ids are kept.
  /// Reference: J. Bey, Tetrahedral grid refinement, Computing 55 (1995) 355-378.
  template <int dim>
  RefinedSimplices<dim> refine_simplices(const dealii::Triangulation<dim> &coarse, const std::vector<CornerOrder> &orders);

  /// Marks lines of a part of a mesh, by their index, that other processes have marked in theirs, and says whether that marked any line on
  /// any process. Collective.
  using MarkingBeyondCuts = std::function<bool(std::vector<bool> &marked)>;

  /// Cuts the @p chosen cells (by active cell index) in 4 or 8 and as many others as it takes that no node hangs. Lines are marked: all of
  /// the chosen cells, and the longest line of each triangle, in the mesh or between two tetrahedra, that has a marked one. Each cell is
  /// then bisected at its longest marked line, its parts likewise until none is left; as lines have one order everywhere, neighbours cut
  /// the triangle between them alike, also where they belong to different processes, which @p beyond asks. Triangles keep at least half of
  /// their smallest angle however often that is done; for tetrahedra there is no proof, but long experience. What refine_simplices() says
  /// of midpoints and ids holds here. Reference: A. Plaza, G. F. Carey, Applied Numerical Mathematics 32 (2000) 195-218; in the plane M.-C.
  /// Rivara, IJNME 20 (1984) 745-756.
  template <int dim>
  RefinedSimplices<dim>
  refine_simplices(const dealii::Triangulation<dim> &coarse, const std::vector<bool> &chosen, const MarkingBeyondCuts &beyond = {});

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
