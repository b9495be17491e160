#include "unilateral/mesh/subdivided_rule.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/tensor.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// x -> origin + A x of the reference cell to one of its parts, which all have the same volume.
    template <int dim>
    struct Part
    {
      Point<dim>     origin;
      Tensor<2, dim> A;
    };

    template <int dim>
    std::vector<Part<dim>> parts(const bool simplex)
    {
      std::vector<Part<dim>> result;
      if (!simplex || dim == 1)
      {
        for (const unsigned v : GeometryInfo<dim>::vertex_indices())
        {
          Part<dim> part;
          part.origin = GeometryInfo<dim>::unit_cell_vertex(v) / 2.;
          for (unsigned d = 0; d < dim; ++d)
            part.A[d][d] = 0.5;
          result.push_back(part);
        }
        return result;
      }
      std::array<Point<dim>, dim + 1> corners;
      for (unsigned d = 0; d < dim; ++d)
        corners[d + 1][d] = 1;
      const auto middle = [&](const unsigned a, const unsigned b) { return Point<dim>((corners[a] + corners[b]) / 2.); };
      const auto add = [&](const std::array<Point<dim>, dim + 1> &vertices)
      {
        Part<dim> part;
        part.origin = vertices[0];
        for (unsigned d = 0; d < dim; ++d)
          for (unsigned i = 0; i < dim; ++i)
            part.A[i][d] = vertices[d + 1][i] - vertices[0][i];
        result.push_back(part);
      };
      for (unsigned a = 0; a <= dim; ++a)
      {
        std::array<Point<dim>, dim + 1> vertices;
        for (unsigned b = 0; b <= dim; ++b)
          vertices[b] = middle(a, b);
        add(vertices);
      }
      if constexpr (dim == 2)
        add({middle(0, 1), middle(1, 2), middle(0, 2)});
      if constexpr (dim == 3)
      {
        // The octahedron that is left, around the diagonal from the middle of 02 to that of 13.
        const std::array<Point<dim>, 4> ring = {middle(0, 1), middle(1, 2), middle(2, 3), middle(0, 3)};
        for (unsigned k = 0; k < 4; ++k)
          add({middle(0, 2), middle(1, 3), ring[k], ring[(k + 1) % 4]});
      }
      return result;
    }
  } // namespace

  template <int dim>
  Quadrature<dim> subdivided(const Quadrature<dim> &rule, const bool simplex, const unsigned times)
  {
    std::vector<Point<dim>> points = rule.get_points();
    std::vector<double>     weights = rule.get_weights();
    const auto              all_parts = parts<dim>(simplex);
    for (unsigned pass = 0; pass < times; ++pass)
    {
      std::vector<Point<dim>> finer_points;
      std::vector<double>     finer_weights;
      for (const auto &part : all_parts)
        for (std::size_t q = 0; q < points.size(); ++q)
        {
          finer_points.push_back(part.origin + part.A * points[q]);
          finer_weights.push_back(weights[q] / all_parts.size());
        }
      points.swap(finer_points);
      weights.swap(finer_weights);
    }
    return Quadrature<dim>(points, weights);
  }

  bool varies_much(const std::vector<double> &values)
  {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return *most - *least > 0.2 * std::max(std::abs(*least), std::abs(*most));
  }

  template Quadrature<1> subdivided(const Quadrature<1> &, bool, unsigned);
  template Quadrature<2> subdivided(const Quadrature<2> &, bool, unsigned);
  template Quadrature<3> subdivided(const Quadrature<3> &, bool, unsigned);
} // namespace unilateral
