#include "unilateral/report/grid_surface.h"

#include "unilateral/report/buckets.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace unilateral
{
  namespace
  {
    constexpr std::uint32_t no_point = std::numeric_limits<std::uint32_t>::max();

    // Faces in VTK's numbering, seen from outside counterclockwise.
    constexpr std::array<std::array<unsigned, 4>, 6> faces_of_hexahedron = {
      {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};
    constexpr std::array<std::array<unsigned, 3>, 4> faces_of_tetrahedron = {{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};

    /// Plane cells, and all faces of solid ones.
    std::vector<Polygon> polygons_of(const VtuGrid &grid)
    {
      std::vector<Polygon> polygons;
      polygons.reserve(grid.cell_types.size());
      std::int32_t begin = 0;
      for (std::size_t c = 0; c < grid.cell_types.size(); ++c)
      {
        const auto *const corner = grid.connectivity.data() + begin;
        const auto        n = grid.offsets[c] - begin;
        begin = grid.offsets[c];
        const auto add = [&](const auto &numbers)
        {
          Polygon polygon{.corners = {}, .n = unsigned(numbers.size()), .cell = std::uint32_t(c)};
          for (unsigned k = 0; k < numbers.size(); ++k)
            polygon.corners[k] = corner[numbers[k]];
          polygons.push_back(polygon);
        };
        const unsigned type = grid.cell_types[c];
        if (type == 5 && n == 3)
          add(std::array<unsigned, 3>{0, 1, 2});
        else if (type == 9 && n == 4)
          add(std::array<unsigned, 4>{0, 1, 2, 3});
        else if (type == 10 && n == 4)
          for (const auto &face : faces_of_tetrahedron)
            add(face);
        else if (type == 12 && n == 8)
          for (const auto &face : faces_of_hexahedron)
            add(face);
      }
      return polygons;
    }

    /// The faces that only one cell has.
    std::vector<Polygon> outer_faces(const std::vector<Polygon> &faces, const std::vector<std::uint32_t> &by_place)
    {
      using Key = std::array<std::uint32_t, 4>;
      const auto key = [&](const Polygon &face)
      {
        Key sorted{no_point, no_point, no_point, no_point};
        for (unsigned k = 0; k < face.n; ++k)
          sorted[k] = by_place[face.corners[k]];
        std::sort(sorted.begin(), sorted.end());
        return sorted;
      };
      const Buckets by_first_corner(by_place.size(), faces.size(), [&](const std::size_t f) { return key(faces[f])[0]; });

      std::vector<bool>                          inner(faces.size(), false);
      std::vector<std::pair<Key, std::uint32_t>> keys;
      for (std::size_t corner = 0; corner < by_place.size(); ++corner)
      {
        keys.clear();
        for (std::uint32_t k = by_first_corner.begin[corner]; k < by_first_corner.begin[corner + 1]; ++k)
          keys.emplace_back(key(faces[by_first_corner.numbers[k]]), by_first_corner.numbers[k]);
        std::sort(keys.begin(), keys.end());
        for (std::size_t k = 0; k + 1 < keys.size(); ++k)
          if (keys[k].first == keys[k + 1].first)
            inner[keys[k].second] = inner[keys[k + 1].second] = true;
      }
      std::vector<Polygon> outer;
      for (std::size_t f = 0; f < faces.size(); ++f)
        if (!inner[f])
          outer.push_back(faces[f]);
      return outer;
    }
  } // namespace

  std::vector<std::uint32_t> numbers_by_place(const VtuGrid &grid)
  {
    using Place = std::array<std::int64_t, 3>;
    constexpr double resolution = 1e-9, off_the_boxes = 0.37; // where round numbers do not fall on a side of a box
    double           extent = 0;
    for (const auto &x : grid.points)
      for (unsigned d = 0; d < 3; ++d)
        extent = std::max(extent, std::abs(x[d] - grid.points[0][d]));
    const auto place_of = [&](const std::size_t i)
    {
      Place place{};
      for (unsigned d = 0; d < 3 && extent > 0; ++d)
        place[d] = std::llround((grid.points[i][d] - grid.points[0][d]) / (resolution * extent) + off_the_boxes);
      return place;
    };
    // A hash table with open addressing, at most two thirds full.
    std::vector<std::uint32_t> table(std::bit_ceil(grid.points.size() * 3 / 2 + 1), no_point), first(grid.points.size());
    for (std::size_t i = 0; i < first.size(); ++i)
    {
      const Place   place = place_of(i);
      std::uint64_t hash = 0;
      for (const std::int64_t k : place)
        hash = (hash ^ std::uint64_t(k)) * 0x9e3779b97f4a7c15U, hash ^= hash >> 32;
      std::size_t slot = hash & (table.size() - 1);
      while (table[slot] != no_point && place_of(table[slot]) != place)
        slot = (slot + 1) & (table.size() - 1);
      if (table[slot] == no_point)
        table[slot] = std::uint32_t(i);
      first[i] = table[slot];
    }
    return first;
  }

  std::vector<Polygon> surface_of(const VtuGrid &grid, const std::vector<std::uint32_t> &by_place)
  {
    std::vector<Polygon> polygons = polygons_of(grid);
    const bool           solid = !polygons.empty() && (grid.cell_types[0] == 10 || grid.cell_types[0] == 12);
    return solid ? outer_faces(polygons, by_place) : polygons;
  }
} // namespace unilateral
