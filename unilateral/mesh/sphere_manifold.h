// Spheres and circles of any size as a geometry for meshes.
#pragma once

#include <deal.II/base/array_view.h>
#include <deal.II/base/point.h>
#include <deal.II/base/table.h>
#include <deal.II/grid/manifold_lib.h>

#include <cmath>
#include <memory>
#include <vector>

namespace unilateral
{
  /// dealii::SphericalManifold in the unit of a length: its own tolerances, as for points that are as good as one, are lengths of 1e-10.
  template <int dim>
  class SphereManifold : public dealii::SphericalManifold<dim>
  {
  public:
    using Base = dealii::SphericalManifold<dim>;
    using Point = dealii::Point<dim>;
    using Points = dealii::ArrayView<const Point>;
    using Face = typename dealii::Triangulation<dim>::face_iterator;

    SphereManifold(const Point &center, const double unit) : Base(center), unit_sphere(Point()), unit(unit) {}

    std::unique_ptr<dealii::Manifold<dim>> clone() const override { return std::make_unique<SphereManifold>(this->center, unit); }

    Point get_intermediate_point(const Point &a, const Point &b, const double weight) const override
    {
      return from_unit(unit_sphere.get_intermediate_point(to_unit(a), to_unit(b), weight));
    }

    dealii::Tensor<1, dim> get_tangent_vector(const Point &a, const Point &b) const override
    {
      return unit * unit_sphere.get_tangent_vector(to_unit(a), to_unit(b));
    }

    Point get_new_point(const Points &points, const dealii::ArrayView<const double> &weights) const override
    {
      const auto scaled = to_unit(points);
      return from_unit(unit_sphere.get_new_point(dealii::make_array_view(scaled), weights));
    }

    void get_new_points(const Points &points, const dealii::Table<2, double> &weights, dealii::ArrayView<Point> new_points) const override
    {
      const auto scaled = to_unit(points);
      unit_sphere.get_new_points(dealii::make_array_view(scaled), weights, new_points);
      for (Point &x : new_points)
        x = from_unit(x);
    }

    /// Radial on faces whose vertices are on a sphere about the centre.
    dealii::Tensor<1, dim> normal_vector(const Face &face, const Point &x) const override
    {
      const double radius = face->vertex(0).distance(this->center);
      for (unsigned v = 1; v < face->n_vertices(); ++v)
        if (std::abs(face->vertex(v).distance(this->center) - radius) > 1e-8 * radius)
          return Base::normal_vector(face, x);
      const dealii::Tensor<1, dim> radial = to_unit(x);
      return radial / radial.norm();
    }

    void get_normals_at_vertices(const Face &face, typename dealii::Manifold<dim>::FaceVertexNormals &normals) const override
    {
      for (unsigned v = 0; v < face->n_vertices(); ++v)
        normals[v] = normal_vector(face, face->vertex(v));
    }

  private:
    Point              to_unit(const Point &x) const { return Point((x - this->center) / unit); }
    Point              from_unit(const Point &x) const { return this->center + unit * x; }
    std::vector<Point> to_unit(const Points &points) const
    {
      std::vector<Point> scaled;
      for (const Point &x : points)
        scaled.push_back(to_unit(x));
      return scaled;
    }

    const Base   unit_sphere;
    const double unit;
  };
} // namespace unilateral
