#include "unilateral/mesh/mesh_of_cells.h"

#include "unilateral/base/point_text.h"
#include "unilateral/mesh/cell_orientation.h"
#include "unilateral/mesh/cell_table.h"
#include "unilateral/mesh/curve_cells.h"
#include "unilateral/mesh/hanging_node.h"
#include "unilateral/mesh/names_of_boundary.h"
#include "unilateral/mesh/overlapping_cells.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/reference_cell.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace unilateral
{
  namespace
  {
    using dealii::CellData;
    using dealii::Point;
    using dealii::ReferenceCell;

    template <int dim>
    ReferenceCell reference_cell(const CellKind kind)
    {
      switch (kind)
      {
      case CellKind::segment:
        return dealii::ReferenceCells::Line;
      case CellKind::triangle:
        return dealii::ReferenceCells::Triangle;
      case CellKind::quadrilateral:
        return dealii::ReferenceCells::Quadrilateral;
      case CellKind::tetrahedron:
        return dealii::ReferenceCells::Tetrahedron;
      case CellKind::hexahedron:
        break;
      }
      return dealii::ReferenceCells::Hexahedron;
    }

    template <int dim>
    void orient(std::vector<unsigned> &cell, const CellKind kind, const std::vector<Point<dim>> &points, const SourceLocation &where)
    {
      if (turn_to_positive_volume<dim>(cell, kind != CellKind::quadrilateral && kind != CellKind::hexahedron, points))
        return;
      Point<dim> center;
      for (const unsigned v : cell)
        center += points[v] / double(cell.size());
      throw InputError(where,
                       fmt::format("the mesh has a cell that is flat or folded over itself near {}; make the mesh anew, finer or "
                                   "with another algorithm",
                                   point_text(center)),
                       MessageName("mesh-damaged"));
    }

    template <int dim>
    void
    check_hanging_nodes(const std::vector<VerticesOfFace> &boundary, const std::vector<Point<dim>> &points, const SourceLocation &where)
    {
      if (const auto place = hanging_node(boundary, points))
        throw InputError(where,
                         fmt::format("the mesh has a hanging node at {}: cells meet there that do not share whole faces; make a "
                                     "conforming mesh",
                                     point_text(*place)),
                         MessageName("mesh-damaged"));
    }

    template <int dim>
    void check_overlaps(const CellTable                &cells,
                        const std::vector<FaceOfCells> &faces,
                        const std::vector<unsigned>    &number_in_file,
                        const std::vector<Point<dim>>  &points,
                        const bool                      curved,
                        const SourceLocation           &where)
    {
      const auto found = overlapping_cells(points, cells, faces, curved);
      if (!found)
        return;
      const auto centre = [&](const unsigned cell)
      {
        Point<dim> sum;
        for (const unsigned v : cells[cell])
          sum += points[v] / double(cells.n_corners());
        return point_text(sum);
      };
      throw InputError(where,
                       fmt::format("cells of the mesh lie over each other: number {} around {} and number {} around {}, counted from 1 "
                                   "as in the file; the mesh is folded, or bodies were put together that overlap: make the mesh anew, "
                                   "or remove one of them",
                                   number_in_file[found->first] + 1, centre(found->first), number_in_file[found->second] + 1,
                                   centre(found->second)),
                       MessageName("mesh-damaged"));
    }

    /// How many pieces the cells form when they hold together by their faces only.
    unsigned count_pieces(const std::size_t n_cells, const std::vector<FaceOfCells> &faces)
    {
      std::vector<unsigned> parent(n_cells);
      std::iota(parent.begin(), parent.end(), 0u);
      const auto root = [&](unsigned c)
      {
        while (parent[c] != c)
          c = parent[c] = parent[parent[c]];
        return c;
      };
      unsigned n_pieces = n_cells;
      for (const auto &face : faces)
        if (!face.at_boundary() && root(face.cells[0]) != root(face.cells[1]))
        {
          parent[root(face.cells[0])] = root(face.cells[1]);
          --n_pieces;
        }
      return n_pieces;
    }

    template <int dim>
    std::vector<Point<dim>> points_of(const CellList &list)
    {
      std::vector<Point<dim>> points;
      for (const auto &vertex : list.vertices)
      {
        points.emplace_back();
        for (unsigned d = 0; d < dim; ++d)
          points.back()[d] = vertex[d];
      }
      return points;
    }

    /// The cells of a list, each once and turned to positive volume.
    struct DistinctCells
    {
      CellTable             cells;
      std::vector<unsigned> number_in_file;
    };

    template <int dim>
    DistinctCells distinct_cells(const CellList &list, const std::vector<Point<dim>> &points, const SourceLocation &where)
    {
      CellTable all{reference_cell<dim>(list.kind), {}};
      all.vertices.reserve(list.cells.size() * all.n_corners());
      for (const auto &cell : list.cells)
        all.vertices.insert(all.vertices.end(), cell.begin(), cell.end());
      const auto    repeated = repeated_cells(all);
      DistinctCells distinct{{all.reference, {}}, {}};
      distinct.cells.vertices.reserve(all.vertices.size());
      for (unsigned c = 0; c < all.size(); ++c)
      {
        if (repeated[c])
          continue;
        std::vector<unsigned> cell = list.cells[c];
        orient(cell, list.kind, points, where);
        distinct.cells.vertices.insert(distinct.cells.vertices.end(), cell.begin(), cell.end());
        distinct.number_in_file.push_back(c);
      }
      return distinct;
    }

    /// Those of one cell alone.
    template <int dim>
    std::vector<VerticesOfFace>
    boundary_faces(const std::vector<FaceOfCells> &faces, const std::vector<Point<dim>> &points, const SourceLocation &where)
    {
      std::vector<VerticesOfFace> boundary;
      for (const auto &face : faces)
        if (face.n_cells > 2)
          throw InputError(where,
                           fmt::format("the mesh has a face near {} that {} cells share; cells overlap there, remove the duplicates",
                                       point_text(points[face.vertices.front()]), face.n_cells),
                           MessageName("mesh-damaged"));
        else if (face.at_boundary())
          boundary.push_back(face.vertices);
      return boundary;
    }

    /// The faces of the boundary, of cells that fit together.
    template <int dim>
    std::vector<VerticesOfFace> checked_boundary(
      Mesh<dim> &mesh, const DistinctCells &distinct, const std::vector<Point<dim>> &points, const bool curved, const SourceLocation &where)
    {
      const auto faces = faces_of(distinct.cells);
      const auto boundary = boundary_faces(faces, points, where);
      check_hanging_nodes(boundary, points, where);
      check_overlaps(distinct.cells, faces, distinct.number_in_file, points, curved, where);
      if (const unsigned n_pieces = count_pieces(distinct.cells.size(), faces); n_pieces > 1)
        mesh.warnings.push_back(
          fmt::format("the mesh falls into {} pieces that share no face; where they should hold together, merge their "
                      "nodes (in Gmsh: Coherence, Coherence Mesh)",
                      n_pieces));
      return boundary;
    }

    template <int dim>
    void create_triangulation(Mesh<dim>                     &mesh,
                              const std::vector<Point<dim>> &points,
                              const DistinctCells           &distinct,
                              const std::vector<unsigned>   &cell_region,
                              const SourceLocation          &where)
    {
      std::vector<CellData<dim>> cells(distinct.cells.size(), CellData<dim>(distinct.cells.n_corners()));
      for (unsigned c = 0; c < cells.size(); ++c)
      {
        std::copy(distinct.cells[c].begin(), distinct.cells[c].end(), cells[c].vertices.begin());
        cells[c].material_id = cell_region[distinct.number_in_file[c]];
      }
      try
      {
        if (dim > 1 && !mesh.simplex)
          dealii::GridTools::consistently_order_cells(cells);
        mesh.triangulation->create_triangulation(points, cells, dealii::SubCellData());
      }
      catch (const std::exception &)
      {
        throw InputError(where,
                         "the cells of the mesh do not fit together (they overlap, or faces are joined the wrong way round); check "
                         "it in Gmsh, or make it anew",
                         MessageName("mesh-damaged"));
      }
    }

    /// Which part each face of the boundary belongs to, by the faces of a list.
    class PartsOfFaces
    {
    public:
      explicit PartsOfFaces(const CellList &list) : unnamed(list.part_names.size())
      {
        for (unsigned f = 0; f < list.faces.size(); ++f)
          if (list.faces[f].size() <= VerticesOfFace().size()) // others are no faces of cells
            part.try_emplace(key(list.faces[f]), list.face_part[f]);
      }

      /// Of a face by its vertices in any order.
      template <typename Vertices>
      static VerticesOfFace key(const Vertices &vertices)
      {
        VerticesOfFace result;
        result.fill(no_number);
        std::copy(vertices.begin(), vertices.end(), result.begin());
        std::sort(result.begin(), result.end());
        return result;
      }

      /// The number of its name in the list, or `unnamed`.
      unsigned operator()(const VerticesOfFace &face) const
      {
        const auto found = part.find(face);
        return found == part.end() ? unnamed : found->second;
      }

      const unsigned unnamed;

    private:
      std::map<VerticesOfFace, unsigned> part;
    };

    /// See names_of_boundary().
    template <int dim>
    void name_boundary(Mesh<dim> &mesh, const CellList &list, const std::vector<VerticesOfFace> &boundary)
    {
      const PartsOfFaces         part_of(list);
      const unsigned             unnamed = part_of.unnamed;
      std::vector<std::uint64_t> n_faces(unnamed + 1, 0);
      for (const auto &face : boundary)
        ++n_faces[part_of(face)];
      const auto boundary_id = names_of_boundary(list.part_names, n_faces, mesh.part_names, mesh.warnings);
      for (const auto &cell : mesh.triangulation->active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
          {
            std::vector<unsigned> vertices;
            for (const unsigned v : face->vertex_indices())
              vertices.push_back(face->vertex_index(v));
            face->set_boundary_id(boundary_id[part_of(PartsOfFaces::key(vertices))]);
          }
    }
  } // namespace

  template <int dim>
  Mesh<dim> mesh_of_cells(const CellList &list, const SourceLocation &where)
  {
    if (dimension(list.kind) != dim)
      throw InputError(where,
                       fmt::format("the mesh has {}, but it was {}-D when its names were read; start again when the file no longer "
                                   "changes",
                                   plural_name(list.kind), dim),
                       MessageName("mesh-damaged"));
    Mesh<dim> mesh;
    mesh.simplex = is_simplex(list.kind);
    mesh.approximates_curves = list.approximates_curves;
    mesh.triangulation = std::make_unique<dealii::Triangulation<dim>>();
    mesh.region_names = list.region_names;
    mesh.warnings = list.warnings;

    const auto points = points_of<dim>(list);
    const auto distinct = distinct_cells(list, points, where);
    const auto n_cells = distinct.cells.size();
    if (n_cells < list.cells.size())
      mesh.warnings.push_back(
        fmt::format("{} cells are in the mesh file more than once; each is taken once, in its first region", list.cells.size() - n_cells));
    const auto boundary = checked_boundary(mesh, distinct, points, !list.middle_points.empty(), where);
    create_triangulation(mesh, points, distinct, list.cell_region, where);
    name_boundary(mesh, list, boundary);
    curve_cells(mesh, list, where);
    return mesh;
  }

  template Mesh<1> mesh_of_cells<1>(const CellList &, const SourceLocation &);
  template Mesh<2> mesh_of_cells<2>(const CellList &, const SourceLocation &);
  template Mesh<3> mesh_of_cells<3>(const CellList &, const SourceLocation &);
} // namespace unilateral
