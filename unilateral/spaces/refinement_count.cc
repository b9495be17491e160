#include "unilateral/spaces/refinement_count.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Each takes a microsecond or two.
    constexpr std::size_t most_looks = 1000000;

    template <int dim>
    bool is_simplex(const std::vector<Point<dim>> &corners)
    {
      return dim > 1 && corners.size() == dim + 1;
    }

    template <int dim>
    Point<dim> mean(const std::vector<Point<dim>> &points)
    {
      Point<dim> sum;
      for (const Point<dim> &x : points)
        sum += x / double(points.size());
      return sum;
    }

    /// The corners of the children, each generation in halves.
    template <int dim>
    std::vector<std::vector<Point<dim>>> children(const std::vector<Point<dim>> &corners)
    {
      std::vector<std::vector<Point<dim>>> result;
      const auto                           middle = [&](const unsigned a, const unsigned b) { return mean<dim>({corners[a], corners[b]}); };
      if (is_simplex<dim>(corners))
      {
        for (unsigned corner = 0; corner <= dim; ++corner)
        {
          auto &child = result.emplace_back();
          for (unsigned other = 0; other <= dim; ++other)
            child.push_back(middle(corner, other)); // itself where they are the same
        }
        if (dim == 2)
          result.push_back({middle(0, 1), middle(1, 2), middle(2, 0)});
        if constexpr (dim == 3) // an octahedron is left, cut along the line between the middles of two opposite edges
        {
          const std::array<Point<3>, 4> around = {middle(0, 1), middle(1, 2), middle(2, 3), middle(3, 0)};
          for (unsigned k = 0; k < 4; ++k)
            result.push_back({middle(0, 2), middle(1, 3), around[k], around[(k + 1) % 4]});
        }
        return result;
      }
      // Of the grid of 3^dim points, the corner with the bits `v` of child `c` is at c_d + v_d in each direction d.
      for (unsigned c = 0; c < corners.size(); ++c)
      {
        auto &child = result.emplace_back();
        for (unsigned v = 0; v < corners.size(); ++v)
        {
          std::vector<Point<dim>> around;
          for (unsigned k = 0; k < corners.size(); ++k)
            if (((k ^ c) & ~(c ^ v)) == 0) // where c_d and v_d agree the corner of the cell is meant, else both
              around.push_back(corners[k]);
          child.push_back(mean<dim>(around));
        }
      }
      return result;
    }
  } // namespace

  template <int dim>
  RefinementCount<dim>::RefinementCount(std::vector<FieldFunction> places, const unsigned n_everywhere)
    : places(std::move(places)), n_everywhere(n_everywhere)
  {
  }

  template <int dim>
  double RefinementCount<dim>::operator()(const typename Triangulation<dim>::cell_iterator &cell)
  {
    Corners corners;
    for (const unsigned v : cell->vertex_indices())
      corners.push_back(cell->vertex(v));
    return count(corners, 0) / std::pow(n_children, n_everywhere);
  }

  /// How many of @p points place k takes.
  template <int dim>
  std::size_t RefinementCount<dim>::n_taken(const std::size_t k, const Corners &points)
  {
    places[k].values(points, values);
    return std::count_if(values.begin(), values.end(), [](const double value) { return value != 0; });
  }

  /// @p round: of the refinements, those of the whole mesh first.
  template <int dim>
  double RefinementCount<dim>::count(const Corners &corners, unsigned round)
  {
    const auto n_rounds = unsigned(n_everywhere + places.size());
    Corners    points(corners);
    points.push_back(mean<dim>(corners));
    ++n_looks;
    while (round < n_rounds && round >= n_everywhere && n_taken(round - n_everywhere, points) == 0)
      ++round;
    if (round == n_rounds)
      return 1;
    const unsigned first_place = std::max(round, n_everywhere) - n_everywhere;
    bool           whole = true; // every place takes all of the cell, as far as this shows
    double         product = std::pow(n_children, n_everywhere + first_place - round);
    for (std::size_t k = first_place; k < places.size() && (whole || n_looks >= most_looks); ++k)
    {
      const std::size_t n = n_taken(k, points);
      whole = whole && n == points.size();
      product *= n > 0 ? n_children : 1;
    }
    if (whole || n_looks >= most_looks)
      return product;
    double sum = 0;
    for (const Corners &child : children(corners))
      sum += count(child, round + 1);
    return sum;
  }

  template class RefinementCount<1>;
  template class RefinementCount<2>;
  template class RefinementCount<3>;
} // namespace unilateral
