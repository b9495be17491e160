#include "unilateral/report/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace unilateral
{
  namespace
  {
    using Index = std::uint32_t;
    static constexpr Index none = std::numeric_limits<Index>::max();

    /// A polygon of three or four corners and the cell that it belongs to.
    struct Polygon
    {
      std::array<Index, 4> corners;
      unsigned             n = 3;
      Index                cell = 0;

      std::array<Index, 4> key() const
      {
        std::array<Index, 4> sorted = corners;
        if (n == 3)
          sorted[3] = none;
        std::sort(sorted.begin(), sorted.end());
        return sorted;
      }
    };

    // Faces in VTK's numbering, seen from outside counterclockwise.
    constexpr std::array<std::array<unsigned, 4>, 6> faces_of_hexahedron = {
      {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};
    constexpr std::array<std::array<unsigned, 3>, 4> faces_of_tetrahedron = {{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};

    /// Plane cells, and faces of solid ones.
    std::vector<Polygon> polygons_of(const VtuGrid &grid)
    {
      std::vector<Polygon> polygons;
      std::int32_t         begin = 0;
      for (std::size_t c = 0; c < grid.cell_types.size(); ++c)
      {
        const auto *const corner = grid.connectivity.data() + begin;
        const auto        n = grid.offsets[c] - begin;
        begin = grid.offsets[c];
        const auto add = [&](const auto &numbers)
        {
          Polygon polygon{.corners = {}, .n = unsigned(numbers.size()), .cell = Index(c)};
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

    /// Points of the same place, but for rounding, get one number: pieces of several processes meet in points of their own.
    std::vector<Index> numbers_by_place(const VtuGrid &grid)
    {
      using Place = std::array<std::int64_t, 3>;
      constexpr double   resolution = 1e-9, off_the_boxes = 0.37; // where round numbers do not fall on a side of a box
      double             extent = 0;
      std::vector<Place> places(grid.points.size());
      for (const auto &x : grid.points)
        for (unsigned d = 0; d < 3; ++d)
          extent = std::max(extent, std::abs(x[d] - grid.points[0][d]));
      for (std::size_t i = 0; i < places.size() && extent > 0; ++i)
        for (unsigned d = 0; d < 3; ++d)
          places[i][d] = std::llround((grid.points[i][d] - grid.points[0][d]) / (resolution * extent) + off_the_boxes);
      std::vector<Index> order(places.size()), number(places.size());
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(), order.end(),
                [&](const Index i, const Index j) { return std::pair(places[i], i) < std::pair(places[j], j); });
      for (std::size_t k = 0; k < order.size(); ++k)
        number[order[k]] = k > 0 && places[order[k]] == places[order[k - 1]] ? number[order[k - 1]] : order[k];
      return number;
    }

    /// For each point the first one of the same place where all functions have the same values, but for rounding. Where one jumps, at the
    /// interface of two regions, points stay apart.
    std::vector<Index> equal_points(const Scene &scene, const std::vector<Index> &by_place)
    {
      constexpr float    rounding = 1e-5F;
      std::vector<float> sizes;
      for (const auto &field : scene.fields)
      {
        float largest = 0;
        for (const float value : field.values)
          largest = std::isfinite(value) ? std::max(largest, std::abs(value)) : largest;
        sizes.push_back(largest);
      }
      const auto equal = [&](const Index i, const Index j)
      {
        for (std::size_t f = 0; f < sizes.size(); ++f)
          for (unsigned c = 0, n = scene.fields[f].n_components; c < n; ++c)
            if (std::abs(scene.fields[f].values[i * n + c] - scene.fields[f].values[j * n + c]) > rounding * sizes[f])
              return false;
        return true;
      };
      std::vector<Index> result(by_place.size());
      for (Index i = 0; i < result.size(); ++i)
        result[i] = by_place[i] < i && equal(i, by_place[i]) ? by_place[i] : i;
      return result;
    }

    /// The faces that only one cell has.
    std::vector<Polygon> outer_faces(const std::vector<Index> &number, std::vector<Polygon> faces)
    {
      const auto key = [&](Polygon face)
      {
        for (unsigned k = 0; k < face.n; ++k)
          face.corners[k] = number[face.corners[k]];
        return face.key();
      };
      std::vector<std::pair<std::array<Index, 4>, std::size_t>> keys(faces.size());
      for (std::size_t f = 0; f < faces.size(); ++f)
        keys[f] = {key(faces[f]), f};
      std::sort(keys.begin(), keys.end());
      std::vector<bool> inner(faces.size(), false);
      for (std::size_t k = 0; k + 1 < keys.size(); ++k)
        if (keys[k].first == keys[k + 1].first)
          inner[keys[k].second] = inner[keys[k + 1].second] = true;
      std::vector<Polygon> outer;
      for (std::size_t f = 0; f < faces.size(); ++f)
        if (!inner[f])
          outer.push_back(faces[f]);
      return outer;
    }

    double number_at(const VtuArray &array, const std::size_t i)
    {
      return std::visit([&](const auto &values) { return double(values[i]); }, array.values);
    }

    void set_range(Scene::Field &field)
    {
      field.min = std::numeric_limits<float>::max();
      field.max = std::numeric_limits<float>::lowest();
      for (std::size_t i = 0; i + field.n_components <= field.values.size(); i += field.n_components)
      {
        double value = field.values[i];
        if (field.n_components > 1)
        {
          double sum = 0;
          for (unsigned c = 0; c < field.n_components; ++c)
            sum += double(field.values[i + c]) * field.values[i + c];
          value = std::sqrt(sum);
        }
        if (std::isfinite(value))
        {
          field.min = std::min(field.min, float(value));
          field.max = std::max(field.max, float(value));
        }
      }
      if (field.min > field.max)
        field.min = field.max = 0;
    }

    /// Points of a lattice with cubes of side @p size: for each point of the scene the one that stands for its cube.
    std::vector<Index> representatives(const Scene &scene, const std::vector<bool> &on_rim, const float size)
    {
      struct Cube
      {
        Index                 best = none;
        bool                  rim = false;
        std::array<double, 3> sum{};
        unsigned              n = 0;
      };
      std::map<std::array<long, 3>, Cube> cubes;
      const auto                          cube_of = [&](const std::array<float, 3> &x)
      {
        std::array<long, 3> k{};
        for (unsigned d = 0; d < 3; ++d)
          k[d] = std::lround(std::floor(x[d] / size));
        return k;
      };
      for (std::size_t i = 0; i < scene.points.size(); ++i)
      {
        Cube &cube = cubes[cube_of(scene.points[i])];
        cube.rim = cube.rim || on_rim[i];
        ++cube.n;
        for (unsigned d = 0; d < 3; ++d)
          cube.sum[d] += scene.points[i][d];
      }
      // The point nearest to the mean of the cube, one on the rim where there are such: the outline of the mesh stays.
      std::vector<Index> result(scene.points.size());
      const auto         distance = [&](const Cube &cube, const std::size_t i)
      {
        double sum = 0;
        for (unsigned d = 0; d < 3; ++d)
          sum += std::pow(scene.points[i][d] - cube.sum[d] / cube.n, 2);
        return sum;
      };
      for (std::size_t i = 0; i < scene.points.size(); ++i)
      {
        Cube &cube = cubes[cube_of(scene.points[i])];
        if (cube.rim == on_rim[i] && (cube.best == none || distance(cube, i) < distance(cube, cube.best)))
          cube.best = i;
      }
      for (std::size_t i = 0; i < scene.points.size(); ++i)
        result[i] = cubes[cube_of(scene.points[i])].best;
      return result;
    }

    /// Points at edges that one triangle has, and, in space, at edges that are sharp.
    std::vector<bool> rim_of(const Scene &scene)
    {
      const auto normal = [&](const std::size_t t)
      {
        std::array<double, 3> a{}, b{};
        for (unsigned d = 0; d < 3; ++d)
        {
          a[d] = scene.points[scene.triangles[t][1]][d] - scene.points[scene.triangles[t][0]][d];
          b[d] = scene.points[scene.triangles[t][2]][d] - scene.points[scene.triangles[t][0]][d];
        }
        std::array<double, 3> n = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
        const double          size = std::hypot(n[0], n[1], n[2]);
        for (double &component : n)
          component /= size > 0 ? size : 1;
        return n;
      };
      std::vector<std::pair<std::array<Index, 2>, std::size_t>> edges;
      for (std::size_t t = 0; t < scene.triangles.size(); ++t)
        for (unsigned k = 0; k < 3; ++k)
        {
          const Index i = scene.triangles[t][k], j = scene.triangles[t][(k + 1) % 3];
          edges.push_back({{std::min(i, j), std::max(i, j)}, t});
        }
      std::sort(edges.begin(), edges.end());
      std::vector<bool> on_rim(scene.points.size(), false);
      for (std::size_t e = 0; e < edges.size();)
      {
        std::size_t end = e + 1;
        while (end < edges.size() && edges[end].first == edges[e].first)
          ++end;
        bool sharp = end - e != 2;
        if (!sharp)
        {
          const auto a = normal(edges[e].second), b = normal(edges[e + 1].second);
          sharp = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] < 0.7;
        }
        if (sharp)
          for (const Index i : edges[e].first)
            on_rim[i] = true;
        e = end;
      }
      return on_rim;
    }

    /// Leaves the points that triangles or lines use.
    void drop_unused_points(Scene &scene)
    {
      std::vector<Index> number(scene.points.size(), none);
      std::vector<Index> kept;
      const auto         keep = [&](Index &i)
      {
        if (number[i] == none)
        {
          number[i] = kept.size();
          kept.push_back(i);
        }
        i = number[i];
      };
      for (auto &triangle : scene.triangles)
        for (Index &i : triangle)
          keep(i);
      for (auto &line : scene.lines)
        for (Index &i : line)
          keep(i);
      std::vector<std::array<float, 3>> points;
      for (const Index i : kept)
        points.push_back(scene.points[i]);
      scene.points = std::move(points);
      for (auto &field : scene.fields)
      {
        std::vector<float> values;
        for (const Index i : kept)
          for (unsigned c = 0; c < field.n_components; ++c)
            values.push_back(field.values[i * field.n_components + c]);
        field.values = std::move(values);
      }
    }

    /// Triangles whose corners fall together go; of the others each is kept once.
    void coarsen(Scene &scene, const std::size_t limit)
    {
      std::array<float, 3> low = scene.points[0], high = scene.points[0];
      for (const auto &x : scene.points)
        for (unsigned d = 0; d < 3; ++d)
        {
          low[d] = std::min(low[d], x[d]);
          high[d] = std::max(high[d], x[d]);
        }
      const float extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
      const auto  on_rim = rim_of(scene);
      for (double n = 1.2 * std::sqrt(double(limit) / 2);; n *= 0.8)
      {
        const auto                            representative = representatives(scene, on_rim, float(extent / n));
        std::vector<std::array<Index, 3>>     triangles;
        std::vector<std::size_t>              from;
        std::map<std::array<Index, 3>, Index> seen;
        for (std::size_t t = 0; t < scene.triangles.size(); ++t)
        {
          std::array<Index, 3> corners{};
          for (unsigned k = 0; k < 3; ++k)
            corners[k] = representative[scene.triangles[t][k]];
          if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
            continue;
          auto key = corners;
          std::sort(key.begin(), key.end());
          if (seen.emplace(key, 0).second)
          {
            triangles.push_back(corners);
            from.push_back(t);
          }
        }
        if (triangles.size() > limit && n > 4)
          continue;
        scene.triangles = std::move(triangles);
        for (auto &field : scene.cell_fields)
        {
          std::vector<float> values;
          for (const std::size_t t : from)
            values.push_back(field.values[t]);
          field.values = std::move(values);
        }
        return;
      }
    }

    const VtuArray *find_array(const std::vector<VtuArray> &arrays, const std::string &name)
    {
      const auto found = std::find_if(arrays.begin(), arrays.end(), [&](const VtuArray &array) { return array.name == name; });
      return found == arrays.end() ? nullptr : &*found;
    }

    /// The points of I_G; of many, those in contact and every so many of the others.
    Scene::Cloud make_cloud(const ResultsFolder &folder, const std::size_t limit)
    {
      const VtuGrid &grid = folder.points;
      Scene::Cloud   cloud;
      cloud.n_in_all = grid.points.size();
      const VtuArray *const pressure = find_array(grid.point_arrays, "pressure"), *const gap = find_array(grid.point_arrays, "gap"),
                            *const penetration = find_array(grid.point_arrays, "penetration"),
                            *const active = find_array(grid.point_arrays, "active"),
                            *const direction = find_array(grid.point_arrays, "direction"),
                            *const u_along = find_array(grid.point_arrays, "u_along");
      if (!pressure || !gap || !penetration || !active)
        return {};
      std::size_t n_active = 0;
      for (std::size_t i = 0; i < grid.points.size(); ++i)
        n_active += number_at(*active, i) != 0;
      const auto step_for = [](const std::size_t n, const std::size_t most)
      { return n <= most ? std::size_t(1) : (n + most - 1) / std::max<std::size_t>(most, 1); };
      const std::size_t active_step = step_for(n_active, limit * 3 / 4),
                        step = step_for(grid.points.size() - n_active, limit - std::min(n_active, limit * 3 / 4));
      std::size_t n_of[2] = {0, 0};
      for (std::size_t i = 0; i < grid.points.size(); ++i)
      {
        const bool touches = number_at(*active, i) != 0;
        if (n_of[touches]++ % (touches ? active_step : step) != 0)
          continue;
        cloud.points.push_back({float(grid.points[i][0]), float(grid.points[i][1]), float(grid.points[i][2])});
        cloud.pressure.push_back(float(number_at(*pressure, i)));
        cloud.gap.push_back(float(number_at(*gap, i)));
        cloud.penetration.push_back(float(number_at(*penetration, i)));
        cloud.active.push_back(touches);
        if (direction && direction->n_components == 3)
          cloud.direction.push_back(
            {float(number_at(*direction, 3 * i)), float(number_at(*direction, 3 * i + 1)), float(number_at(*direction, 3 * i + 2))});
        if (u_along)
          cloud.u_along.push_back(float(number_at(*u_along, i)));
      }
      return cloud;
    }
  } // namespace

  const Scene::Field *Scene::find(const std::string &name) const
  {
    const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field &field) { return field.name == name; });
    return found == fields.end() ? nullptr : &*found;
  }

  Scene make_scene(const ResultsFolder &folder, const SceneLimits &limits)
  {
    const VtuGrid &grid = folder.solution;
    Scene          scene;
    if (grid.points.empty() || grid.cell_types.empty())
      return scene;
    const unsigned type = grid.cell_types[0];
    scene.dimension = type == 3 ? 1 : type == 5 || type == 9 ? 2 : 3;
    const VtuArray *const u = find_array(grid.point_arrays, "u");
    scene.vector = u && u->n_components > 1;
    if (folder.results)
    {
      using Pointer = ResultsFolder::Json::json_pointer;
      const auto text_at = [&](const char *const path)
      {
        const Pointer pointer(path);
        return folder.results->contains(pointer) && (*folder.results)[pointer].is_string() ? (*folder.results)[pointer].get<std::string>()
                                                                                           : "";
      };
      scene.axisymmetric = text_at("/case/expanded").find("\"axisymmetric\"") != std::string::npos;
      const std::string up = text_at("/mesh/up");
      scene.upward_axis = scene.dimension < 3 ? 2 : up == "x" ? 0 : up == "y" ? 1 : 2;
    }
    for (const auto &x : grid.points)
      scene.points.push_back({float(x[0]), float(x[1]), float(x[2])});
    for (const auto &array : grid.point_arrays)
    {
      Scene::Field field{.name = array.name, .n_components = array.n_components, .values = {}};
      for (std::size_t i = 0; i < grid.points.size() * array.n_components; ++i)
        field.values.push_back(float(number_at(array, i)));
      scene.fields.push_back(std::move(field));
    }
    std::vector<Polygon> polygons = polygons_of(grid);
    const auto           by_place = numbers_by_place(grid);
    if (scene.dimension == 3)
      polygons = outer_faces(by_place, std::move(polygons));
    const auto equal = equal_points(scene, by_place);
    for (Polygon &polygon : polygons)
      for (unsigned k = 0; k < polygon.n; ++k)
        polygon.corners[k] = equal[polygon.corners[k]];
    std::vector<Index> cell_of_triangle;
    for (const Polygon &polygon : polygons)
      for (unsigned k = 1; k + 1 < polygon.n; ++k)
      {
        scene.triangles.push_back({polygon.corners[0], polygon.corners[k], polygon.corners[k + 1]});
        cell_of_triangle.push_back(polygon.cell);
      }
    for (const auto &array : grid.cell_arrays)
      if (array.n_components == 1)
      {
        Scene::Field field{.name = array.name, .values = {}};
        for (const Index cell : cell_of_triangle)
          field.values.push_back(float(number_at(array, cell)));
        set_range(field);
        if (field.min < field.max) // what is the same everywhere is no picture
          scene.cell_fields.push_back(std::move(field));
      }

    scene.n_triangles_in_all = scene.triangles.size();
    if (scene.dimension == 1)
    {
      std::int32_t begin = 0;
      for (const auto end : grid.offsets)
      {
        if (end - begin == 2)
          scene.lines.push_back({Index(grid.connectivity[begin]), Index(grid.connectivity[begin + 1])});
        begin = end;
      }
    }
    else if (scene.triangles.size() > limits.triangles)
      coarsen(scene, limits.triangles);
    else
    {
      std::vector<std::array<Index, 2>> edges;
      for (const Polygon &polygon : polygons)
        for (unsigned k = 0; k < polygon.n; ++k)
        {
          const Index i = polygon.corners[k], j = polygon.corners[(k + 1) % polygon.n];
          edges.push_back({std::min(i, j), std::max(i, j)});
        }
      std::sort(edges.begin(), edges.end());
      edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
      if (edges.size() <= limits.lines)
        scene.lines = std::move(edges);
    }
    drop_unused_points(scene);
    for (auto &field : scene.fields)
      set_range(field);
    scene.cloud = make_cloud(folder, limits.cloud);
    return scene;
  }
} // namespace unilateral
