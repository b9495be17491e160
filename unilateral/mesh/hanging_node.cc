#include "unilateral/mesh/hanging_node.h"

#include "unilateral/base/sort_unique.h"
#include "unilateral/mesh/box_tree.h"

#include <algorithm>

namespace unilateral
{
  using dealii::Point;

  std::span<const unsigned> vertices_of(const VerticesOfFace &face)
  {
    return {face.begin(), std::find(face.begin(), face.end(), no_number)};
  }

  template <int dim>
  std::optional<Point<dim>> hanging_node(const std::vector<VerticesOfFace> &boundary, const std::vector<Point<dim>> &points)
  {
    if (dim == 1)
      return std::nullopt;
    double                size = 0;
    std::vector<unsigned> vertices;
    for (const auto &face : boundary)
    {
      const auto of_face = vertices_of(face);
      size = std::max(size, points[of_face.front()].distance(points[of_face.back()]));
      vertices.insert(vertices.end(), of_face.begin(), of_face.end());
    }
    sort_unique(vertices);
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
            return middle;
        }
    return std::nullopt;
  }

  template std::optional<Point<1>> hanging_node(const std::vector<VerticesOfFace> &, const std::vector<Point<1>> &);
  template std::optional<Point<2>> hanging_node(const std::vector<VerticesOfFace> &, const std::vector<Point<2>> &);
  template std::optional<Point<3>> hanging_node(const std::vector<VerticesOfFace> &, const std::vector<Point<3>> &);
} // namespace unilateral
