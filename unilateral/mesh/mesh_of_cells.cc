#include "unilateral/mesh/mesh_of_cells.h"

#include "unilateral/base/point_text.h"
#include "unilateral/mesh/box_tree.h"
#include "unilateral/mesh/cell_table.h"
#include "unilateral/mesh/curve_cells.h"
#include "unilateral/mesh/overlapping_cells.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/reference_cell.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

    /// Volume spanned by the edges that leave corner @p c, relative to their lengths: -1 (mirrored cube) to 1 (cube).
    template <int dim>
    double corner_volume(const std::vector<Point<dim>> &points, const std::vector<unsigned> &cell, const bool simplex, const unsigned c)
    {
      dealii::Tensor<2, dim> edges;
      double                 lengths = 1;
      for (unsigned d = 0; d < dim; ++d)
      {
        // Edge d of a hypercube joins the corners whose numbers differ in bit d; that of a simplex leads to the d-th of the others.
        const unsigned bit = 1u << d, from = simplex ? c : c & ~bit, to = simplex ? d + (d >= c) : c | bit;
        edges[d] = points[cell[to]] - points[cell[from]];
        lengths *= edges[d].norm();
      }
      const double sign = simplex && c % 2 == 1 ? -1 : 1; // of the permutation that brings the corner to the front
      return lengths > 0 ? sign * dealii::determinant(edges) / lengths : 0;
    }

    /// Mirrors the vertex order, which changes the sign of the volume.
    void mirror(std::vector<unsigned> &cell, const CellKind kind)
    {
      switch (kind)
      {
      case CellKind::segment:
      case CellKind::triangle:
      case CellKind::tetrahedron:
        std::swap(cell[0], cell[1]);
        break;
      case CellKind::quadrilateral:
        std::swap(cell[1], cell[2]);
        break;
      case CellKind::hexahedron:
        for (unsigned v = 0; v < 4; ++v)
          std::swap(cell[v], cell[v + 4]);
      }
    }

    template <int dim>
    void orient(std::vector<unsigned> &cell, const CellKind kind, const std::vector<Point<dim>> &points, const SourceLocation &where)
    {
      const bool simplex = kind != CellKind::quadrilateral && kind != CellKind::hexahedron;
      double     smallest = std::numeric_limits<double>::max(), largest = -smallest;
      bool       finite = true;
      for (unsigned c = 0; c < cell.size(); ++c)
      {
        const double volume = corner_volume(points, cell, simplex, c);
        finite = finite && std::isfinite(volume); // coordinates too large for a volume, or none at all
        smallest = std::min(smallest, volume);
        largest = std::max(largest, volume);
      }
      // The corners of a simplex span the same volume, and see it at angles of their own: one may be sharp, as long as its edges are not
      // parallel up to round-off.
      constexpr double flat = 1e-10, round_off = 1e-13;
      const auto       positive = [simplex](const double least, const double most)
      { return simplex ? most > flat && least > round_off : least > flat; };
      if (finite && positive(-largest, -smallest))
        mirror(cell, kind);
      else if (!finite || !positive(smallest, largest))
      {
        Point<dim> center;
        for (const unsigned v : cell)
          center += points[v] / double(cell.size());
        throw InputError(where,
                         fmt::format("the mesh has a cell that is flat or folded over itself near {}; make the mesh anew, finer or "
                                     "with another algorithm",
                                     point_text(center)),
                         MessageName("mesh-damaged"));
      }
    }

    /// The vertices of a face that it has.
    std::span<const unsigned> vertices_of(const VerticesOfFace &face)
    {
      return {face.begin(), std::find(face.begin(), face.end(), no_number)};
    }

    /// A vertex of the boundary in the middle of an edge or face of the boundary: the neighbour there is cut finer, and does not fit.
    template <int dim>
    void
    check_hanging_nodes(const std::vector<VerticesOfFace> &boundary, const std::vector<Point<dim>> &points, const SourceLocation &where)
    {
      if (dim == 1)
        return;
      double                size = 0;
      std::vector<unsigned> vertices;
      for (const auto &face : boundary)
      {
        const auto of_face = vertices_of(face);
        size = std::max(size, points[of_face.front()].distance(points[of_face.back()]));
        vertices.insert(vertices.end(), of_face.begin(), of_face.end());
      }
      std::sort(vertices.begin(), vertices.end());
      vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
      std::vector<typename BoxTree<dim>::Box> places;
      for (const unsigned v : vertices)
        places.emplace_back(points[v], points[v]);
      const BoxTree<dim> tree(places);
      const double       tolerance = 1e-7 * size;
      Point<dim>         around;
      for (unsigned d = 0; d < dim; ++d)
        around[d] = tolerance;
      for (const auto &face : boundary)
        for (const unsigned a : vertices_of(face))
          for (const unsigned b : vertices_of(face))
          {
            const Point<dim> middle = points[a] + (points[b] - points[a]) / 2;
            if (b < a && tree.any({Point<dim>(middle - around), Point<dim>(middle + around)},
                                  [&](const unsigned k) { return points[vertices[k]].distance(middle) < tolerance; }))
              throw InputError(where,
                               fmt::format("the mesh has a hanging node at {}: cells meet there that do not share whole faces; make a "
                                           "conforming mesh",
                                           point_text(middle)),
                               MessageName("mesh-damaged"));
          }
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

    /// Parts get their numbers in the order of the file, those without a face on the boundary get none.
    template <int dim>
    void name_boundary(Mesh<dim> &mesh, const CellList &list, const std::vector<VerticesOfFace> &boundary)
    {
      const PartsOfFaces    part_of(list);
      const unsigned        unnamed = part_of.unnamed;
      std::vector<unsigned> n_faces(unnamed + 1, 0), boundary_id(unnamed + 1, 0);
      for (const auto &face : boundary)
        ++n_faces[part_of(face)];
      for (unsigned p = 0; p <= unnamed; ++p)
      {
        const std::string name = p < unnamed ? list.part_names[p] : "boundary";
        const auto        same = std::find(mesh.part_names.begin(), mesh.part_names.end(), name);
        boundary_id[p] = same - mesh.part_names.begin();
        if (n_faces[p] > 0 && same == mesh.part_names.end())
          mesh.part_names.push_back(name);
        else if (n_faces[p] == 0 && p < unnamed)
          mesh.warnings.push_back(fmt::format("part '{}' of the mesh has no face on the boundary and is left out", name));
      }
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
