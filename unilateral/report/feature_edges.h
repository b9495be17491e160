// The lines that show the form of a surface: its rim and its sharp edges.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace unilateral
{
  /// Edges of one triangle alone, and those where the normals of two triangles differ by more than 35 degrees; of flat meshes the boundary.
  std::vector<std::array<std::uint32_t, 2>> feature_edges(const std::vector<std::array<float, 3>>         &points,
                                                          const std::vector<std::array<std::uint32_t, 3>> &triangles);
} // namespace unilateral
