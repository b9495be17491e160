// Cells that are curved: polynomials of degree 2 say where their points lie.
#pragma once

#include "unilateral/mesh/drawn_cells.h"
#include "unilateral/mesh/simplex_refinement.h"

#include <deal.II/base/point.h>
#include <deal.II/fe/fe.h>
#include <deal.II/grid/tria.h>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace unilateral
{
  /// The points of a quadratic mesh that are no vertices, by the vertices around each, ascending: the ends of a line, the corners of a
  /// quadrilateral or of a hexahedron.
  template <int dim>
  using PointsByVertices = std::map<std::vector<unsigned>, dealii::Point<dim>>;

  /// The vertices in the middle of which a node of degree 2 of @p cell lies, ascending; itself where the node is a vertex.
  template <int dim>
  std::vector<unsigned> vertices_around(const typename dealii::Triangulation<dim>::cell_iterator &cell,
                                        const dealii::Point<dim>                                 &unit_node);

  /// Each cell is the image of the reference cell under F, polynomials of degree 2 (in each coordinate for hypercubes) given by their
  /// values at the nodes: the vertices, and the middles of lines, faces and cells. Finer cells are parts of coarse ones, so that refinement
  /// keeps the geometry. Where DrawnCells describe the coarse cells, finer cells have their nodes there instead, so that refinement follows
  /// the drawing.
  template <int dim>
  class CurvedCells
  {
  public:
    using CellIterator = typename dealii::Triangulation<dim>::cell_iterator;

    /// Of a coarse mesh. Points that are missing lie in the middle of their vertices.
    CurvedCells(const dealii::Triangulation<dim> &coarse, const PointsByVertices<dim> &points);

    /// The coarse cells somewhere in which the Jacobian of F is not positive.
    std::vector<CellIterator> folded_cells(const dealii::Triangulation<dim> &coarse) const;

    /// No cell is curved, but for round-off.
    bool straight() const { return is_straight; }

    /// The coarse cells that @p drawing contains have this geometry, which cells of later refinements follow. Where it folds a cell over
    /// itself, the lines, faces and inside of that cell keep degree 2, also as lines and faces of its neighbours.
    void follow_drawing(const dealii::Triangulation<dim> &coarse, DrawnCells<dim> drawing);

    bool follows_drawing() const { return drawn.has_value(); }

    /// Where the nodes are in the reference cell, in the order of FE_Q(2) or FE_SimplexP(2).
    const std::vector<dealii::Point<dim>> &unit_nodes() const { return fe->get_unit_support_points(); }

    /// And in space.
    std::vector<dealii::Point<dim>> nodes(const CellIterator &cell) const;

    /// The x in the reference cell with F(x) = @p p by Newton's method. Throws Mapping::ExcTransformationFailed.
    dealii::Point<dim> unit_point(const CellIterator &cell, const dealii::Point<dim> &p) const;

    /// These cells, by their place on a level of a mesh that has all cells there, become the coarse cells of another one, in this order.
    void keep_cells(const dealii::Triangulation<dim> &triangulation, int level, const std::vector<unsigned> &cells_on_level);

    /// Hypercubes after refinement in place: finer cells get their nodes, and vertices go where they belong. From the first refinement on
    /// that leaves hanging nodes, here or in a part of the mesh that another process has (@p others_have_hanging_nodes), cells are parts of
    /// their parents and do not follow a drawing: they would not fit together.
    void follow_refinement(dealii::Triangulation<dim> &triangulation, bool others_have_hanging_nodes = false);

    /// The same for simplices: @p triangulation takes the place of the coarser one.
    void follow_refinement(dealii::Triangulation<dim> &triangulation, const std::vector<typename RefinedSimplices<dim>::Child> &children);

  private:
    /// A cell as a part of a coarse one: the origin and the ends of the unit vectors of its reference cell in the reference cell of that.
    struct Place
    {
      unsigned                                coarse_cell;
      std::array<dealii::Point<dim>, dim + 1> corners;

      dealii::Point<dim> operator()(const dealii::Point<dim> &unit) const;
      /// Of a child that has its corners there in the reference cell of this one.
      Place of_child(const std::array<dealii::Point<dim>, dim + 1> &corners_of_child) const;
    };

    /// Gives nodes of folded cells of the drawing back the places that they have with degree 2.
    void leave_folded_cells(const dealii::Triangulation<dim> &coarse, DrawnCells<dim> &drawing) const;
    /// Puts the nodes of a finer cell where the drawing has them.
    void                   place_nodes(const Place &place, dealii::Point<dim> *nodes) const;
    dealii::Tensor<2, dim> jacobian(const CellIterator &cell, const dealii::Point<dim> &unit) const;
    dealii::Point<dim>     position(const dealii::Point<dim> *nodes, const dealii::Point<dim> &unit) const;
    void                   move_vertices(const dealii::Triangulation<dim> &triangulation) const;

    std::shared_ptr<const dealii::FiniteElement<dim>> fe;
    bool                                              is_straight = true;
    std::vector<std::vector<dealii::Point<dim>>>      nodes_of_level; ///< by index of the cell; simplices have one level
    std::optional<DrawnCells<dim>>                    drawn;
    std::vector<std::vector<Place>>                   place_of_level;     ///< as nodes_of_level, where there is a drawing
    unsigned                                          n_drawn_levels = 1; ///< of hypercubes: those that follow it
    bool                                              had_hanging_nodes = false;
  };
} // namespace unilateral
