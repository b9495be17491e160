#include "unilateral/functions/stl_surface.h"

// The kernel of double numbers never computes with exact ones, so GMP and MPFR need not be linked.
#define CGAL_DISABLE_GMP 1
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

namespace unilateral
{
  namespace
  {
    using Kernel = CGAL::Simple_cartesian<double>;
    using Triangles = std::vector<Kernel::Triangle_3>;
    using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
    using BoxTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

    constexpr double infinity = std::numeric_limits<double>::infinity();

    /// A point seen along the line: its place across, where the line is the origin, and its height along.
    struct Seen
    {
      double x, y, height;
    };

    /// The line x + t d. Points are moved along d into the plane through x across the axis nearest to d, which takes two products and
    /// keeps points apart that differ in one coordinate only.
    class Line
    {
    public:
      Line(const std::array<double, 3> &x, const std::array<double, 3> &d) : origin(x)
      {
        for (unsigned i = 1; i < 3; ++i)
          if (std::abs(d[i]) > std::abs(d[axis]))
            axis = i;
        first = (axis + 1) % 3;
        second = (axis + 2) % 3;
        rate = d[axis];
        first_slope = d[first] / rate;
        second_slope = d[second] / rate;
      }

      /// Depends on nothing but the point and the line: triangles that share a vertex see it in the same place.
      Seen see(const Kernel::Point_3 &p) const
      {
        const double height = p[axis] - origin[axis];
        return {p[first] - origin[first] - first_slope * height, p[second] - origin[second] - second_slope * height, height};
      }

      double t(const double height) const { return height / rate; }

      /// Facets that are seen counter-clockwise (+1) or clockwise (-1) are entered or left.
      bool enters(const int orientation) const { return (rate > 0) == (orientation < 0); }

      /// Whether the line comes within @p reach of @p box; may say yes for one that is a little further.
      bool meets(const CGAL::Bbox_3 &box, double reach) const
      {
        reach += 1e-12 * std::max({std::abs(origin[0]), std::abs(origin[1]), std::abs(origin[2])});
        double low = box.min(axis) - reach - origin[axis], high = box.max(axis) + reach - origin[axis];
        for (const auto &[i, slope] : {std::pair(first, first_slope), std::pair(second, second_slope)})
        {
          const double lower = box.min(i) - reach - origin[i], upper = box.max(i) + reach - origin[i];
          if (slope == 0)
          {
            if (lower > 0 || upper < 0)
              return false;
            continue;
          }
          low = std::max(low, std::min(lower / slope, upper / slope));
          high = std::min(high, std::max(lower / slope, upper / slope));
        }
        return low <= high;
      }

    private:
      std::array<double, 3> origin;
      int                   axis = 0, first = 0, second = 0;
      double                rate = 0, first_slope = 0, second_slope = 0;
    };

    /// Twice the area of a triangle as it is seen: positive counter-clockwise.
    double seen_area(const std::array<Seen, 3> &v)
    {
      return (v[1].x - v[0].x) * (v[2].y - v[0].y) - (v[1].y - v[0].y) * (v[2].x - v[0].x);
    }

    int sign(const double x)
    {
      return (x > 0) - (x < 0);
    }

    /// Twice the area of the triangle 0, a, b.
    double area(const Seen &a, const Seen &b)
    {
      return a.x * b.y - a.y * b.x;
    }

    /// On which side of the edge from @p a to @p b the line lies, +1 left, -1 right, exactly; on the edge itself, that of the point
    /// (e, e^2) with an infinitesimal e > 0. 0 only for a = b. Changes its sign with the order of a and b.
    int side(const Seen &a, const Seen &b)
    {
      const double left = a.x * b.y, right = a.y * b.x;
      if (left != right)
        return left > right ? 1 : -1; // rounding keeps order
      const double left_rest = std::fma(a.x, b.y, -left), right_rest = std::fma(a.y, b.x, -right);
      if (left_rest != right_rest)
        return left_rest > right_rest ? 1 : -1;
      if (a.y != b.y)
        return a.y > b.y ? 1 : -1;
      return (b.x > a.x) - (b.x < a.x);
    }

    /// Where the line passes through a facet.
    struct Crossing
    {
      double t;
      bool   entering;
      bool   at_rim; ///< beyond the facet, but within reach of an edge where the surface ends as the line sees it
    };

    /// Edge i of a triangle runs from vertex i to i + 1; here which other triangle has it, `none`, or `several`.
    using Neighbors = std::array<std::uint32_t, 3>;
    constexpr std::uint32_t none = -1, several = -2;

