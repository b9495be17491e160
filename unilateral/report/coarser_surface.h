// A surface with fewer triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace unilateral
{
  struct CoarserSurface
  {
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< of the same points, of which many have none
    std::vector<std::size_t>                  from;      ///< the triangle from which each was made
  };

  /// At most @p limit triangles, by a lattice of cubes: the points in each become one of them, on the rim where there are such, so that the
  /// outline and sharp edges of the surface stay. Triangles whose corners fall together go.
  CoarserSurface coarser_surface(const std::vector<std::array<float, 3>>         &points,
                                 const std::vector<std::array<std::uint32_t, 3>> &triangles,
                                 std::size_t                                      limit);
} // namespace unilateral
