#include "unilateral/mesh/cell_table.h"

#include <algorithm>

namespace unilateral
{
  namespace
  {
    /// A cell, or a face of it, by its vertices in ascending order; `no_number` where it has less than @p n.
    template <std::size_t n>
    struct Entity
    {
      std::array<unsigned, n> vertices;
      unsigned                number; ///< of the cell; of a face, counted through all cells

      bool operator<(const Entity &other) const { return vertices != other.vertices ? vertices < other.vertices : number < other.number; }
    };

    /// Sorts by the smallest vertex by counting: few share it, which leaves little to compare.
    template <std::size_t n>
    std::vector<Entity<n>> sorted(const std::vector<Entity<n>> &entities)
    {
      unsigned n_vertices = 0;
      for (const auto &entity : entities)
        n_vertices = std::max(n_vertices, entity.vertices[0] + 1);
      std::vector<std::size_t> end(n_vertices + 1, 0); // first: where the entities of a vertex begin
      for (const auto &entity : entities)
        ++end[entity.vertices[0] + 1];
      for (unsigned v = 0; v < n_vertices; ++v)
        end[v + 1] += end[v];
      std::vector<Entity<n>> result(entities.size());
      for (const auto &entity : entities)
        result[end[entity.vertices[0]]++] = entity;
      for (unsigned v = 0; v < n_vertices; ++v)
        std::sort(result.begin() + (v == 0 ? 0 : end[v - 1]), result.begin() + end[v]);
      return result;
    }
  } // namespace

  std::vector<std::vector<unsigned>> corners_of_faces(const dealii::ReferenceCell &cell)
  {
    std::vector<std::vector<unsigned>> corners(cell.n_faces());
    for (unsigned f = 0; f < corners.size(); ++f)
      for (const unsigned v : cell.face_reference_cell(f).vertex_indices())
        corners[f].push_back(cell.face_to_cell_vertices(f, v, 1));
    return corners;
  }

  std::vector<FaceOfCells> faces_of(const CellTable &cells)
  {
    const auto             corners = corners_of_faces(cells.reference);
    std::vector<Entity<4>> sides;
    sides.reserve(cells.size() * corners.size());
    for (unsigned c = 0; c < cells.size(); ++c)
      for (const auto &face : corners)
      {
        auto &side = sides.emplace_back();
        side.number = sides.size() - 1;
        side.vertices.fill(no_number);
        for (std::size_t v = 0; v < face.size(); ++v)
          side.vertices[v] = cells[c][face[v]];
        std::sort(side.vertices.begin(), side.vertices.begin() + face.size());
      }
    sides = sorted(sides);
    std::vector<FaceOfCells> faces;
    const unsigned           n_faces = corners.size();
    faces.reserve(sides.size() / 2 + sides.size() / 8);
    for (const auto &side : sides)
      if (faces.empty() || faces.back().vertices != side.vertices)
        faces.push_back({side.vertices, {side.number / n_faces, no_number}, side.number % n_faces, 1});
      else if (++faces.back().n_cells == 2)
        faces.back().cells[1] = side.number / n_faces;
    return faces;
  }

  std::vector<char> repeated_cells(const CellTable &cells)
  {
    std::vector<Entity<8>> entities(cells.size());
    for (unsigned c = 0; c < cells.size(); ++c)
    {
      auto &vertices = entities[c].vertices;
      vertices.fill(no_number);
      std::copy(cells[c].begin(), cells[c].end(), vertices.begin());
      std::sort(vertices.begin(), vertices.begin() + cells.n_corners());
      entities[c].number = c;
    }
    entities = sorted(entities);
    std::vector<char> repeated(cells.size(), false);
    for (std::size_t k = 1; k < entities.size(); ++k)
      repeated[entities[k].number] = entities[k].vertices == entities[k - 1].vertices;
    return repeated;
  }
} // namespace unilateral
