#include "unilateral/functions/make_rigid_surface.h"

#include "unilateral/functions/stl_file.h"
#include "unilateral/functions/stl_surface.h"

#include <deal.II/base/tensor.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace unilateral
{
  namespace
  {
    using Vector3 = dealii::Tensor<1, 3>;

    /// A direction counts as parallel to a plane or to an axis when its unit vector departs by less.
    constexpr double parallel = 1e-12;

    Vector3 vector(const std::vector<double> &coordinates)
    {
      if (coordinates.size() > 3)
        throw std::runtime_error(fmt::format("a point of a surface has 3 coordinates at most, here {}", coordinates.size()));
      Vector3 v;
      std::copy(coordinates.begin(), coordinates.end(), v.begin_raw());
      return v;
    }

    Vector3 unit_vector(const std::vector<double> &coordinates, const std::string &name)
    {
      Vector3 v = vector(coordinates);
      // Any length will do, one whose square overflows too.
      const double largest = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
      if (!(largest > 0 && std::isfinite(largest)))
        throw std::runtime_error(fmt::format("the {} is zero; give it a direction", name));
      v /= largest;
      return v / v.norm();
    }

    double positive(const double number, const std::string &name)
    {
      if (!(number > 0 && std::isfinite(number)))
        throw std::runtime_error(fmt::format("the {} must be positive, it is {}", name, number));
      return number;
    }

    std::optional<std::array<double, 3>> unit_array(const Vector3 &v)
    {
      const double length = v.norm();
      if (!(length > 0))
        return {};
      return std::array<double, 3>{v[0] / length, v[1] / length, v[2] / length};
    }

    Vector3 difference(const std::array<double, 3> &x, const Vector3 &y)
    {
      return Vector3({x[0] - y[0], x[1] - y[1], x[2] - y[2]});
    }

    /// Where the line m + t d, |d| = 1, enters the ball of @p radius around 0 or, with @p inside, leaves it.
    std::optional<double> meet_ball(const Vector3 &m, const Vector3 &d, const double radius, const bool inside)
    {
      const double b = m * d;
      if (!inside && b >= 0)
        return {};
      // b^2 - c by the distance of the line from the centre; b^2 and c may be large and nearly equal.
      const double across = (m - b * d).norm();
      const double half_chord_square = (radius - across) * (radius + across);
      if (half_chord_square < 0)
        return {};
      const double half_chord = std::sqrt(half_chord_square), length = m.norm(), product = (length - radius) * (length + radius);
      // Of the roots -b -+ half_chord one is a sum of numbers of equal sign. The other follows from their product.
      if (!inside)
        return product / (-b + half_chord);
      return b <= 0 ? -b + half_chord : product / (-b - half_chord);
    }

    class Plane : public RigidSurface
    {
    public:
      explicit Plane(const SurfaceDescription &spec)
        : point(vector(spec.point)), direction(unit_vector(spec.direction, "normal of the plane"))
      {
      }

      std::optional<double> distance(const std::array<double, 3> &x, const std::array<double, 3> &d) const override
      {
        const double approach = -(Vector3({d[0], d[1], d[2]}) * direction);
        if (!(approach > parallel))
          return {};
        return difference(x, point) * direction / approach;
      }

      std::optional<std::array<double, 3>> normal(const std::array<double, 3> &) const override { return unit_array(direction); }

      std::optional<std::array<double, 3>> only_direction() const override
      {
        auto result = unit_array(direction);
        if (result)
          for (double &component : *result)
            component = -component;
        return result;
      }

    private:
      const Vector3 point, direction;
    };

    class Sphere : public RigidSurface
    {
    public:
      explicit Sphere(const SurfaceDescription &spec)
        : center(vector(spec.point)), radius(positive(spec.radius, "radius of the sphere")), inside(spec.inside)
      {
      }

      std::optional<double> distance(const std::array<double, 3> &x, const std::array<double, 3> &d) const override
      {
        return meet_ball(difference(x, center), Vector3({d[0], d[1], d[2]}), radius, inside);
      }

      std::optional<std::array<double, 3>> normal(const std::array<double, 3> &p) const override
      {
        return unit_array(difference(p, center));
      }

    private:
      const Vector3 center;
      const double  radius;
      const bool    inside;
    };

    class Cylinder : public RigidSurface
    {
    public:
      explicit Cylinder(const SurfaceDescription &spec)
        : point(vector(spec.point)), axis(unit_vector(spec.direction, "axis of the cylinder")),
          radius(positive(spec.radius, "radius of the cylinder")), inside(spec.inside)
      {
      }

      std::optional<double> distance(const std::array<double, 3> &x, const std::array<double, 3> &d) const override
      {
        const Vector3 d_across = across(Vector3({d[0], d[1], d[2]}));
        const double  share = d_across.norm();
        if (!(share > parallel))
          return {};
        if (const auto t = meet_ball(across(difference(x, point)), d_across / share, radius, inside))
          return *t / share;
        return {};
      }

      std::optional<std::array<double, 3>> normal(const std::array<double, 3> &p) const override
      {
        return unit_array(across(difference(p, point)));
      }

      std::optional<std::array<double, 3>> axis_direction() const override { return unit_array(axis); }

    private:
      /// The part of @p v across the axis; by products, so that a small one keeps its digits.
      Vector3 across(const Vector3 &v) const { return dealii::cross_product_3d(axis, dealii::cross_product_3d(v, axis)); }

      const Vector3 point, axis;
      const double  radius;
      const bool    inside;
    };

    std::shared_ptr<const RigidSurface> make_triangles(const SurfaceDescription &spec)
    {
      const double             scale = positive(spec.scale, "scale");
      const Vector3            shift = vector(spec.shift);
      std::vector<StlTriangle> triangles = read_stl(spec.file);
      for (StlTriangle &triangle : triangles)
        for (auto &vertex : triangle)
          for (unsigned i = 0; i < 3; ++i)
          {
            vertex[i] = scale * vertex[i] + shift[i];
            // Products of several coordinates must stay finite.
            if (!(std::abs(vertex[i]) < 1e50))
              throw std::runtime_error(
                fmt::format("STL file '{}' has a vertex out of bounds: a coordinate is {} after scaling", spec.file, vertex[i]));
          }
      auto surface = make_stl_surface(triangles);
      if (!surface)
        throw std::runtime_error(fmt::format("STL file '{}' has no triangle with an area; the first of {} has its vertices in a line",
                                             spec.file, triangles.size()));
      return surface;
    }
  } // namespace

  std::shared_ptr<const RigidSurface> make_rigid_surface(const SurfaceDescription &spec)
  {
    try
    {
      switch (spec.kind)
      {
      case SurfaceDescription::Kind::plane:
        return std::make_shared<Plane>(spec);
      case SurfaceDescription::Kind::sphere:
        return std::make_shared<Sphere>(spec);
      case SurfaceDescription::Kind::cylinder:
        return std::make_shared<Cylinder>(spec);
      case SurfaceDescription::Kind::stl:
        return make_triangles(spec);
      }
    }
    catch (const std::runtime_error &e)
    {
      if (spec.kind != SurfaceDescription::Kind::stl)
        throw InputError(spec.where, e.what(), MessageName("out-of-range"));
      std::error_code missing;
      throw InputError(spec.where, e.what(),
                       std::filesystem::is_regular_file(spec.file, missing) ? MessageName("file-damaged") : MessageName("file-not-found"));
    }
    throw std::logic_error("surface of unknown kind");
  }
} // namespace unilateral
