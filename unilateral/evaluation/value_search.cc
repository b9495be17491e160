#include "unilateral/evaluation/value_search.h"

#include "unilateral/base/diagnostics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    Point<dim> middle_of(const std::vector<Point<dim>> &vertices)
    {
      Point<dim> middle;
      for (const Point<dim> &x : vertices)
        middle += x / double(vertices.size());
      return middle;
    }

    /// At the middle of the longest edge.
    template <int dim>
    std::array<std::vector<Point<dim>>, 2> halves_of_simplex(const std::vector<Point<dim>> &vertices)
    {
      unsigned a = 0, b = 1;
      for (unsigned i = 0; i < vertices.size(); ++i)
        for (unsigned j = i + 1; j < vertices.size(); ++j)
          if (vertices[i].distance_square(vertices[j]) > vertices[a].distance_square(vertices[b]))
          {
            a = i;
            b = j;
          }
      const Point<dim>                       middle = middle_of<dim>({vertices[a], vertices[b]});
      std::array<std::vector<Point<dim>>, 2> halves = {vertices, vertices};
      halves[0][b] = middle;
      halves[1][a] = middle;
      return halves;
    }

    /// Across the longest direction.
    template <int dim>
    std::array<std::vector<Point<dim>>, 2> halves_of_hypercube(const std::vector<Point<dim>> &vertices)
    {
      unsigned direction = 0;
      double   longest = -1;
      for (unsigned d = 0; 1u << d < vertices.size(); ++d)
        if (const double length = vertices[0].distance_square(vertices[1u << d]); length > longest)
        {
          longest = length;
          direction = d;
        }
      std::array<std::vector<Point<dim>>, 2> halves = {vertices, vertices};
      for (unsigned v = 0; v < vertices.size(); ++v)
      {
        const unsigned lower = v & ~(1u << direction), upper = v | 1u << direction;
        halves[v & 1u << direction ? 0 : 1][v] = middle_of<dim>({vertices[lower], vertices[upper]});
      }
      return halves;
    }

    template <int dim>
    class ValueSearch
    {
    public:
      using Found = std::optional<std::pair<Point<dim>, double>>;

      ValueSearch(const Interval &known, const FieldFunction &function, const bool simplex)
        : known(known), function(function), simplex(simplex)
      {
      }

      Found look_at(const std::vector<Point<dim>> &part, const unsigned n_halvings = 0)
      {
        if (n_steps++ >= most_steps || range_on(function, part)->inside(known))
          return {};
        const Point<dim> middle = middle_of(part);
        if (const auto value = value_if_any(function, middle); value && !known.contains(*value))
          return Found({middle, *value});
        if (n_halvings == most_halvings)
          return {};
        for (const auto &half : halves_of(part, simplex))
          if (const Found found = look_at(half, n_halvings + 1))
            return found;
        return {};
      }

    private:
      static constexpr unsigned most_steps = 400, most_halvings = dim == 3 ? 15 : 8 * dim;

      const Interval      &known;
      const FieldFunction &function;
      const bool           simplex;
      unsigned             n_steps = 0;
    };
  } // namespace

  template <int dim>
  std::array<std::vector<Point<dim>>, 2> halves_of(const std::vector<Point<dim>> &vertices, const bool simplex)
  {
    return simplex ? halves_of_simplex(vertices) : halves_of_hypercube(vertices);
  }

  template <int dim>
  std::optional<double> value_if_any(const FieldFunction &function, const Point<dim> &x)
  {
    try
    {
      return function.value(x);
    }
    catch (const InputError &)
    {
      return {};
    }
  }

  template <int dim>
  std::optional<Interval> range_on(const FieldFunction &function, const std::vector<Point<dim>> &vertices)
  {
    std::array<Interval, 3> box{};
    for (unsigned d = 0; d < dim; ++d)
    {
      box[d] = Interval::of(vertices[0][d]);
      for (const Point<dim> &x : vertices)
        box[d] = hull(box[d], Interval::of(x[d]));
    }
    return function.range(box);
  }

  template <int dim>
  std::optional<std::pair<Point<dim>, double>>
  find_value_outside(const Interval &known, const FieldFunction &function, const std::vector<Point<dim>> &vertices, const bool simplex)
  {
    return ValueSearch<dim>(known, function, simplex).look_at(vertices);
  }

  template <int dim>
  double
  mean_square_outside(const Interval &known, const FieldFunction &function, const std::vector<Point<dim>> &vertices, const bool simplex)
  {
    struct Part
    {
      double                  most; ///< of the whole mean it may be
      std::vector<Point<dim>> vertices;
      double                  share; ///< of the cell
      bool                    operator<(const Part &other) const { return most < other.most; }
    };
    std::priority_queue<Part> parts;
    const auto                add = [&](std::vector<Point<dim>> corners, const double share)
    {
      const auto range = range_on(function, corners).value();
      if (range.empty() || range.inside(known))
        return;
      double distance = std::max({known.least - range.least, range.most - known.most, 0.});
      if (!std::isfinite(distance)) // a pole
        distance = 2 * std::abs(value_if_any(function, middle_of(corners)).value_or(0));
      parts.push({distance * distance * share, std::move(corners), share});
    };
    add(vertices, 1);
    for (unsigned step = 0; step < 400 && !parts.empty(); ++step)
    {
      const Part part = parts.top();
      parts.pop();
      for (auto &half : halves_of(part.vertices, simplex))
        add(std::move(half), part.share / 2);
    }
    double sum = 0;
    for (; !parts.empty(); parts.pop())
      sum += parts.top().most;
    return sum;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::array<std::vector<Point<dim>>, 2>       halves_of(const std::vector<Point<dim>> &, bool);                                  \
  template std::optional<double>                        value_if_any(const FieldFunction &, const Point<dim> &);                           \
  template std::optional<Interval>                      range_on(const FieldFunction &, const std::vector<Point<dim>> &);                  \
  template std::optional<std::pair<Point<dim>, double>> find_value_outside(const Interval &, const FieldFunction &,                        \
                                                                           const std::vector<Point<dim>> &, bool);                         \
  template double mean_square_outside(const Interval &, const FieldFunction &, const std::vector<Point<dim>> &, bool);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
