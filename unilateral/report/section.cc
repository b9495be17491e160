#include "unilateral/report/section.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace unilateral
{
  namespace
  {
    using Place = std::array<double, 2>;

    std::pair<Place, Place> box_of(const Scene &scene)
    {
      Place low{}, high{};
      for (std::size_t i = 0; i < scene.points.size(); ++i)
        for (unsigned d = 0; d < 2; ++d)
        {
          low[d] = i == 0 ? scene.points[i][d] : std::min<double>(low[d], scene.points[i][d]);
          high[d] = i == 0 ? scene.points[i][d] : std::max<double>(high[d], scene.points[i][d]);
        }
      return {low, high};
    }

    /// A crossing: between points i and j, at the part t of the way.
    struct Crossing
    {
      double        s;
      std::uint32_t i, j;
      double        t;
    };

    Section section_through(const Scene &scene, std::vector<Crossing> crossings)
    {
      std::sort(crossings.begin(), crossings.end(), [](const Crossing &a, const Crossing &b) { return a.s < b.s; });
      const double length = crossings.empty() ? 0 : crossings.back().s - crossings.front().s;
      Section      section;
      for (const auto &field : scene.fields)
        if (field.n_components == 1)
          section.values.emplace_back(field.name, std::vector<double>());
      for (const Crossing &crossing : crossings)
      {
        if (!section.s.empty() && crossing.s - section.s.back() < 1e-7 * length)
          continue; // the same edge, seen from the next triangle
        section.s.push_back(crossing.s);
        std::size_t k = 0;
        for (const auto &field : scene.fields)
          if (field.n_components == 1)
            section.values[k++].second.push_back((1 - crossing.t) * field.values[crossing.i] + crossing.t * field.values[crossing.j]);
      }
      return section;
    }
  } // namespace

  std::pair<Place, Place> default_section_line(const Scene &scene)
  {
    const auto [low, high] = box_of(scene);
    if (scene.dimension == 1)
      return {{low[0], 0}, {high[0], 0}};
    Place centre = {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2};
    float largest = 0;
    for (const auto &field : scene.fields)
      if (field.name.starts_with("contact_pressure") && field.n_components == 1)
        for (std::size_t i = 0; i < field.values.size(); ++i)
          if (field.values[i] > largest)
          {
            largest = field.values[i];
            centre = {scene.points[i][0], scene.points[i][1]};
          }
    const unsigned along = high[0] - low[0] >= high[1] - low[1] ? 0 : 1;
    // Not on an edge of the mesh, where it might find one of two triangles only.
    const double aside = 1e-6 * (high[1 - along] - low[1 - along]);
    Place        a = centre, b = centre;
    a[along] = low[along];
    b[along] = high[along];
    for (Place *const x : {&a, &b})
      (*x)[1 - along] += centre[1 - along] + aside < high[1 - along] ? aside : -aside;
    return {a, b};
  }

  Section section_along(const Scene &scene, const Place &a, const Place &b)
  {
    std::vector<Crossing> crossings;
    if (scene.dimension == 1)
    {
      for (std::uint32_t i = 0; i < scene.points.size(); ++i)
        crossings.push_back({scene.points[i][0], i, i, 0});
      return section_through(scene, std::move(crossings));
    }
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    if (scene.dimension != 2 || !(length > 0))
      return {};
    const Place direction = {(b[0] - a[0]) / length, (b[1] - a[1]) / length};
    const auto  along = [&](const std::uint32_t i)
    { return (scene.points[i][0] - a[0]) * direction[0] + (scene.points[i][1] - a[1]) * direction[1]; };
    const auto aside = [&](const std::uint32_t i)
    { return (scene.points[i][1] - a[1]) * direction[0] - (scene.points[i][0] - a[0]) * direction[1]; };
    for (const auto &triangle : scene.triangles)
      for (unsigned k = 0; k < 3; ++k)
      {
        const std::uint32_t i = triangle[k], j = triangle[(k + 1) % 3];
        const double        from = aside(i), to = aside(j);
        if ((from <= 0) == (to <= 0))
          continue;
        const double t = from / (from - to), s = (1 - t) * along(i) + t * along(j);
        if (s >= -1e-9 * length && s <= (1 + 1e-9) * length)
          crossings.push_back({s, i, j, t});
      }
    return section_through(scene, std::move(crossings));
  }
} // namespace unilateral
