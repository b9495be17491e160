// Cells, vertices and names as a file holds them.
#pragma once

#include "unilateral/base/diagnostics.h"
#include "unilateral/mesh/mesh_outline.h"

#include <array>
#include <string>
#include <vector>

namespace unilateral
{
  enum class CellKind
  {
    segment,
    triangle,
    quadrilateral,
    tetrahedron,
    hexahedron
  };

  /// "triangles", ...
  std::string plural_name(CellKind kind);

  /// Of the space that such cells fill.
  unsigned dimension(CellKind kind);

  /// Triangles and tetrahedra. Segments can be either.
  bool is_simplex(CellKind kind);

  /// Cells of one kind, with names on cells and faces.
  struct CellList
  {
    CellKind                           kind = CellKind::segment;
    std::vector<std::array<double, 3>> vertices;    ///< all used; 2-D: z = 0, 1-D: y = z = 0
    std::vector<std::vector<unsigned>> cells;       ///< vertex numbers; quadrilaterals and hexahedra in deal.II's (lexicographic) order
    std::vector<unsigned>              cell_region; ///< index into region_names
    std::vector<std::string>           region_names;
    std::vector<std::vector<unsigned>> faces;     ///< those with a name; vertex numbers in any order
    std::vector<unsigned>              face_part; ///< index into part_names
    std::vector<std::string>           part_names;
    std::vector<std::string>           warnings;
    /// Of cells of order 2 the points that are no vertices, in the middle of the vertices with these numbers, see PointsByVertices.
    std::vector<std::vector<unsigned>> middle_vertices;
    std::vector<std::array<double, 3>> middle_points;
    /// Of a drawing cells that are curved, as polynomials of a higher degree, see DrawnCells: their numbers, and for each the values at
    /// equidistant_points() of a reference cell with the vertices of `cells`.
    unsigned                           drawn_degree = 0;
    std::vector<unsigned>              drawn_cells;
    std::vector<std::array<double, 3>> drawn_points;
    bool                               approximates_curves = false; ///< made from a drawing with curves or curved surfaces
  };

  /// Its names: those of the list, and "boundary", which faces without a name are called if there are any.
  MeshOutline outline_of(const CellList &list);

  /// Throws InputError at @p where unless cells are simplices for elements on simplices (@p simplex), and else are not.
  void check_kind_of_cells(CellKind kind, bool simplex, const SourceLocation &where);
} // namespace unilateral