    std::array<Seen, 3> see(const Line &line, const Kernel::Triangle_3 &triangle)
    {
      return {line.see(triangle[0]), line.see(triangle[1]), line.see(triangle[2])};
    }

    std::optional<Crossing> cross(
      const Line &line, const Triangles &triangles, const std::size_t number, const std::vector<Neighbors> &neighbors, const double reach)
    {
      const std::array<Seen, 3> v = see(line, triangles[number]);
      std::array<int, 3>        sides;
      for (unsigned i = 0; i < 3; ++i)
        sides[i] = side(v[i], v[(i + 1) % 3]);

      int  orientation = sides[0];
      bool at_rim = false;
      if (sides[0] == 0 || sides[0] != sides[1] || sides[1] != sides[2])
      {
        at_rim = true;
        orientation = sign(seen_area(v));
        if (orientation == 0)
          return {};
        // Of a closed body the surface ends where the next facet is seen from its side or from behind, as the top of a box does.
        const auto ends_at = [&](const unsigned edge)
        {
          const std::uint32_t next = neighbors[number][edge];
          return next == none || (next != several && sign(seen_area(see(line, triangles[next]))) != orientation);
        };
        for (unsigned i = 0; i < 3; ++i)
        {
          const Seen &a = v[i], &b = v[(i + 1) % 3];
          if (sides[i] != orientation && !(orientation * area(a, b) >= -reach * std::hypot(b.x - a.x, b.y - a.y) && ends_at(i)))
            return {};
        }
      }

      // The place is the mean of the vertices, weighted with the areas opposite to them; beyond an edge, one on it.
      std::array<double, 3> weights;
      for (unsigned i = 0; i < 3; ++i)
        weights[(i + 2) % 3] = std::max(orientation * area(v[i], v[(i + 1) % 3]), 0.);
      const double sum = weights[0] + weights[1] + weights[2];
      if (!(sum > 0))
        weights.fill(1); // a facet seen from its side: the areas may all vanish by rounding
      Seen place = {0, 0, 0};
      for (unsigned i = 0; i < 3; ++i)
      {
        const double weight = weights[i] / (sum > 0 ? sum : 3);
        place.x += weight * v[i].x;
        place.y += weight * v[i].y;
        place.height += weight * v[i].height;
      }
      // What is close to the edges of an acute corner may be far from the corner.
      if (at_rim && std::hypot(place.x, place.y) > 2 * reach)
        return {};
      return Crossing{line.t(place.height), line.enters(orientation), at_rim};
    }

    /// By coordinates: STL has no connectivity.
    std::vector<Neighbors> find_neighbors(const Triangles &triangles)
    {
      const auto less = [](const Kernel::Point_3 &a, const Kernel::Point_3 &b)
      { return std::pair(a.x(), std::pair(a.y(), a.z())) < std::pair(b.x(), std::pair(b.y(), b.z())); };
      std::vector<Kernel::Point_3> points;
      points.reserve(3 * triangles.size());
      for (const auto &triangle : triangles)
        for (int i = 0; i < 3; ++i)
          points.push_back(triangle[i]);
      std::sort(points.begin(), points.end(), less);
      points.erase(std::unique(points.begin(), points.end()), points.end());

      using Edge = std::pair<std::uint32_t, std::uint32_t>;
      std::vector<Edge> edges;
      edges.reserve(3 * triangles.size());
      for (const auto &triangle : triangles)
      {
        std::array<std::uint32_t, 3> number;
        for (int i = 0; i < 3; ++i)
          number[i] = static_cast<std::uint32_t>(std::lower_bound(points.begin(), points.end(), triangle[i], less) - points.begin());
        for (unsigned i = 0; i < 3; ++i)
          edges.push_back(std::minmax({number[i], number[(i + 1) % 3]}));
      }
      std::vector<std::uint32_t> order(edges.size());
      std::iota(order.begin(), order.end(), 0u);
      std::sort(order.begin(), order.end(), [&](const auto a, const auto b) { return std::pair(edges[a], a) < std::pair(edges[b], b); });

      std::vector<Neighbors> neighbors(triangles.size());
      for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end)
      {
        while (end < order.size() && edges[order[end]] == edges[order[begin]])
          ++end;
        for (std::size_t k = begin; k < end; ++k)
          neighbors[order[k] / 3][order[k] % 3] = end - begin == 1 ? none : end - begin > 2 ? several : order[begin + end - 1 - k] / 3;
      }
      return neighbors;
    }

