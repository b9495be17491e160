#include "unilateral/report/coarser_surface.h"

#include "unilateral/report/feature_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>
#include <vector>

namespace unilateral
{
  namespace
  {
    using Index = std::uint32_t;
    constexpr Index no_index = std::numeric_limits<Index>::max();

    struct Cube
    {
      Index                 best = no_index; ///< the point that stands for the cube
      bool                  rim = false;
      std::array<double, 3> sum{};
      unsigned              n = 0;

      /// From the mean of its points.
      double distance_square(const std::array<float, 3> &x) const
      {
        double square = 0;
        for (unsigned d = 0; d < 3; ++d)
          square += std::pow(x[d] - sum[d] / n, 2);
        return square;
      }
    };

    /// The least box that holds all points.
    std::pair<std::array<float, 3>, std::array<float, 3>> box_around(const std::vector<std::array<float, 3>> &points)
    {
      auto low = points[0], high = points[0];
      for (const auto &x : points)
        for (unsigned d = 0; d < 3; ++d)
        {
          low[d] = std::min(low[d], x[d]);
          high[d] = std::max(high[d], x[d]);
        }
      return {low, high};
    }

    /// For each point the one that stands for its cube in a lattice with @p n cubes along the longest side of the box: of those on the rim,
    /// where there are such, the one nearest to the mean of the cube.
    std::vector<Index> representatives(const std::vector<std::array<float, 3>> &points, const std::vector<bool> &on_rim, const double n)
    {
      const auto            box = box_around(points);
      std::array<double, 3> extent{};
      for (unsigned d = 0; d < 3; ++d)
        extent[d] = double(box.second[d]) - box.first[d];
      const double               size = *std::max_element(extent.begin(), extent.end()) / n;
      std::array<std::size_t, 3> n_cubes{1, 1, 1};
      for (unsigned d = 0; d < 3 && size > 0; ++d)
        n_cubes[d] = std::size_t(extent[d] / size) + 1;

      std::vector<Index> number_of_cube(n_cubes[0] * n_cubes[1] * n_cubes[2], no_index), cube_of_point(points.size());
      std::vector<Cube>  cubes;
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        std::size_t place = 0;
        for (unsigned d = 3; d-- > 0;)
          place = place * n_cubes[d] + (size > 0 ? std::min(n_cubes[d] - 1, std::size_t((double(points[i][d]) - box.first[d]) / size)) : 0);
        if (number_of_cube[place] == no_index)
        {
          number_of_cube[place] = Index(cubes.size());
          cubes.emplace_back();
        }
        cube_of_point[i] = number_of_cube[place];
        Cube &cube = cubes[cube_of_point[i]];
        cube.rim = cube.rim || on_rim[i];
        ++cube.n;
        for (unsigned d = 0; d < 3; ++d)
          cube.sum[d] += points[i][d];
      }
      for (std::size_t i = 0; i < points.size(); ++i)
        if (Cube &cube = cubes[cube_of_point[i]];
            cube.rim == on_rim[i] && (cube.best == no_index || cube.distance_square(points[i]) < cube.distance_square(points[cube.best])))
          cube.best = Index(i);
      for (Index &entry : cube_of_point)
        entry = cubes[entry].best;
      return cube_of_point;
    }
  } // namespace

  CoarserSurface coarser_surface(const std::vector<std::array<float, 3>> &points,
                                 const std::vector<std::array<Index, 3>> &triangles,
                                 const std::size_t                        limit)
  {
    std::vector<bool> on_rim(points.size(), false);
    for (const auto &edge : feature_edges(points, triangles))
      for (const Index i : edge)
        on_rim[i] = true;
    for (double n = 1.2 * std::sqrt(double(limit) / 2);; n *= 0.8)
    {
      const auto                     representative = representatives(points, on_rim, n);
      CoarserSurface                 coarser;
      std::set<std::array<Index, 3>> seen;
      for (std::size_t t = 0; t < triangles.size(); ++t)
      {
        std::array<Index, 3> corners{};
        for (unsigned k = 0; k < 3; ++k)
          corners[k] = representative[triangles[t][k]];
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
          continue;
        auto key = corners;
        std::sort(key.begin(), key.end());
        if (seen.insert(key).second)
        {
          coarser.triangles.push_back(corners);
          coarser.from.push_back(t);
        }
      }
      if (coarser.triangles.size() <= limit || n <= 4)
        return coarser;
    }
  }
} // namespace unilateral
