#include "unilateral/constraints/round_surface.h"

#include "unilateral/algebra/dense_solvers.h"

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    using Vector3 = Eigen::Vector3d;

    constexpr double largest_distance = 1e-6; ///< of a corner from the surface, in the unit of its radius
    /// Between the normals of a facet and of the surface at its corners: 28 degrees, or those of a cube that stands for a ball.
    constexpr double least_cosine = 0.88, least_cosine_on_manifold = 0.5;

    template <int dim>
    Vector3 three_numbers(const Tensor<1, dim> &x)
    {
      Vector3 result = Vector3::Zero();
      for (unsigned d = 0; d < dim; ++d)
        result(d) = x[d];
      return result;
    }

    /// The part of v across the axis; v where there is none.
    Vector3 across(const Vector3 &v, const Vector3 &axis)
    {
      return v - axis.dot(v) * axis;
    }

    /// The sphere through points, |x|^2 = 2 c.x + k by least squares; in a plane, or across an axis, the circle.
    std::optional<std::pair<Vector3, double>> sphere_through(const std::vector<Vector3> &points)
    {
      Vector3 mean = Vector3::Zero();
      for (const Vector3 &x : points)
        mean += x / double(points.size());
      double size = 0;
      for (const Vector3 &x : points)
        size = std::max(size, (x - mean).norm());
      if (!(size > 0))
        return {};
      Eigen::MatrixXd A(points.size(), 4);
      Eigen::VectorXd b(points.size());
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        const Vector3 x = (points[i] - mean) / size;
        A.row(i) << 2 * x.transpose(), 1;
        b(i) = x.squaredNorm();
      }
      // Least norm where all points lie in a plane: then the centre does, too.
      Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
      decomposition.setThreshold(1e-9);
      decomposition.compute(A);
      const Eigen::VectorXd solution = decomposition.solve(b);
      const double          square = solution(3) + solution.head<3>().squaredNorm();
      // Nearly flat: the radius is that of the noise.
      if (!(square > 0 && square < 1e6))
        return {};
      return std::pair(Vector3(mean + size * solution.head<3>()), size * std::sqrt(square));
    }
  } // namespace

  template <int dim>
  std::vector<Facet<dim>> facets_of_part(const Triangulation<dim> &mesh, const types::boundary_id part)
  {
    std::vector<Facet<dim>> facets;
    for (const auto &cell : mesh.active_cell_iterators())
      for (const auto f : cell->face_indices())
      {
        if (!cell->at_boundary(f) || cell->face(f)->boundary_id() != part)
          continue;
        Facet<dim> &facet = facets.emplace_back();
        for (const auto v : cell->face(f)->vertex_indices())
          facet.corners.push_back(cell->face(f)->vertex(v));
        if constexpr (dim == 2)
          facet.normal = cross_product_2d(facet.corners[1] - facet.corners[0]);
        if constexpr (dim == 3)
          facet.normal = cross_product_3d(facet.corners[1] - facet.corners[0], facet.corners[2] - facet.corners[0]);
        facet.normal /= facet.normal.norm();
        if (facet.normal * (cell->center() - facet.corners[0]) > 0)
          facet.normal *= -1;
      }
    return facets;
  }

  template <int dim>
  std::vector<Facet<dim>> gather_facets(std::vector<Facet<dim>> own, const Processes &processes)
  {
    if (processes.alone())
      return own;
    std::vector<double> numbers; // of each facet how many corners it has, these, the normal
    for (const Facet<dim> &facet : own)
    {
      numbers.push_back(facet.corners.size());
      for (const auto &x : facet.corners)
        for (unsigned d = 0; d < dim; ++d)
          numbers.push_back(x[d]);
      for (unsigned d = 0; d < dim; ++d)
        numbers.push_back(facet.normal[d]);
    }
    numbers = processes.gather(numbers);
    std::vector<Facet<dim>> all;
    for (auto next = numbers.begin(); next != numbers.end();)
    {
      Facet<dim> &facet = all.emplace_back();
      facet.corners.resize(static_cast<std::size_t>(*next++));
      for (auto &x : facet.corners)
        for (unsigned d = 0; d < dim; ++d)
          x[d] = *next++;
      for (unsigned d = 0; d < dim; ++d)
        facet.normal[d] = *next++;
    }
    return all;
  }

  template <int dim>
  Tensor<1, dim> RoundSurface::normal(const Point<dim> &x) const
  {
    const Vector3  radial = sign * across(three_numbers<dim>(x) - Vector3(centre.data()), Vector3(axis.data())).normalized();
    Tensor<1, dim> result;
    for (unsigned d = 0; d < dim; ++d)
      result[d] = radial(d);
    return result;
  }

  namespace
  {
    /// A cylinder with the direction @p along; a circle or a sphere where that is zero.
    template <int dim>
    std::optional<RoundSurface> round_surface_along(const std::vector<Facet<dim>> &facets, const Vector3 &along, const double least_allowed)
    {
      std::vector<Vector3> corners;
      for (const auto &facet : facets)
        for (const auto &x : facet.corners)
          corners.push_back(across(three_numbers<dim>(x), along));
      const auto fit = corners.empty() ? std::nullopt : sphere_through(corners);
      if (!fit)
        return {};
      const auto &[centre, radius] = *fit;
      for (const Vector3 &x : corners)
        if (std::abs((x - centre).norm() - radius) > largest_distance * radius)
          return {};
      double least = 1, greatest = -1; // cosines of the angles between facets and the surface
      for (const auto &facet : facets)
        for (const auto &x : facet.corners)
        {
          const double cosine = three_numbers<dim>(facet.normal).dot((across(three_numbers<dim>(x), along) - centre).normalized());
          least = std::min(least, cosine);
          greatest = std::max(greatest, cosine);
        }
      if (least < least_allowed && greatest > -least_allowed)
        return {};
      RoundSurface result;
      std::copy(centre.begin(), centre.end(), result.centre.begin());
      std::copy(along.begin(), along.end(), result.axis.begin());
      result.sign = least > 0 ? 1 : -1;
      return result;
    }
  } // namespace

  template <int dim>
  std::optional<RoundSurface>
  round_surface_of(const std::vector<Facet<dim>> &facets, const std::optional<std::array<double, 3>> &axis, const bool on_manifold)
  {
    const double least_allowed = on_manifold ? least_cosine_on_manifold : least_cosine;
    if (const auto cylinder = axis ? round_surface_along(facets, Vector3(axis->data()), least_allowed) : std::nullopt)
      return cylinder;
    return round_surface_along(facets, Vector3::Zero(), least_allowed);
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template Tensor<1, dim>              RoundSurface::normal(const Point<dim> &) const;                                                     \
  template std::vector<Facet<dim>>     facets_of_part(const Triangulation<dim> &, types::boundary_id);                                     \
  template std::vector<Facet<dim>>     gather_facets(std::vector<Facet<dim>>, const Processes &);                                          \
  template std::optional<RoundSurface> round_surface_of(const std::vector<Facet<dim>> &, const std::optional<std::array<double, 3>> &,     \
                                                        bool);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
