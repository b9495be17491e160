#include "unilateral/report/feature_edges.h"

#include "unilateral/report/triangle_normal.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace unilateral
{
  namespace
  {
    struct EdgeOfTriangle
    {
      std::array<std::uint32_t, 2> ends;
      std::size_t                  triangle;
    };

    std::array<double, 3> normal_of(const std::vector<std::array<float, 3>> &points, const std::array<std::uint32_t, 3> &triangle)
    {
      std::array<std::array<double, 3>, 3> corners{};
      for (unsigned k = 0; k < 3; ++k)
        std::copy(points[triangle[k]].begin(), points[triangle[k]].end(), corners[k].begin());
      return unit_normal(corners);
    }
  } // namespace

  std::vector<std::array<std::uint32_t, 2>> feature_edges(const std::vector<std::array<float, 3>>         &points,
                                                          const std::vector<std::array<std::uint32_t, 3>> &triangles)
  {
    const double                cosine = 0.82; // of 35 degrees
    std::vector<EdgeOfTriangle> edges;
    edges.reserve(3 * triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (unsigned k = 0; k < 3; ++k)
      {
        const std::uint32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];
        edges.push_back({{std::min(a, b), std::max(a, b)}, t});
      }
    std::sort(edges.begin(), edges.end(), [](const auto &e, const auto &other) { return e.ends < other.ends; });
    std::vector<std::array<std::uint32_t, 2>> features;
    for (std::size_t first = 0, last = 0; first < edges.size(); first = last)
    {
      while (last < edges.size() && edges[last].ends == edges[first].ends)
        ++last;
      bool is_feature = last - first != 2;
      if (!is_feature)
      {
        // Triangles of a surface need not all turn the same way round.
        const auto n = normal_of(points, triangles[edges[first].triangle]), m = normal_of(points, triangles[edges[first + 1].triangle]);
        is_feature = std::abs(n[0] * m[0] + n[1] * m[1] + n[2] * m[2]) < cosine;
      }
      if (is_feature)
        features.push_back(edges[first].ends);
    }
    return features;
  }
} // namespace unilateral
