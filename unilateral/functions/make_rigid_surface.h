// Planes, spheres, cylinders, triangles from an STL file -> RigidSurface.
#pragma once

#include "unilateral/functions/rigid_surface.h"
#include "unilateral/functions/surface_description.h"

#include <memory>

namespace unilateral
{
  /// The surface that @p spec describes; coordinates that it leaves out are 0. Opens the STL file.
  /// Throws InputError at spec.where: a normal, axis, radius or scale that cannot be, and everything that is wrong with the file.
  std::shared_ptr<const RigidSurface> make_rigid_surface(const SurfaceDescription &spec);
} // namespace unilateral
