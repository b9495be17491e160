#include "unilateral/evaluation/contact_pieces.h"

#include "unilateral/base/sort_unique.h"
#include "unilateral/discretisation/points_by_cell.h"

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// The cells (faces) with points of a block, in the mesh's order.
    struct CellsOfBlock
    {
      std::vector<std::vector<std::size_t>> points;   ///< of each cell, numbered as in ContactPieces
      std::vector<std::vector<unsigned>>    vertices; ///< of each cell
      std::vector<double>                   measures;

      std::size_t size() const { return points.size(); }
    };

    /// Numbers for places; those of several processes are equal to the last digit where they are one.
    template <int dim>
    class Places
    {
    public:
      /// @p coordinates: dim numbers.
      unsigned number_of(const double *const coordinates)
      {
        std::array<double, dim> place;
        std::copy(coordinates, coordinates + dim, place.begin());
        return numbers.try_emplace(place, numbers.size()).first->second;
      }
      std::size_t size() const { return numbers.size(); }

    private:
      std::map<std::array<double, dim>, unsigned> numbers;
    };

    /// Brings together the points and cells of a block that several processes have parts of; on each of them then is the whole.
    template <int dim>
    void gather(const FunctionSpace<dim> &space, ContactPieces<dim> &pieces, CellsOfBlock &cells)
    {
      const Processes    &processes = space.processes();
      const auto         &vertices = space.mesh.triangulation->get_vertices();
      std::vector<double> points, shapes;
      for (std::size_t i = 0; i < pieces.n_points(); ++i)
      {
        for (unsigned d = 0; d < dim; ++d)
          points.push_back(pieces.x[i][d]);
        points.push_back(pieces.weight[i]);
        points.push_back(pieces.pressure[i]);
      }
      for (std::size_t c = 0; c < cells.size(); ++c)
      {
        shapes.push_back(cells.measures[c]);
        shapes.push_back(cells.points[c].size());
        shapes.push_back(cells.vertices[c].size());
        for (const std::size_t i : cells.points[c])
          for (unsigned d = 0; d < dim; ++d)
            shapes.push_back(pieces.x[i][d]);
        for (const unsigned v : cells.vertices[c])
          for (unsigned d = 0; d < dim; ++d)
            shapes.push_back(vertices[v][d]);
      }
      points = processes.gather(points);
      shapes = processes.gather(shapes);

      pieces.x.clear();
      pieces.weight.clear();
      pieces.pressure.clear();
      cells = {};
      Places<dim> of_points, of_vertices;
      for (const double *entry = points.data(); entry != points.data() + points.size(); entry += dim + 2)
        if (of_points.number_of(entry) == pieces.n_points())
        {
          auto &x = pieces.x.emplace_back();
          for (unsigned d = 0; d < dim; ++d)
            x[d] = entry[d];
          pieces.weight.push_back(entry[dim]);
          pieces.pressure.push_back(entry[dim + 1]);
        }
      for (const double *entry = shapes.data(); entry != shapes.data() + shapes.size();)
      {
        cells.measures.push_back(*entry++);
        cells.points.emplace_back(std::size_t(*entry++));
        cells.vertices.emplace_back(std::size_t(*entry++));
        for (std::size_t &point : cells.points.back())
        {
          point = of_points.number_of(entry);
          entry += dim;
        }
        for (unsigned &vertex : cells.vertices.back())
        {
          vertex = of_vertices.number_of(entry);
          entry += dim;
        }
      }
    }

    template <int dim>
    CellsOfBlock cells_of_block(const Problem<dim> &problem, const ConstraintSet<dim> &set, const std::size_t block)
    {
      CellsOfBlock cells;
      for (const auto &rule : rule_on_cells(problem, set, block))
      {
        cells.points.emplace_back();
        cells.vertices.emplace_back();
        cells.measures.push_back(1);
        const auto add = [&](const auto &entity)
        {
          cells.measures.back() = entity->measure();
          for (const unsigned v : entity->vertex_indices())
            cells.vertices.back().push_back(entity->vertex_index(v));
        };
        if (!rule.face)
          add(rule.cell);
        else if constexpr (dim > 1)
          add(rule.cell->face(*rule.face));
        for (const std::size_t point : rule.points)
          if (point < set.size())
            cells.points.back().push_back(point - set.blocks[block].begin);
      }
      return cells;
    }

    /// The points of each point's cells or, where cells share no points, those of all cells at the vertices of its cell.
    std::vector<std::vector<std::size_t>> neighbors_of_points(const CellsOfBlock &cells, const std::size_t n_points, const bool shared)
    {
      std::map<unsigned, std::vector<std::size_t>> around_vertex;
      if (!shared)
        for (unsigned c = 0; c < cells.size(); ++c)
          for (const unsigned v : cells.vertices[c])
            around_vertex[v].insert(around_vertex[v].end(), cells.points[c].begin(), cells.points[c].end());
      std::vector<std::vector<std::size_t>> neighbors(n_points);
      const auto                            join = [&](const std::vector<std::size_t> &points)
      {
        for (const std::size_t i : points)
          for (const std::size_t j : points)
            if (i != j)
              neighbors[i].push_back(j);
      };
      for (const auto &points : cells.points)
        join(points);
      for (const auto &[vertex, points] : around_vertex)
        join(points);
      for (auto &of_point : neighbors)
        sort_unique(of_point);
      return neighbors;
    }

    /// Holes in the contact zone, see ContactPieces.
    template <int dim>
    class HolesInContact
    {
    public:
      /// @p pieces: those of the points that touch, whose flags are @p touching.
      HolesInContact(const ContactPieces<dim> &pieces, const std::vector<bool> &touching, const CellsOfBlock &cells);

      /// The points that touch, and those in holes.
      std::vector<bool> points_in_contact() const;

    private:
      /// Cells without pressure that hang together.
      struct Region
      {
        std::vector<unsigned> cells;
        bool                  close = true; ///< all of it is to the inside of a piece
        std::set<std::size_t> touched;      ///< pieces
      };

      std::vector<unsigned> distances_from_inside() const;
      Region                region_from(unsigned first, std::vector<bool> &seen) const;
      bool                  is_hole(const Region &region) const;
      std::vector<bool>     cells_outside() const;

      bool inside(const std::size_t i) const { return touching[i] && pieces.depth[i] > 0; }
      bool without_pressure(const unsigned c) const
      {
        return std::none_of(cells.points[c].begin(), cells.points[c].end(), [&](const std::size_t i) { return touching[i]; });
      }

      /// Calls visit(e) for the cells that have a number of vertices in common with cell c: 1, or those of a face.
      template <typename Visit>
      void for_each_around(const unsigned c, const unsigned n_common, const Visit &visit) const
      {
        std::map<unsigned, unsigned> common;
        for (const unsigned v : cells.vertices[c])
          for (const unsigned e : cells_at_vertex.at(v))
            if (e != c && ++common[e] == n_common)
              visit(e);
      }

      static constexpr unsigned                 far = ContactPieces<dim>::widest_hole + 1;
      const ContactPieces<dim>                 &pieces;
      const std::vector<bool>                  &touching;
      const CellsOfBlock                       &cells;
      std::map<unsigned, std::vector<unsigned>> cells_at_vertex;
      std::vector<unsigned>                     distance; ///< of each cell from the inside of the pieces in steps of cells, at most `far`
    };

    template <int dim>
    HolesInContact<dim>::HolesInContact(const ContactPieces<dim> &pieces, const std::vector<bool> &touching, const CellsOfBlock &cells)
      : pieces(pieces), touching(touching), cells(cells)
    {
      for (unsigned c = 0; c < cells.size(); ++c)
        for (const unsigned v : cells.vertices[c])
          cells_at_vertex[v].push_back(c);
      distance = distances_from_inside();
    }

    template <int dim>
    std::vector<unsigned> HolesInContact<dim>::distances_from_inside() const
    {
      std::vector<unsigned> steps(cells.size(), far), queue;
      for (unsigned c = 0; c < cells.size(); ++c)
        if (std::any_of(cells.points[c].begin(), cells.points[c].end(), [&](const std::size_t i) { return inside(i); }))
        {
          steps[c] = 0;
          queue.push_back(c);
        }
      for (std::size_t k = 0; k < queue.size(); ++k)
        for_each_around(queue[k], 1,
                        [&](const unsigned e)
                        {
                          if (steps[e] == far && steps[queue[k]] + 1 < far)
                          {
                            steps[e] = steps[queue[k]] + 1;
                            queue.push_back(e);
                          }
                        });
      return steps;
    }

    template <int dim>
    typename HolesInContact<dim>::Region HolesInContact<dim>::region_from(const unsigned first, std::vector<bool> &seen) const
    {
      Region region{{first}, true, {}};
      seen[first] = true;
      for (std::size_t k = 0; k < region.cells.size(); ++k)
      {
        region.close = region.close && distance[region.cells[k]] < far;
        for_each_around(region.cells[k], std::max(pieces.dimension, 1u),
                        [&](const unsigned e)
                        {
                          if (!seen[e] && without_pressure(e))
                          {
                            seen[e] = true;
                            region.cells.push_back(e);
                          }
                        });
        for_each_around(region.cells[k], 1,
                        [&](const unsigned e)
                        {
                          for (const std::size_t i : cells.points[e])
                            if (touching[i])
                              region.touched.insert(pieces.piece[i]);
                        });
      }
      return region;
    }

    template <int dim>
    bool HolesInContact<dim>::is_hole(const Region &region) const
    {
      const auto has_inside = [&](const std::size_t p)
      { return std::any_of(pieces.members[p].begin(), pieces.members[p].end(), [&](const std::size_t i) { return inside(i); }); };
      const bool beside_one =
        region.close ? std::count_if(region.touched.begin(), region.touched.end(), has_inside) == 1
                     : region.touched.size() == 1 && region.cells.size() <= Utilities::pow(pieces.widest_hole, int(pieces.dimension));
      if (!beside_one)
        return false;
      std::vector<Point<dim>> points_of_pieces;
      for (const std::size_t p : region.touched)
        for (const std::size_t i : pieces.members[p])
          points_of_pieces.push_back(pieces.x[i]);
      const BoundingBox<dim> around(points_of_pieces);
      for (const unsigned c : region.cells)
        for (const std::size_t i : cells.points[c])
          if (!around.point_inside(pieces.x[i], 1e-6))
            return false;
      return true;
    }

    /// Those without pressure that are in no hole.
    template <int dim>
    std::vector<bool> HolesInContact<dim>::cells_outside() const
    {
      std::vector<bool> outside(cells.size(), false), seen(cells.size(), false);
      for (unsigned first = 0; first < cells.size(); ++first)
        if (!seen[first] && without_pressure(first))
        {
          const Region region = region_from(first, seen);
          const bool   hole = is_hole(region);
          for (const unsigned c : region.cells)
            outside[c] = !hole;
        }
      return outside;
    }

    template <int dim>
    std::vector<bool> HolesInContact<dim>::points_in_contact() const
    {
      const std::vector<bool> outside = cells_outside();
      std::vector<bool>       active = touching, beside_outside(touching.size(), false), close(touching.size(), false);
      for (unsigned c = 0; c < cells.size(); ++c)
        for (const std::size_t i : cells.points[c])
        {
          beside_outside[i] = beside_outside[i] || outside[c];
          close[i] = close[i] || distance[c] < far;
        }
      for (std::size_t i = 0; i < touching.size(); ++i)
        if (!touching[i] && !beside_outside[i])
        {
          std::set<std::size_t> touched;
          for (const std::size_t j : pieces.neighbors[i])
            if (touching[j])
              touched.insert(pieces.piece[j]);
          active[i] = close[i] || touched.size() == 1;
        }
      return active;
    }
  } // namespace

  template <int dim>
  ContactPieces<dim>::ContactPieces(const Problem<dim>       &problem,
                                    const ConstraintSet<dim> &set,
                                    const std::size_t         block,
                                    const Vector             &lambda)
  {
    dimension = problem.conditions[block].part ? dim - 1 : dim;
    for (std::size_t i = set.blocks[block].begin; i < set.blocks[block].end; ++i)
    {
      x.push_back(set.points[i].x);
      weight.push_back(set.points[i].weight);
      pressure.push_back(lambda(i));
    }

    CellsOfBlock cells = cells_of_block(problem, set, block);
    if (!problem.space.processes().alone())
      gather(problem.space, *this, cells);
    const std::size_t     n = n_points();
    std::vector<unsigned> n_cells(n, 0);
    cell_size.assign(n, 0.);
    for (std::size_t c = 0; c < cells.size(); ++c)
      for (const std::size_t i : cells.points[c])
      {
        ++n_cells[i];
        cell_size[i] += std::pow(cells.measures[c], 1. / std::max(dimension, 1u));
      }
    for (std::size_t i = 0; i < n; ++i)
      cell_size[i] /= std::max(n_cells[i], 1u);
    const bool shared = std::any_of(n_cells.begin(), n_cells.end(), [](const unsigned c) { return c > 1; });
    neighbors = neighbors_of_points(cells, n, shared);

    std::vector<bool> touching(n);
    for (std::size_t i = 0; i < n; ++i)
      touching[i] = pressure[i] > 0;
    if (!shared)
      for (const auto &points : cells.points)
        if (std::any_of(points.begin(), points.end(), [&](const std::size_t i) { return pressure[i] > 0; }))
          for (const std::size_t i : points)
            touching[i] = true;
    find_pieces(touching);
    find_pieces(HolesInContact<dim>(*this, touching, cells).points_in_contact());
  }

  template <int dim>
  void ContactPieces<dim>::find_pieces(const std::vector<bool> &active)
  {
    members.clear();
    piece.assign(n_points(), none);
    depth.assign(n_points(), no_edge);
    for (std::size_t first = 0; first < n_points(); ++first)
      if (active[first] && piece[first] == none)
      {
        std::vector<std::size_t> found = {first};
        piece[first] = members.size();
        for (std::size_t k = 0; k < found.size(); ++k)
          for (const std::size_t j : neighbors[found[k]])
            if (active[j] && piece[j] == none)
            {
              piece[j] = members.size();
              found.push_back(j);
            }

        std::vector<std::size_t> front;
        for (const std::size_t i : found)
          if (neighbors[i].empty() ||
              std::any_of(neighbors[i].begin(), neighbors[i].end(), [&](const std::size_t j) { return !active[j]; }))
          {
            depth[i] = 0;
            front.push_back(i);
          }
        for (std::size_t k = 0; k < front.size(); ++k)
          for (const std::size_t j : neighbors[front[k]])
            if (active[j] && depth[j] == no_edge)
            {
              depth[j] = depth[front[k]] + 1;
              front.push_back(j);
            }
        members.push_back(std::move(found));
      }
  }

  template struct ContactPieces<1>;
  template struct ContactPieces<2>;
  template struct ContactPieces<3>;
} // namespace unilateral
