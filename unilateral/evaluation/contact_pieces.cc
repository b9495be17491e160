#include "unilateral/evaluation/contact_pieces.h"

#include "unilateral/discretisation/points_by_cell.h"

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  ContactPieces<dim>::ContactPieces(const Problem<dim>       &problem,
                                    const ConstraintSet<dim> &set,
                                    const std::size_t         block,
                                    const Vector             &lambda)
  {
    const std::size_t begin = set.blocks[block].begin, n = set.blocks[block].end - begin;
    dimension = problem.conditions[block].part ? dim - 1 : dim;
    for (std::size_t i = begin; i < begin + n; ++i)
    {
      x.push_back(set.points[i].x);
      weight.push_back(set.points[i].weight);
      pressure.push_back(lambda(i));
    }

    std::vector<std::vector<std::size_t>> points_of_cell;
    std::vector<std::vector<unsigned>>    vertices_of_cell;
    std::vector<unsigned>                 n_cells(n, 0);
    cell_size.assign(n, 0.);
    for (const auto &rule : rule_on_cells(problem, set, block))
    {
      points_of_cell.emplace_back();
      vertices_of_cell.emplace_back();
      double measure = 1;
      if (!rule.face)
      {
        measure = rule.cell->measure();
        for (const unsigned v : rule.cell->vertex_indices())
          vertices_of_cell.back().push_back(rule.cell->vertex_index(v));
      }
      else if constexpr (dim > 1)
      {
        const auto face = rule.cell->face(*rule.face);
        measure = face->measure();
        for (const unsigned v : face->vertex_indices())
          vertices_of_cell.back().push_back(face->vertex_index(v));
      }
      for (const std::size_t point : rule.points)
        if (point < set.size())
        {
          const std::size_t i = point - begin;
          points_of_cell.back().push_back(i);
          ++n_cells[i];
          cell_size[i] += std::pow(measure, 1. / std::max(dimension, 1u));
        }
    }
    for (std::size_t i = 0; i < n; ++i)
      cell_size[i] /= std::max(n_cells[i], 1u);

    const bool shared = std::any_of(n_cells.begin(), n_cells.end(), [](const unsigned c) { return c > 1; });
    std::map<unsigned, std::vector<std::size_t>> around_vertex;
    if (!shared)
      for (unsigned c = 0; c < points_of_cell.size(); ++c)
        for (const unsigned v : vertices_of_cell[c])
          around_vertex[v].insert(around_vertex[v].end(), points_of_cell[c].begin(), points_of_cell[c].end());
    neighbors.resize(n);
    const auto join = [&](const std::vector<std::size_t> &points)
    {
      for (const std::size_t i : points)
        for (const std::size_t j : points)
          if (i != j)
            neighbors[i].push_back(j);
    };
    for (const auto &points : points_of_cell)
      join(points);
    for (const auto &[vertex, points] : around_vertex)
      join(points);
    for (auto &of_point : neighbors)
    {
      std::sort(of_point.begin(), of_point.end());
      of_point.erase(std::unique(of_point.begin(), of_point.end()), of_point.end());
    }

    std::vector<bool> touching(n);
    for (std::size_t i = 0; i < n; ++i)
      touching[i] = pressure[i] > 0;
    if (!shared)
      for (const auto &points : points_of_cell)
        if (std::any_of(points.begin(), points.end(), [&](const std::size_t i) { return pressure[i] > 0; }))
          for (const std::size_t i : points)
            touching[i] = true;
    find_pieces(touching);
    find_pieces(with_holes(touching, points_of_cell, vertices_of_cell));
  }

  template <int dim>
  std::vector<bool> ContactPieces<dim>::with_holes(const std::vector<bool>                     &touching,
                                                   const std::vector<std::vector<std::size_t>> &points_of_cell,
                                                   const std::vector<std::vector<unsigned>>    &vertices_of_cell) const
  {
    const unsigned n = points_of_cell.size();
    const auto     touches = [&](const std::size_t i) { return touching[i]; };
    const auto     inside = [&](const std::size_t i) { return touching[i] && depth[i] > 0; };

    std::map<unsigned, std::vector<unsigned>> around_vertex;
    for (unsigned c = 0; c < n; ++c)
      for (const unsigned v : vertices_of_cell[c])
        around_vertex[v].push_back(c);
    // Calls visit(e) for the cells that have a number of vertices in common with cell c: 1, or those of a face.
    const auto for_each_around = [&](const unsigned c, const unsigned n_common, const auto &visit)
    {
      std::map<unsigned, unsigned> common;
      for (const unsigned v : vertices_of_cell[c])
        for (const unsigned e : around_vertex[v])
          if (e != c && ++common[e] == n_common)
            visit(e);
    };

    // In steps of cells from the inside of the pieces.
    constexpr unsigned    far = widest_hole + 1;
    std::vector<unsigned> distance(n, far), queue;
    for (unsigned c = 0; c < n; ++c)
      if (std::any_of(points_of_cell[c].begin(), points_of_cell[c].end(), inside))
      {
        distance[c] = 0;
        queue.push_back(c);
      }
    for (std::size_t k = 0; k < queue.size(); ++k)
      for_each_around(queue[k], 1,
                      [&](const unsigned e)
                      {
                        if (distance[e] == far && distance[queue[k]] + 1 < far)
                        {
                          distance[e] = distance[queue[k]] + 1;
                          queue.push_back(e);
                        }
                      });

    // The regions that cells without pressure form.
    std::vector<bool> outside(n, false), seen(n, false);
    const auto        without_pressure = [&](const unsigned c)
    { return std::none_of(points_of_cell[c].begin(), points_of_cell[c].end(), touches); };
    for (unsigned first = 0; first < n; ++first)
      if (!seen[first] && without_pressure(first))
      {
        std::vector<unsigned> region = {first};
        seen[first] = true;
        bool                  close = true;
        std::set<std::size_t> touched;
        for (std::size_t k = 0; k < region.size(); ++k)
        {
          close = close && distance[region[k]] < far;
          for_each_around(region[k], std::max(dimension, 1u),
                          [&](const unsigned e)
                          {
                            if (!seen[e] && without_pressure(e))
                            {
                              seen[e] = true;
                              region.push_back(e);
                            }
                          });
          for_each_around(region[k], 1,
                          [&](const unsigned e)
                          {
                            for (const std::size_t i : points_of_cell[e])
                              if (touching[i])
                                touched.insert(piece[i]);
                          });
        }
        const auto has_inside = [&](const std::size_t p) { return std::any_of(members[p].begin(), members[p].end(), inside); };
        bool       hole = close ? std::count_if(touched.begin(), touched.end(), has_inside) == 1
                                : touched.size() == 1 && region.size() <= Utilities::pow(widest_hole, int(dimension));
        if (hole)
        {
          std::vector<Point<dim>> hole_points, piece_points;
          for (const unsigned c : region)
            for (const std::size_t i : points_of_cell[c])
              hole_points.push_back(x[i]);
          for (const std::size_t p : touched)
            for (const std::size_t i : members[p])
              piece_points.push_back(x[i]);
          const BoundingBox<dim> around(piece_points);
          hole = std::all_of(hole_points.begin(), hole_points.end(), [&](const auto &y) { return around.point_inside(y, 1e-6); });
        }
        for (const unsigned c : region)
          outside[c] = !hole;
      }

    std::vector<bool> active = touching, beside_outside(n_points(), false), close(n_points(), false);
    for (unsigned c = 0; c < n; ++c)
      for (const std::size_t i : points_of_cell[c])
      {
        beside_outside[i] = beside_outside[i] || outside[c];
        close[i] = close[i] || distance[c] < far;
      }
    for (std::size_t i = 0; i < n_points(); ++i)
      if (!touching[i] && !beside_outside[i])
      {
        std::set<std::size_t> touched;
        for (const std::size_t j : neighbors[i])
          if (touching[j])
            touched.insert(piece[j]);
        active[i] = close[i] || touched.size() == 1;
      }
    return active;
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
