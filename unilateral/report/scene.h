// What a picture of results shows: the mesh, or the surface of a body, as triangles with the functions on it, and the points of I_G.
#pragma once

#include "unilateral/report/results_folder.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace unilateral
{
  struct Scene
  {
    struct Field
    {
      std::string        name;
      unsigned           n_components = 1;
      std::vector<float> values;           ///< by point, or by triangle
      float              min = 0, max = 0; ///< of the size where there are several components
    };

    /// The points of I_G.
    struct Cloud
    {
      std::vector<std::array<float, 3>> points;
      std::vector<float>                pressure, gap, penetration;
      std::vector<std::uint8_t>         active;
      std::vector<std::array<float, 3>> direction;    ///< of the gap; bodies only
      std::vector<float>                u_along;      ///< u along it; bodies only
      std::size_t                       n_in_all = 0; ///< before some were left out
    };

    unsigned                                  dimension = 0;  ///< of the mesh
    bool                                      vector = false; ///< u is the displacement of a body
    bool                                      axisymmetric = false;
    unsigned                                  upward_axis = 2; ///< in space
    std::vector<std::array<float, 3>>         points;
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< the mesh in 2-D, the surface in 3-D
    std::vector<std::array<std::uint32_t, 2>> lines;     ///< edges of cells; in 1-D the cells
    std::vector<Field>                        fields, cell_fields;
    Cloud                                     cloud;
    std::size_t                               n_triangles_in_all = 0; ///< before they became fewer

    const Field *find(const std::string &name) const;
    bool         empty() const { return points.empty(); }
  };

  struct SceneLimits
  {
    std::size_t triangles = 60000, lines = 120000, cloud = 20000;
  };

  /// The scene of a run; empty where it left no fields. A surface with more triangles than the limit is made coarser: points that lie
  /// in one cube of a lattice become one of them.
  Scene make_scene(const ResultsFolder &folder, const SceneLimits &limits = {});
} // namespace unilateral
