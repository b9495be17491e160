// The surface of a rigid obstacle, and how far away it is along a line: planes, spheres, cylinders, triangles from an STL file.
#pragma once

#include <array>
#include <memory>
#include <optional>

namespace unilateral
{
  /// One subclass per SurfaceDescription::Kind. Immutable, safe to share among threads.
  class RigidSurface
  {
  public:
    virtual ~RigidSurface() = default;

    /// The signed distance t, in the unit of length of the mesh, after which a point that starts in @p x and moves along the unit vector
    /// @p d touches the obstacle in x + t d: t > 0 apart, t = 0 in contact, t < 0 when x lies in the obstacle, the penetration along d.
    /// Nothing when the line never enters the obstacle: it misses it, or d leads away. In 2-D, z is 0 in both.
    ///
    /// Plane: t = ((x - p).N) / (-d.N); nothing where d.N >= -1e-12, N of unit length.
    /// Sphere and circle, with m = x - c: the roots of t^2 + 2 (m.d) t + |m|^2 - r^2 = 0. The lesser where d leads towards the centre,
    /// m.d < 0; with a body inside the sphere the greater, always. Cylinder: the same in the plane across its axis, divided by the length
    /// of d there.
    /// STL: along the line facets are entered (N.d < 0, N by the order of the vertices) or left. The nearest ahead, entered: that t; left:
    /// x lies inside, and the answer is the last facet entered before x. None ahead: the nearest behind, if entered; x has sunk through
    /// an open surface. Facets parallel to the line count as missed.
    virtual std::optional<double> distance(const std::array<double, 3> &x, const std::array<double, 3> &d) const = 0;

    /// The normal of the surface in a point @p p of it, of unit length, either way; nothing for triangles, whose normals jump. Where a
    /// mode r has r(p).normal = 0 all over, the surface slides along itself: a plane in its directions, a ball about its centre, a
    /// cylinder along and about its axis.
    virtual std::optional<std::array<double, 3>> normal(const std::array<double, 3> & /*p*/) const { return {}; }

    /// Of a plane: minus its normal. What it stops is motion in that direction, whichever way the surface of the body faces.
    virtual std::optional<std::array<double, 3>> only_direction() const { return {}; }

    /// Of a cylinder: the direction of its axis, of unit length.
    virtual std::optional<std::array<double, 3>> axis_direction() const { return {}; }
  };
} // namespace unilateral
