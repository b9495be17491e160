#include "unilateral/report/feature_edges.h"

#include "unilateral/report/buckets.h"
#include "unilateral/report/triangle_normal.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace unilateral
{
  namespace
  {
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
    const double cosine = 0.82; // of 35 degrees
    const auto   ends_of = [&](const std::size_t edge)
    {
      const auto         &triangle = triangles[edge / 3];
      const std::uint32_t a = triangle[edge % 3], b = triangle[(edge % 3 + 1) % 3];
      return std::array{std::min(a, b), std::max(a, b)};
    };
    const bool    flat = std::all_of(points.begin(), points.end(), [&](const auto &x) { return x[2] == points[0][2]; });
    const Buckets by_smaller_end(points.size(), 3 * triangles.size(), [&](const std::size_t edge) { return ends_of(edge)[0]; });

    std::vector<std::array<std::uint32_t, 2>>            features;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges; // of one smaller end: the other end, the triangle
    for (std::uint32_t smaller = 0; smaller < points.size(); ++smaller)
    {
      edges.clear();
      for (std::uint32_t k = by_smaller_end.begin[smaller]; k < by_smaller_end.begin[smaller + 1]; ++k)
        edges.emplace_back(ends_of(by_smaller_end.numbers[k])[1], by_smaller_end.numbers[k] / 3);
      std::sort(edges.begin(), edges.end());
      for (std::size_t first = 0, last = 0; first < edges.size(); first = last)
      {
        while (last < edges.size() && edges[last].first == edges[first].first)
          ++last;
        bool is_feature = last - first != 2;
        if (!is_feature && !flat)
        {
          // Triangles of a surface need not all turn the same way round.
          const auto n = normal_of(points, triangles[edges[first].second]), m = normal_of(points, triangles[edges[first + 1].second]);
          is_feature = std::abs(n[0] * m[0] + n[1] * m[1] + n[2] * m[2]) < cosine;
        }
        if (is_feature)
          features.push_back({smaller, edges[first].first});
      }
    }
    return features;
  }
} // namespace unilateral
