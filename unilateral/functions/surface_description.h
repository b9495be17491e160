// The surface of a rigid obstacle as a plain value.
#pragma once

#include "unilateral/base/diagnostics.h"

#include <string>
#include <vector>

namespace unilateral
{
  /// The surface of a rigid obstacle; rigid_surface.h measures distances to it.
  struct SurfaceDescription
  {
    enum class Kind
    {
      plane,    ///< through `point`, `direction` its normal, which points out of the obstacle
      sphere,   ///< centre `point`, `radius`; a circle in 2-D
      cylinder, ///< axis through `point` along `direction`, `radius`; 3-D
      stl       ///< triangles from `file`, scaled, then shifted; their normals point out of the obstacle; 3-D
    };
    Kind                kind = Kind::plane;
    std::vector<double> point, direction; ///< `dim` numbers each
    double              radius = 1;
    bool                inside = false; ///< sphere, cylinder: the obstacle is the outside, the body lies in a hollow
    std::string         file;           ///< path; in a case that is being read, relative to the case file
    double              scale = 1;
    std::vector<double> shift; ///< none, or 3 numbers
    SourceLocation      where;
  };
} // namespace unilateral
