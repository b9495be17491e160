#include "unilateral/report/scene.h"

#include "unilateral/report/coarser_surface.h"
#include "unilateral/report/grid_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace unilateral
{
  namespace
  {
    using Index = std::uint32_t;
    constexpr Index none = std::numeric_limits<Index>::max();

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
    scene.points.reserve(grid.points.size());
    for (const auto &x : grid.points)
      scene.points.push_back({float(x[0]), float(x[1]), float(x[2])});
    for (const auto &array : grid.point_arrays)
      scene.fields.push_back(
        {.name = array.name,
         .n_components = array.n_components,
         .values = std::visit([](const auto &values) { return std::vector<float>(values.begin(), values.end()); }, array.values)});
    const auto           by_place = numbers_by_place(grid);
    std::vector<Polygon> polygons = surface_of(grid, by_place);
    const auto           equal = equal_points(scene, by_place);
    for (Polygon &polygon : polygons)
      for (unsigned k = 0; k < polygon.n; ++k)
        polygon.corners[k] = equal[polygon.corners[k]];
    std::vector<Index> cell_of_triangle;
    const std::size_t  n_triangles =
      std::accumulate(polygons.begin(), polygons.end(), std::size_t(0), [](const std::size_t sum, const auto &p) { return sum + p.n - 2; });
    scene.triangles.reserve(n_triangles);
    cell_of_triangle.reserve(n_triangles);
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
        field.values.reserve(cell_of_triangle.size());
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
    {
      CoarserSurface coarser = coarser_surface(scene.points, scene.triangles, limits.triangles);
      scene.triangles = std::move(coarser.triangles);
      for (auto &field : scene.cell_fields)
      {
        std::vector<float> values;
        for (const std::size_t t : coarser.from)
          values.push_back(field.values[t]);
        field.values = std::move(values);
      }
    }
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
