// A rigid surface of triangles: which of them a line meets, by a tree of boxes.
#pragma once

#include "unilateral/functions/rigid_surface.h"
#include "unilateral/functions/stl_file.h"

#include <memory>
#include <vector>

namespace unilateral
{
  /// The surface of @p triangles; see RigidSurface::distance(). Those without an area are skipped; nullptr when no other is left.
  ///
  /// A line through an edge or a vertex is treated as if it were moved aside by an infinitesimal amount, the same for all triangles: a
  /// closed surface is entered as often as it is left, whatever the rounding. Edges that only one triangle has are widened by 1e-6 of the
  /// surface's diagonal, so that single-precision coordinates neither open cracks nor cut off the rim of an open surface.
  /// Cost: O(log n) boxes a line and 200 bytes a triangle.
  std::shared_ptr<const RigidSurface> make_stl_surface(const std::vector<StlTriangle> &triangles);
} // namespace unilateral
