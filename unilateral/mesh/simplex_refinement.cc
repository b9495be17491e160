#include "unilateral/mesh/simplex_refinement.h"

#include <deal.II/base/tensor.h>
#include <deal.II/fe/fe.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Three at the corners, one in the middle.
    const std::vector<std::array<Corner, 3>> children_of_triangle = {
      {{{0, 0}, {0, 1}, {0, 2}}}, {{{0, 1}, {1, 1}, {1, 2}}}, {{{0, 2}, {1, 2}, {2, 2}}}, {{{1, 2}, {0, 2}, {0, 1}}}};

    /// Four at the corners, four around the diagonal of the octahedron between them.
    const std::vector<std::array<Corner, 4>> children_of_tetrahedron = {
      {{{0, 0}, {0, 1}, {0, 2}, {0, 3}}}, {{{0, 1}, {1, 1}, {1, 2}, {1, 3}}}, {{{0, 2}, {1, 2}, {2, 2}, {2, 3}}},
      {{{0, 3}, {1, 3}, {2, 3}, {3, 3}}}, {{{0, 1}, {0, 2}, {0, 3}, {1, 3}}}, {{{0, 1}, {0, 2}, {1, 2}, {1, 3}}},
      {{{0, 2}, {0, 3}, {1, 3}, {2, 3}}}, {{{0, 2}, {1, 2}, {1, 3}, {2, 3}}}};

    template <int dim>
    double orientation(const std::array<Point<dim>, dim + 1> &corners)
    {
      Tensor<2, dim> edges;
      for (unsigned d = 0; d < dim; ++d)
        edges[d] = corners[d + 1] - corners[0];
      return determinant(edges);
    }

    /// Numbers the corners of children: the coarse vertices first, then the midpoints of the coarse lines.
    template <int dim>
    class Vertices
    {
    public:
      explicit Vertices(const Triangulation<dim> &coarse) : points(coarse.get_vertices()), of_line(coarse.n_raw_lines(), none) {}

      template <typename CellIterator>
      unsigned index(const CellIterator &cell, const Corner &corner)
      {
        if (corner.first == corner.second)
          return cell->vertex_index(corner.first);
        for (const auto l : cell->line_indices())
        {
          const auto     line = cell->line(l);
          const unsigned a = line->vertex_index(0), b = line->vertex_index(1);
          const unsigned i = cell->vertex_index(corner.first), j = cell->vertex_index(corner.second);
          if ((a == i && b == j) || (a == j && b == i))
          {
            unsigned &number = of_line[line->index()];
            if (number == none)
            {
              number = points.size();
              points.push_back(line->center(/*respect_manifold=*/true));
              cut_lines.emplace_back(a, b);
            }
            return number;
          }
        }
        Assert(false, ExcInternalError());
        return none;
      }

      std::vector<Point<dim>> points;
      CutLines                cut_lines;

    private:
      static constexpr unsigned none = numbers::invalid_unsigned_int;
      std::vector<unsigned>     of_line;
    };

    template <int dim>
    std::vector<std::array<Corner, dim + 1>> children_in_order(const CornerOrder &order)
    {
      auto children = children_of_simplex<dim>();
      for (auto &corners : children)
        for (Corner &corner : corners)
          corner = {order[corner.first], order[corner.second]};
      return children;
    }

    /// Lengths that differ by rounding become equal, but for those next to a limit.
    double without_last_digits(const double length)
    {
      constexpr int n_bits = 30;
      int           exponent = 0;
      const double  mantissa = std::frexp(length, &exponent);
      return std::ldexp(std::round(std::ldexp(mantissa, n_bits)), exponent - n_bits);
    }

    /// The lines of a mesh that are to be cut, in an order that all cells see alike, and all processes: by length, and equal ones by where
    /// they are.
    template <int dim>
    class MarkedLines
    {
    public:
      MarkedLines(const Triangulation<dim> &mesh, const std::vector<bool> &chosen, const MarkingBeyondCuts &beyond = {})
        : marked(mesh.n_raw_lines(), false)
      {
        order.resize(mesh.n_raw_lines());
        lines_between.resize(mesh.n_active_cells());
        for (const auto &cell : mesh.active_cell_iterators())
          for (const auto l : cell->line_indices())
          {
            const auto     line = cell->line(l);
            const unsigned a = line->vertex_index(0), b = line->vertex_index(1);
            order[line->index()].first = without_last_digits(line->vertex(0).distance(line->vertex(1)));
            for (unsigned d = 0; d < dim; ++d)
              order[line->index()].second[d] = line->vertex(0)[d] + line->vertex(1)[d];
            if (chosen[cell->active_cell_index()])
              marked[line->index()] = true;
            for (unsigned i = 0; i <= dim; ++i)
              for (unsigned j = 0; j <= dim; ++j)
                if (cell->vertex_index(i) == a && cell->vertex_index(j) == b)
                  lines_between[cell->active_cell_index()][i][j] = lines_between[cell->active_cell_index()][j][i] = line->index();
          }
        do
          mark_longest_lines();
        while (beyond && beyond(marked));
      }

      /// The first of the lines between corners of a part of @p cell that is to be cut yet.
      template <typename CellIterator>
      std::optional<Corner> first(const CellIterator &cell, const std::array<Corner, dim + 1> &corners) const
      {
        std::optional<Corner> found;
        unsigned              line_found = 0;
        for (unsigned k = 0; k <= dim; ++k)
          for (unsigned l = k + 1; l <= dim; ++l)
            if (corners[k].first == corners[k].second && corners[l].first == corners[l].second) // a line of the cell
              if (const unsigned line = lines_between[cell->active_cell_index()][corners[k].first][corners[l].first];
                  marked[line] && (!found || order[line_found] < order[line]))
              {
                found = Corner(corners[k].first, corners[l].first);
                line_found = line;
              }
        return found;
      }

    private:
      void mark_longest_lines()
      {
        for (bool changed = true; changed;)
        {
          changed = false;
          for (const auto &line : lines_between)
            for (unsigned i = 0; i <= dim; ++i)
              for (unsigned j = i + 1; j <= dim; ++j)
                for (unsigned k = j + 1; k <= dim; ++k) // each triangle
                {
                  const unsigned lines[] = {line[i][j], line[j][k], line[i][k]};
                  if (!marked[lines[0]] && !marked[lines[1]] && !marked[lines[2]])
                    continue;
                  const unsigned longest = *std::max_element(std::begin(lines), std::end(lines),
                                                             [&](const unsigned a, const unsigned b) { return order[a] < order[b]; });
                  changed = changed || !marked[longest];
                  marked[longest] = true;
                }
        }
      }

      std::vector<std::array<std::array<unsigned, dim + 1>, dim + 1>> lines_between; ///< two vertices of a cell, by active cell
      std::vector<bool>                                               marked;        ///< by index of the line
      std::vector<std::pair<double, std::array<double, dim>>>         order;         ///< length and twice the middle; likewise
    };

    /// The parts of a cell that is bisected at marked lines until none is left.
    template <int dim, typename CellIterator>
    void cut_at_marked_lines(const CellIterator                       &cell,
                             const std::array<Corner, dim + 1>        &corners,
                             const MarkedLines<dim>                   &marked,
                             std::vector<std::array<Corner, dim + 1>> &parts)
    {
      const auto line = marked.first(cell, corners);
      if (!line)
      {
        parts.push_back(corners);
        return;
      }
      for (const unsigned end : {line->first, line->second})
      {
        auto part = corners;
        std::replace(part.begin(), part.end(), Corner(end, end), *line);
        cut_at_marked_lines(cell, part, marked, parts);
      }
    }

    template <int dim>
    std::array<Corner, dim + 1> whole_cell()
    {
      std::array<Corner, dim + 1> corners;
      for (unsigned k = 0; k <= dim; ++k)
        corners[k] = {k, k};
      return corners;
    }

    /// Those of the parts' faces that lie on a face of the cell, which is on the boundary, get its id.
    template <int dim, typename CellIterator>
    void add_boundary_faces(const CellIterator                             &cell,
                            const unsigned                                  face,
                            const std::vector<std::array<Corner, dim + 1>> &parts,
                            Vertices<dim>                                  &vertices,
                            SubCellData                                    &boundary)
    {
      unsigned opposite = 0;
      for (const auto v : cell->vertex_indices())
      {
        bool on_face = false;
        for (const auto w : cell->face(face)->vertex_indices())
          on_face = on_face || cell->vertex_index(v) == cell->face(face)->vertex_index(w);
        if (!on_face)
          opposite = v;
      }
      for (const auto &part : parts)
      {
        std::vector<unsigned> on_face;
        for (const Corner &corner : part)
          if (corner.first != opposite && corner.second != opposite)
            on_face.push_back(vertices.index(cell, corner));
        if (on_face.size() < dim)
          continue;
        CellData<dim - 1> piece(dim);
        piece.vertices = on_face;
        piece.boundary_id = cell->face(face)->boundary_id();
        piece.manifold_id = numbers::flat_manifold_id;
        if constexpr (dim == 2)
          boundary.boundary_lines.push_back(piece);
        else
          boundary.boundary_quads.push_back(piece);
      }
    }

    /// A mesh of the parts that @p parts_of(cell, vertices) names.
    template <int dim, typename PartsOf>
    RefinedSimplices<dim> mesh_of_parts(const Triangulation<dim> &coarse, const PartsOf &parts_of)
    {
      RefinedSimplices<dim>      refined;
      Vertices<dim>              vertices(coarse);
      std::vector<CellData<dim>> cells;
      SubCellData                boundary;
      for (const auto &cell : coarse.active_cell_iterators())
      {
        const std::vector<std::array<Corner, dim + 1>> parts = parts_of(cell, vertices);
        for (const auto &corners : parts)
        {
          typename RefinedSimplices<dim>::Child child;
          child.parent = cell->active_cell_index();
          CellData<dim>                   fine(dim + 1);
          std::array<Point<dim>, dim + 1> location;
          for (unsigned k = 0; k <= dim; ++k)
          {
            fine.vertices[k] = vertices.index(cell, corners[k]);
            location[k] = vertices.points[fine.vertices[k]];
            child.corners[k] = reference_point<dim>(corners[k]);
          }
          CornerOrder order = in_sequence;
          if (orientation<dim>(location) < 0)
          {
            std::swap(fine.vertices[dim - 1], fine.vertices[dim]);
            std::swap(child.corners[dim - 1], child.corners[dim]);
            std::swap(order[dim - 1], order[dim]);
          }
          refined.corner_orders.push_back(order);
          fine.material_id = cell->material_id();
          cells.push_back(fine);
          refined.children.push_back(child);
        }
        for (const auto face : cell->face_indices())
          if (cell->face(face)->at_boundary())
            add_boundary_faces<dim>(cell, face, parts, vertices, boundary);
      }
      refined.triangulation = std::make_unique<Triangulation<dim>>();
      refined.triangulation->create_triangulation(vertices.points, cells, boundary);
      refined.cut_lines = std::move(vertices.cut_lines);
      // Meshes of simplices have one manifold throughout, if any.
      if (const auto id = coarse.begin_active()->manifold_id(); id != numbers::flat_manifold_id)
      {
        refined.triangulation->set_all_manifold_ids(id);
        refined.triangulation->set_manifold(id, coarse.get_manifold(id));
      }
      return refined;
    }
  } // namespace

  template <int dim>
  const std::vector<std::array<Corner, dim + 1>> &children_of_simplex()
  {
    if constexpr (dim == 2)
      return children_of_triangle;
    else
      return children_of_tetrahedron;
  }

  template <int dim>
  std::vector<CornerOrder> orders_by_shortest_diagonal(const Triangulation<dim> &mesh)
  {
    std::vector<CornerOrder> orders(mesh.n_active_cells(), in_sequence);
    if constexpr (dim == 3)
    {
      constexpr CornerOrder candidates[] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 1, 3, 2}}; // each cuts along another one
      for (const auto &cell : mesh.active_cell_iterators())
      {
        const auto length = [&](const CornerOrder &order)
        {
          return without_last_digits(
            ((cell->vertex(order[0]) - cell->vertex(order[1])) + (cell->vertex(order[2]) - cell->vertex(order[3]))).norm());
        };
        orders[cell->active_cell_index()] = *std::min_element(
          std::begin(candidates), std::end(candidates), [&](const CornerOrder &a, const CornerOrder &b) { return length(a) < length(b); });
      }
    }
    return orders;
  }

  template <int dim>
  RefinedSimplices<dim> refine_simplices(const Triangulation<dim> &coarse, const std::vector<CornerOrder> &orders)
  {
    return mesh_of_parts<dim>(coarse,
                              [&](const auto &cell, Vertices<dim> &) { return children_in_order<dim>(orders[cell->active_cell_index()]); });
  }

  template <int dim>
  RefinedSimplices<dim> refine_simplices(const Triangulation<dim> &coarse, const std::vector<bool> &chosen, const MarkingBeyondCuts &beyond)
  {
    const MarkedLines<dim> marked(coarse, chosen, beyond);
    auto                   refined = mesh_of_parts<dim>(coarse,
                                      [&](const auto &cell, Vertices<dim> &)
                                      {
                                        std::vector<std::array<Corner, dim + 1>> parts;
                                        cut_at_marked_lines<dim>(cell, whole_cell<dim>(), marked, parts);
                                        return parts;
                                      });
    refined.corner_orders = orders_by_shortest_diagonal(*refined.triangulation);
    return refined;
  }

  template <int dim>
  std::size_t n_cells_after_refinement(const Triangulation<dim> &coarse, const std::vector<bool> &chosen)
  {
    const MarkedLines<dim>                   marked(coarse, chosen);
    std::vector<std::array<Corner, dim + 1>> parts;
    std::size_t                              n = 0;
    for (const auto &cell : coarse.active_cell_iterators())
    {
      parts.clear();
      cut_at_marked_lines<dim>(cell, whole_cell<dim>(), marked, parts);
      n += parts.size();
    }
    return n;
  }

  template <int dim>
  InterpolationToChildren<dim>::InterpolationToChildren(const DoFHandler<dim> &coarse, const std::vector<VectorType> &functions)
    : n_dofs_per_cell(coarse.get_fe().n_dofs_per_cell()), cell_values(functions.size())
  {
    std::vector<types::global_dof_index> dofs(n_dofs_per_cell);
    for (const auto &cell : coarse.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      for (std::size_t f = 0; f < functions.size(); ++f)
        for (const auto dof : dofs)
          cell_values[f].push_back(functions[f](dof));
    }
  }

  template <int dim>
  void InterpolationToChildren<dim>::interpolate(const std::vector<typename RefinedSimplices<dim>::Child> &children,
                                                 const DoFHandler<dim>                                    &fine,
                                                 std::vector<VectorType>                                  &functions) const
  {
    const auto                          &fe = fine.get_fe();
    const auto                          &nodes = fe.get_unit_support_points();
    std::vector<types::global_dof_index> dofs(n_dofs_per_cell);
    std::vector<double>                  shape(n_dofs_per_cell);
    std::vector<bool>                    known(functions.empty() ? 0 : fine.n_dofs());
    for (auto &function : functions)
      function.reinit(fine.n_dofs());
    if (functions.empty())
      return;
    for (const auto &cell : fine.active_cell_iterators())
    {
      const auto &child = children[cell->active_cell_index()];
      cell->get_dof_indices(dofs);
      for (unsigned i = 0; i < n_dofs_per_cell; ++i)
      {
        if (known[dofs[i]])
          continue;
        known[dofs[i]] = true;
        Point<dim> x = child.corners[0];
        for (unsigned d = 0; d < dim; ++d)
          x += nodes[i][d] * (child.corners[d + 1] - child.corners[0]);
        for (unsigned k = 0; k < n_dofs_per_cell; ++k)
          shape[k] = fe.system_to_component_index(k).first == fe.system_to_component_index(i).first ? fe.shape_value(k, x) : 0.;
        for (std::size_t f = 0; f < functions.size(); ++f)
        {
          const double *values = &cell_values[f][std::size_t(child.parent) * n_dofs_per_cell];
          double        sum = 0;
          for (unsigned k = 0; k < n_dofs_per_cell; ++k)
            sum += values[k] * shape[k];
          functions[f](dofs[i]) = sum;
        }
      }
    }
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template struct RefinedSimplices<dim>;                                                                                                   \
  template const std::vector<std::array<Corner, dim + 1>> &children_of_simplex<dim>();                                                     \
  template std::vector<CornerOrder>                        orders_by_shortest_diagonal(const Triangulation<dim> &);                        \
  template RefinedSimplices<dim>                           refine_simplices(const Triangulation<dim> &, const std::vector<CornerOrder> &); \
  template RefinedSimplices<dim> refine_simplices(const Triangulation<dim> &, const std::vector<bool> &, const MarkingBeyondCuts &);       \
  template std::size_t           n_cells_after_refinement(const Triangulation<dim> &, const std::vector<bool> &);                          \
  template class InterpolationToChildren<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
