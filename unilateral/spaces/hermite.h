// C1 elements of beams and plates: cubic Hermite on segments, bicubic Hermite (Bogner-Fox-Schmit) on axis-parallel rectangles.
#pragma once

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe.h>
#include <deal.II/grid/cell_id.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace unilateral
{
  /// alpha of d^|alpha| / dx_1^alpha_1 .. dx_dim^alpha_dim.
  template <int dim>
  using DerivativeIndex = std::array<unsigned, dim>;

  /// The products of cubic Hermite functions, a subspace of H^2. At each vertex 2^dim DoFs and none elsewhere, the derivatives with
  /// alpha in {0, 1}^dim: u, u_x on segments; u, u_x, u_y, u_xy on rectangles (bicubics, 16 DoFs a cell); 64 DoFs a cell on boxes. They are
  /// derivatives in x, not in the reference cell, so that V_h is C1 on graded meshes too: on the reference coordinate t = (x - x_0)/h
  ///   value at x_0: 1 - 3t^2 + 2t^3,   slope at x_0: h t(1 - t)^2,   value at x_0 + h: 3t^2 - 2t^3,   slope at x_0 + h: -h t^2(1 - t).
  /// A slope DoF has the unit of u divided by that of x: matrices carry powers of h between their rows, which Jacobi scaling removes.
  ///
  /// Works with FEValues, FEFaceValues, FESubfaceValues and FEInterfaceValues: values to third derivatives. The mapping must be linear on
  /// each cell, which that of any degree is where no manifold curves the mesh. Because the shape functions depend on h, there are no
  /// support points (see hermite_nodes()), no shape functions of the reference cell (FiniteElement::shape_value() throws) and no
  /// prolongation matrices (SolutionTransfer and geometric multigrid throw; see HermiteOnFinerMesh). Neither hanging nodes nor other
  /// elements in the same mesh. Evaluation on a cell that is not axis-parallel throws std::invalid_argument; see is_axis_parallel().
  /// Source: F. K. Bogner, R. L. Fox, L. A. Schmit, The generation of inter-element-compatible stiffness and mass matrices by the use of
  /// interpolation formulas, Proc. Conf. Matrix Methods in Structural Mechanics, AFFDL-TR-66-80 (1966) 397-443.
  template <int dim>
  std::unique_ptr<dealii::FiniteElement<dim>> make_hermite_element();

  /// Is each active cell a box with its edges along the axes, and is the first direction of its reference cell +x, the second +y, the third
  /// +z? To 1e-10 of its shortest edge. Triangles and tetrahedra are not.
  template <int dim>
  bool is_axis_parallel(const dealii::Triangulation<dim> &triangulation);

  /// What a DoF of a cell means.
  template <int dim>
  struct HermiteCellDof
  {
    unsigned             vertex; ///< of the cell, in deal.II's order
    DerivativeIndex<dim> derivative;
  };

  /// Does its vertex lie on the face? In deal.II's order bit d of a vertex's number is its coordinate d.
  template <int dim>
  bool lies_on_face(const HermiteCellDof<dim> &dof, const unsigned face)
  {
    return (dof.vertex >> (face / 2) & 1) == face % 2;
  }

  /// In the order of the cell's DoFs: vertex by vertex u, u_x, u_y, u_xy (then u_z, u_xz, u_yz, u_xyz).
  template <int dim>
  std::vector<HermiteCellDof<dim>> hermite_cell_dofs();

  /// What a DoF of V_h means: the derivative of u at a point.
  template <int dim>
  struct HermiteNode
  {
    dealii::Point<dim>   location;
    DerivativeIndex<dim> derivative;
  };

  /// Index: global DoF. The interpolant of a function w has the values u_i = d^alpha w(x), (x, alpha) = hermite_nodes()[i].
  template <int dim>
  std::vector<HermiteNode<dim>> hermite_nodes(const dealii::DoFHandler<dim> &dof_handler);

  /// The DoFs that fix d^k u / dn^k, k = @p normal_order, on the faces with one of these boundary ids, sorted: those with alpha_n = k. They
  /// are derivatives in +x, +y, not in the direction of the outer normal.
  ///   simply supported: k = 0;   clamped: k = 0 and k = 1;   symmetry, or a support that only turns: k = 1.
  /// With data u = g or du/dn = g the values are the derivatives of g along the face, which hermite_nodes() names.
  /// Throws std::invalid_argument unless k is 0 or 1.
  template <int dim>
  std::vector<dealii::types::global_dof_index> hermite_boundary_dofs(const dealii::DoFHandler<dim>                 &dof_handler,
                                                                     const std::vector<dealii::types::boundary_id> &boundary_ids,
                                                                     unsigned                                       normal_order);

  /// Functions of V_h, kept cell by cell while the triangulation under V_h is refined or exchanged for a finer one:
  ///   const HermiteOnFinerMesh<dim> carried(dof_handler, functions);
  ///   triangulation.refine_global(1);
  ///   dof_handler.distribute_dofs(fe);
  ///   carried.interpolate(dof_handler, functions);
  /// The DoFs on the finer mesh are the values and derivatives at its vertices. That reproduces the functions exactly, since V_h is in the
  /// finer space.
  template <int dim>
  class HermiteOnFinerMesh
  {
  public:
    using VectorType = dealii::LinearAlgebra::distributed::Vector<double>;

    HermiteOnFinerMesh(const dealii::DoFHandler<dim> &coarse, const std::vector<VectorType> &functions);

    /// @p fine may number the DoFs of the same triangulation, refined, or of another one that refines the same coarsest cells; each of its
    /// active cells must be one of the coarser mesh or lie in one, any number of levels below.
    /// Throws std::invalid_argument when one does not.
    void interpolate(const dealii::DoFHandler<dim> &fine, std::vector<VectorType> &functions) const;

  private:
    std::map<dealii::CellId, std::size_t> coarse_cells; ///< their places in cell_values
    std::vector<std::vector<double>>      cell_values;  ///< per function: n_cells x n_dofs_per_cell
  };
} // namespace unilateral
