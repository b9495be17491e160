#include "unilateral/mesh/division.h"

#include "unilateral/base/sort_unique.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  std::vector<unsigned> bisect(const std::vector<Point<dim>> &points, const unsigned n_parts, const std::vector<double> &weights)
  {
    std::vector<unsigned>    part(points.size(), 0);
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    // Where the weights from begin on are nearest to this share of all up to end.
    const auto place_of_share = [&](const std::size_t begin, const std::size_t end, const double share)
    {
      double all = 0, sum = 0;
      for (std::size_t k = begin; k < end; ++k)
        all += weights[order[k]];
      std::size_t place = begin;
      for (; place < end && sum + 0.5 * weights[order[place]] < share * all; ++place)
        sum += weights[order[place]];
      return place;
    };
    const std::function<void(std::size_t, std::size_t, unsigned, unsigned)> split =
      [&](const std::size_t begin, const std::size_t end, const unsigned first, const unsigned n)
    {
      if (n == 1)
      {
        for (std::size_t k = begin; k < end; ++k)
          part[order[k]] = first;
        return;
      }
      unsigned longest = 0;
      double   length = -1;
      for (unsigned d = 0; d < dim && begin < end; ++d)
      {
        const auto [low, high] = std::minmax_element(order.begin() + begin, order.begin() + end,
                                                     [&](const auto a, const auto b) { return points[a][d] < points[b][d]; });
        if (const double extent = points[*high][d] - points[*low][d]; extent > length * (1 + 1e-9))
        {
          longest = d;
          length = extent;
        }
      }
      // Equal coordinates differ by rounding: to cut between columns of a grid, not through them, the next coordinate decides there.
      const auto before = [&](const std::size_t a, const std::size_t b)
      {
        for (unsigned k = 0; k < dim; ++k)
        {
          const unsigned d = (longest + k) % dim;
          if (std::abs(points[a][d] - points[b][d]) > 1e-9 * length)
            return points[a][d] < points[b][d];
        }
        return a < b;
      };
      std::sort(order.begin() + begin, order.begin() + end, before);
      const unsigned    n_lower = n / 2;
      const std::size_t middle = weights.empty() ? begin + (end - begin) * n_lower / n : place_of_share(begin, end, double(n_lower) / n);
      split(begin, middle, first, n_lower);
      split(middle, end, first + n_lower, n - n_lower);
    };
    split(0, points.size(), 0, n_parts);
    return part;
  }

  template <int dim>
  std::vector<std::vector<unsigned>> find_cells_at_vertices(const Triangulation<dim> &whole, const int base_level)
  {
    std::vector<std::vector<unsigned>> cells_at_vertex(whole.n_vertices());
    unsigned                           n = 0;
    for (const auto &cell : whole.cell_iterators_on_level(base_level))
    {
      for (const unsigned v : cell->vertex_indices())
        cells_at_vertex[cell->vertex_index(v)].push_back(n);
      ++n;
    }
    return cells_at_vertex;
  }

  namespace
  {
    /// What cuts cost, and the weight of the largest part.
    struct CostOfCuts
    {
      double along_cuts = 0;
      double largest_part = 0;
    };

    /// Along cuts processes have vertices besides the first one each: of a cell that becomes n, n^((dim-1)/dim) for each of its own. Where
    /// nodes hang, a cell becomes as many as the one across the cut (flag_alike_at_cuts()); a face has 2^(dim-1) vertices.
    template <int dim>
    CostOfCuts cost_of_cuts(const std::vector<std::vector<unsigned>> &cells_at_vertex,
                            const std::vector<unsigned>              &owner,
                            const std::vector<double>                &weights,
                            const unsigned                            n_parts,
                            const bool                                nodes_may_hang)
    {
      CostOfCuts            cost;
      std::vector<unsigned> owners;
      for (const auto &cells : cells_at_vertex)
      {
        owners.clear();
        for (const unsigned cell : cells)
          owners.push_back(owner[cell]);
        sort_unique(owners);
        if (owners.size() < 2)
          continue;
        const auto [least, most] =
          std::minmax_element(cells.begin(), cells.end(), [&](const unsigned a, const unsigned b) { return weights[a] < weights[b]; });
        cost.along_cuts += double(owners.size() - 1) * std::pow(weights[*most], double(dim - 1) / dim);
        if (nodes_may_hang)
          cost.along_cuts += (weights[*most] - weights[*least]) / (1u << (dim - 1));
      }
      std::vector<double> of_part(n_parts, 0.);
      for (std::size_t cell = 0; cell < owner.size(); ++cell)
        cost.largest_part = std::max(cost.largest_part, of_part[owner[cell]] += weights[cell]);
      return cost;
    }

    /// By METIS, which cuts as few faces as it can; the same on every process.
    template <int dim>
    std::vector<unsigned>
    cut_graph(const Triangulation<dim> &whole, const int base_level, const std::vector<double> &weights, const unsigned n_parts)
    {
      const std::size_t     n_cells = weights.size();
      std::vector<unsigned> owner(n_cells, 0), whole_weights;
      if (n_parts == 1)
        return owner;
      std::vector<unsigned> number(whole.n_raw_cells(base_level));
      unsigned              n = 0;
      for (const auto &cell : whole.cell_iterators_on_level(base_level))
        number[cell->index()] = n++;
      DynamicSparsityPattern neighbors(n_cells, n_cells);
      for (const auto &cell : whole.cell_iterators_on_level(base_level))
      {
        neighbors.add(number[cell->index()], number[cell->index()]);
        for (const auto face : cell->face_indices())
          if (!cell->at_boundary(face))
            neighbors.add(number[cell->index()], number[cell->neighbor_index(face)]);
      }
      SparsityPattern graph;
      graph.copy_from(neighbors);
      // METIS adds up 32-bit numbers.
      const double sum = std::accumulate(weights.begin(), weights.end(), 0.), scale = std::min(1., 5e8 / sum);
      for (const double weight : weights)
        whole_weights.push_back(std::lround(std::max(scale * weight, 1.)));
      SparsityTools::partition(graph, whole_weights, n_parts, owner, SparsityTools::Partitioner::metis);
      return owner;
    }

    /// METIS takes parts that are larger than the mean by this part of it.
    constexpr double largest_imbalance = 0.05;

    template <int dim>
    double weight_of(const typename Triangulation<dim>::cell_iterator &cell, const std::vector<double> &weights)
    {
      if (cell->is_active())
        return weights.empty() ? 1 : weights[cell->active_cell_index()];
      double sum = 0;
      for (unsigned c = 0; c < cell->n_children(); ++c)
        sum += weight_of<dim>(cell->child(c), weights);
      return sum;
    }
  } // namespace

  namespace
  {
    /// The base cells that have to stay together, one list for those of tied parts that have a cell in common.
    template <int dim>
    std::vector<std::vector<unsigned>>
    clusters_at(const Triangulation<dim> &whole, const int base_level, const std::vector<TiedParts> &tied)
    {
      std::vector<std::vector<unsigned>> clusters;
      for (const TiedParts &parts : tied)
      {
        std::vector<bool> on_parts(whole.n_vertices(), false);
        for (const auto &cell : whole.cell_iterators_on_level(base_level))
          for (const auto face : cell->face_indices())
            if (cell->at_boundary(face) && std::find(parts.begin(), parts.end(), cell->face(face)->boundary_id()) != parts.end())
              for (const unsigned v : cell->face(face)->vertex_indices())
                on_parts[cell->face(face)->vertex_index(v)] = true;
        std::vector<unsigned> cluster;
        unsigned              number = 0;
        for (const auto &cell : whole.cell_iterators_on_level(base_level))
        {
          const auto vertices = cell->vertex_indices();
          if (std::any_of(vertices.begin(), vertices.end(), [&](const unsigned v) { return on_parts[cell->vertex_index(v)]; }))
            cluster.push_back(number);
          ++number;
        }
        for (auto other = clusters.begin(); other != clusters.end();)
        {
          std::vector<unsigned> common;
          std::set_intersection(cluster.begin(), cluster.end(), other->begin(), other->end(), std::back_inserter(common));
          if (common.empty())
          {
            ++other;
            continue;
          }
          cluster.insert(cluster.end(), other->begin(), other->end());
          sort_unique(cluster);
          other = clusters.erase(other);
        }
        clusters.push_back(std::move(cluster));
      }
      return clusters;
    }

    /// The part with most of the weight of a cluster, and the centre of what it has of it.
    template <int dim>
    std::pair<unsigned, Point<dim>> where_most_is(const std::vector<unsigned>   &cluster,
                                                  const std::vector<unsigned>   &owner,
                                                  const std::vector<Point<dim>> &centers,
                                                  const std::vector<double>     &weights)
    {
      std::map<unsigned, std::pair<double, Point<dim>>> of_part;
      for (const unsigned cell : cluster)
      {
        auto &[weight, center] = of_part[owner[cell]];
        weight += weights[cell];
        center += weights[cell] * centers[cell];
      }
      const auto most =
        std::max_element(of_part.begin(), of_part.end(), [](const auto &a, const auto &b) { return a.second.first < b.second.first; });
      return {most->first, most->second.second / most->second.first};
    }

    /// Bisection in which each of @p clusters is one point, first placed where an ordinary bisection has most of it.
    template <int dim>
    std::vector<unsigned> bisect_around(const std::vector<std::vector<unsigned>> &clusters,
                                        const std::vector<Point<dim>>            &centers,
                                        const std::vector<double>                &weights,
                                        const unsigned                            n_parts)
    {
      const auto              first = bisect(centers, n_parts, weights);
      std::vector<Point<dim>> points;
      std::vector<double>     weight_of_point;
      std::vector<unsigned>   point_of_cell(centers.size(), numbers::invalid_unsigned_int);
      for (const auto &cluster : clusters)
        if (!cluster.empty())
        {
          double sum = 0;
          for (const unsigned cell : cluster)
          {
            point_of_cell[cell] = points.size();
            sum += weights[cell];
          }
          points.push_back(where_most_is(cluster, first, centers, weights).second);
          weight_of_point.push_back(sum);
        }
      for (unsigned cell = 0; cell < centers.size(); ++cell)
        if (point_of_cell[cell] == numbers::invalid_unsigned_int)
        {
          point_of_cell[cell] = points.size();
          points.push_back(centers[cell]);
          weight_of_point.push_back(weights[cell]);
        }
      const auto            part_of_point = bisect(points, n_parts, weight_of_point);
      std::vector<unsigned> owner(centers.size());
      for (unsigned cell = 0; cell < centers.size(); ++cell)
        owner[cell] = part_of_point[point_of_cell[cell]];
      return owner;
    }
  } // namespace

  double largest_over_mean(const double own, const Processes &processes)
  {
    const double sum = processes.sum(own);
    return sum > 0 ? processes.max(own) * processes.size() / sum : 1;
  }

  namespace
  {
    bool all_have_cells(const std::vector<unsigned> &owner, const unsigned n_parts)
    {
      std::vector<bool> has_any(n_parts, false);
      for (const unsigned part : owner)
        has_any[part] = true;
      return std::find(has_any.begin(), has_any.end(), false) == has_any.end();
    }

    /// As the graph is cut where that costs less along the cuts, else by bisection, whose straight cuts are the shortest through the grid
    /// of a box and do not follow the border of what is refined.
    template <int dim>
    Division divide_by_weight(const Triangulation<dim>     &whole,
                              const unsigned                n_parts,
                              const std::vector<double>    &weights,
                              const std::vector<TiedParts> &tied)
    {
      Division division;
      division.base_level = whole.n_levels() - 1;
      for (const auto &cell : whole.active_cell_iterators())
        division.base_level = std::min(division.base_level, cell->level());
      std::vector<Point<dim>> centers;
      std::vector<double>     weight_of_cell;
      for (const auto &cell : whole.cell_iterators_on_level(division.base_level))
      {
        centers.push_back(cell->center());
        weight_of_cell.push_back(weight_of<dim>(cell, weights));
      }
      if (!tied.empty())
      {
        division.owner = bisect_around(clusters_at(whole, division.base_level, tied), centers, weight_of_cell, n_parts);
        return division;
      }
      const bool alike = weights.empty() && centers.size() == whole.n_active_cells();
      division.owner = bisect(centers, n_parts, alike ? std::vector<double>() : weight_of_cell);
      auto             by_graph = cut_graph(whole, division.base_level, weight_of_cell, n_parts);
      const auto       cells_at_vertex = find_cells_at_vertices(whole, division.base_level);
      const bool       nodes_may_hang = whole.all_reference_cells_are_hyper_cube();
      const CostOfCuts of_bisection = cost_of_cuts<dim>(cells_at_vertex, division.owner, weight_of_cell, n_parts, nodes_may_hang),
                       of_graph = cost_of_cuts<dim>(cells_at_vertex, by_graph, weight_of_cell, n_parts, nodes_may_hang);
      const double mean = std::accumulate(weight_of_cell.begin(), weight_of_cell.end(), 0.) / n_parts;
      if (of_graph.along_cuts < of_bisection.along_cuts &&
          of_graph.largest_part <= std::max((1 + largest_imbalance) * mean + 1, of_bisection.largest_part))
        division.owner = std::move(by_graph);
      return division;
    }
  } // namespace

  template <int dim>
  Division
  divide(const Triangulation<dim> &whole, const unsigned n_parts, const std::vector<double> &weights, const std::vector<TiedParts> &tied)
  {
    // A single cell may weigh more than all others.
    if (Division division = divide_by_weight(whole, n_parts, weights, tied); weights.empty() || all_have_cells(division.owner, n_parts))
      return division;
    return divide_by_weight(whole, n_parts, {}, tied);
  }

#define INSTANTIATE(dim)                                                                                                                    \
  template Division              divide(const Triangulation<dim> &, unsigned, const std::vector<double> &, const std::vector<TiedParts> &); \
  template std::vector<unsigned> bisect(const std::vector<Point<dim>> &, unsigned, const std::vector<double> &);                            \
  template std::vector<std::vector<unsigned>> find_cells_at_vertices(const Triangulation<dim> &, int);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
