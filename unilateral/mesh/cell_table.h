// Cells of one kind by the numbers of their vertices, in one array.
#pragma once

#include <deal.II/grid/reference_cell.h>

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace unilateral
{
  struct CellTable
  {
    dealii::ReferenceCell reference;
    std::vector<unsigned> vertices; ///< of one cell after the other, in deal.II's order

    unsigned                  n_corners() const { return reference.n_vertices(); }
    std::size_t               size() const { return vertices.size() / n_corners(); }
    std::span<const unsigned> operator[](const std::size_t cell) const { return {&vertices[cell * n_corners()], n_corners()}; }
  };

  /// In place of a vertex or a cell that is not there.
  inline constexpr unsigned no_number = std::numeric_limits<unsigned>::max();

  /// The vertices of a face in ascending order, then `no_number` where it has less than four.
  using VerticesOfFace = std::array<unsigned, 4>;

  /// A face, and the cells it belongs to.
  struct FaceOfCells
  {
    VerticesOfFace          vertices;
    std::array<unsigned, 2> cells;   ///< the first two, ascending; the second is `no_number` on the boundary
    unsigned                number;  ///< among the faces of the first of them
    unsigned                n_cells; ///< more than two: the cells fill no space

    bool at_boundary() const { return n_cells == 1; }
  };

  /// By face of a cell its corners.
  std::vector<std::vector<unsigned>> corners_of_faces(const dealii::ReferenceCell &cell);

  /// All faces, in the order of their vertices. Linear in the number of cells, as long as a vertex has few of them.
  std::vector<FaceOfCells> faces_of(const CellTable &cells);

  /// By cell, whether one before it has the same vertices, in whatever order. Linear, too.
  std::vector<char> repeated_cells(const CellTable &cells);
} // namespace unilateral