    class StlSurface : public RigidSurface
    {
    public:
      explicit StlSurface(Triangles facets) : triangles(std::move(facets)), neighbors(find_neighbors(triangles))
      {
        boxes.insert(triangles.begin(), triangles.end());
        boxes.build();
        const CGAL::Bbox_3 box = boxes.bbox();
        double             largest = 0;
        for (int i = 0; i < 3; ++i)
          largest = std::max({largest, std::abs(box.min(i)), std::abs(box.max(i))});
        const double diagonal = std::hypot(box.x_span(), box.y_span(), box.z_span());
        reach = 1e-6 * diagonal;
        tolerance = 1e-12 * std::max(diagonal, largest);
      }

      std::optional<double> distance(const std::array<double, 3> &x, const std::array<double, 3> &d) const override
      {
        // The nearest ahead and behind, entered and left. Who stands on a facet is about to enter it, or has left it.
        double enter_ahead = infinity, leave_ahead = infinity, enter_behind = -infinity, leave_behind = -infinity;
        for (const Crossing &crossing : crossings(Line(x, d)))
          if (crossing.entering && crossing.t >= -tolerance)
            enter_ahead = std::min(enter_ahead, crossing.t);
          else if (crossing.entering)
            enter_behind = std::max(enter_behind, crossing.t);
          else if (crossing.t > tolerance)
            leave_ahead = std::min(leave_ahead, crossing.t);
          else
            leave_behind = std::max(leave_behind, crossing.t);

        const auto known = [](const double t) { return std::isfinite(t) ? std::optional(t) : std::nullopt; };
        if (enter_ahead < leave_ahead - tolerance)
          return enter_ahead;
        if (leave_ahead < infinity)
        {
          // Where bodies touch, one is left and the next entered at the same place, and x lies in the first; where nothing was entered
          // before, it is a sheet with two sides.
          if (enter_behind > -infinity || enter_ahead > leave_ahead + tolerance)
            return known(enter_behind);
          return enter_ahead;
        }
        return known(enter_behind > leave_behind + tolerance ? enter_behind : -infinity);
      }

    private:
      /// All crossings of @p line, ahead and behind, in no order.
      std::vector<Crossing> crossings(const Line &line) const
      {
        Visit visit{*this, {}};
        boxes.traversal(line, visit);
        std::vector<Crossing> &found = visit.crossings;
        // A line that brushes past an edge from outside comes within reach of a facet to enter and of one to leave: it misses both.
        const auto brushes_past = [&](const Crossing &one)
        {
          return one.at_rim &&
                 std::any_of(visit.crossings.begin(), visit.crossings.end(),
                             [&](const Crossing &other)
                             { return other.at_rim && other.entering != one.entering && std::abs(other.t - one.t) <= 100 * reach; });
        };
        std::vector<Crossing> kept;
        std::remove_copy_if(found.begin(), found.end(), std::back_inserter(kept), brushes_past);
        return kept;
      }

      /// What the tree calls on its way down.
      struct Visit
      {
        const StlSurface     &surface;
        std::vector<Crossing> crossings;

        static bool go_further() { return true; }

        template <typename Node>
        bool do_intersect(const Line &line, const Node &node) const
        {
          return line.meets(node.bbox(), 2 * surface.reach);
        }

        void intersection(const Line &line, const Primitive &primitive)
        {
          const auto triangle = primitive.id();
          if (const auto crossing = cross(line, surface.triangles, triangle - surface.triangles.begin(), surface.neighbors, surface.reach))
            crossings.push_back(*crossing);
        }
      };

      const Triangles              triangles;
      const std::vector<Neighbors> neighbors;
      BoxTree                      boxes;
      double                       reach = 0;     ///< beyond edges where the surface ends
      double                       tolerance = 0; ///< for what is meant to be the same place on a line
    };

    Kernel::Point_3 point(const std::array<double, 3> &p)
    {
      return {p[0], p[1], p[2]};
    }

    bool has_area(const Kernel::Triangle_3 &triangle)
    {
      const Kernel::Vector_3 a = triangle[1] - triangle[0], b = triangle[2] - triangle[0], c = b - a;
      return std::sqrt(CGAL::cross_product(a, b).squared_length()) >
             1e-14 * std::max({a.squared_length(), b.squared_length(), c.squared_length()});
    }
  } // namespace

  std::shared_ptr<const RigidSurface> make_stl_surface(const std::vector<StlTriangle> &triangles)
  {
    Triangles facets;
    facets.reserve(triangles.size());
    for (const StlTriangle &t : triangles)
      if (const Kernel::Triangle_3 facet(point(t[0]), point(t[1]), point(t[2])); has_area(facet))
        facets.push_back(facet);
    return facets.empty() ? nullptr : std::make_shared<StlSurface>(std::move(facets));
  }
} // namespace unilateral
