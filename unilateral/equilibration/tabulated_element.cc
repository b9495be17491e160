#include "unilateral/equilibration/tabulated_element.h"

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    Tensor<1, dim> barycentric_gradient(const unsigned v)
    {
      Tensor<1, dim> gradient;
      for (unsigned d = 0; d < dim; ++d)
        gradient[d] = v == 0 ? -1 : v == d + 1 ? 1 : 0;
      return gradient;
    }
  } // namespace

  template <int dim>
  TabulatedElement<dim>::TabulatedElement(const FiniteElement<dim> &fe, const Quadrature<dim> &rule)
    : points(rule.get_points()), weights(rule.get_weights())
  {
    const unsigned n = fe.n_dofs_per_cell(), n_q = points.size();
    const auto     reference = fe.reference_cell();
    const unsigned n_vertices = reference.n_vertices();
    values.resize(n_q, n);
    vertex_values.resize(n_q, n_vertices);
    for (unsigned d = 0; d < dim; ++d)
    {
      gradients[d].resize(n_q, n);
      vertex_gradients[d].resize(n_q, n_vertices);
    }
    for (unsigned q = 0; q < n_q; ++q)
    {
      for (unsigned i = 0; i < n; ++i)
      {
        values(q, i) = fe.shape_value(i, points[q]);
        const Tensor<1, dim> gradient = fe.shape_grad(i, points[q]);
        for (unsigned d = 0; d < dim; ++d)
          gradients[d](q, i) = gradient[d];
      }
      for (unsigned v = 0; v < n_vertices; ++v)
      {
        const bool simplex = dim > 1 && reference.is_simplex();
        vertex_values(q, v) = reference.template d_linear_shape_function<dim>(points[q], v);
        const Tensor<1, dim> gradient =
          simplex ? barycentric_gradient<dim>(v) : GeometryInfo<dim>::d_linear_shape_function_gradient(points[q], v);
        for (unsigned d = 0; d < dim; ++d)
          vertex_gradients[d](q, v) = gradient[d];
      }
    }
  }

  template <int dim>
  StraightCell<dim>::StraightCell(const Cell &cell) : simplex(cell->reference_cell().is_simplex() && dim > 1)
  {
    for (const unsigned v : cell->vertex_indices())
      vertices.push_back(cell->vertex(v));
  }

  template <int dim>
  double StraightCell<dim>::diameter() const
  {
    double largest = 0;
    for (std::size_t a = 0; a < vertices.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        largest = std::max(largest, vertices[a].distance(vertices[b]));
    return largest;
  }

  template <int dim>
  bool StraightCell<dim>::affine() const
  {
    if (simplex || dim == 1)
      return true;
    // Vertex v of a parallelepiped is the first one plus an edge for each bit of v.
    const double tolerance = 1e-12 * diameter();
    for (unsigned v = 0; v < vertices.size(); ++v)
    {
      Point<dim> expected = vertices[0];
      for (unsigned d = 0; d < dim; ++d)
        if (v >> d & 1)
          expected += vertices[1u << d] - vertices[0];
      if (expected.distance(vertices[v]) > tolerance)
        return false;
    }
    return true;
  }

  template <int dim>
  Tensor<2, dim> StraightCell<dim>::jacobian_of_affine() const
  {
    Tensor<2, dim> jacobian;
    for (unsigned j = 0; j < dim; ++j)
    {
      const Tensor<1, dim> edge = vertices[simplex ? j + 1 : 1u << j] - vertices[0];
      for (unsigned i = 0; i < dim; ++i)
        jacobian[i][j] = edge[i];
    }
    return jacobian;
  }

  template <int dim>
  double StraightCell<dim>::positive_determinant(const Tensor<2, dim> &jacobian) const
  {
    // Vertices of simplices may be numbered either way round: flux through faces and divergence do not depend on it.
    const double value = simplex ? std::abs(determinant(jacobian)) : determinant(jacobian);
    if (!(value > 0))
      throw std::domain_error("a cell is folded");
    return value;
  }

  template <int dim>
  typename StraightCell<dim>::AtPoints StraightCell<dim>::at(const TabulatedElement<dim> &tabulated) const
  {
    const unsigned n = tabulated.size();
    AtPoints       result;
    if (affine())
    {
      const Tensor<2, dim> jacobian = jacobian_of_affine();
      result.x.reserve(n);
      for (const Point<dim> &x : tabulated.points)
        result.x.push_back(vertices[0] + jacobian * Tensor<1, dim>(x));
      result.determinant.assign(n, positive_determinant(jacobian));
      result.inverse.assign(n, invert(jacobian));
      result.jacobian.assign(n, jacobian);
      return result;
    }
    result = {std::vector<Point<dim>>(n), std::vector<Tensor<2, dim>>(n), std::vector<Tensor<2, dim>>(n), std::vector<double>(n)};
    for (unsigned q = 0; q < n; ++q)
    {
      for (unsigned v = 0; v < vertices.size(); ++v)
        for (unsigned i = 0; i < dim; ++i)
        {
          result.x[q][i] += tabulated.vertex_values(q, v) * vertices[v][i];
          for (unsigned j = 0; j < dim; ++j)
            result.jacobian[q][i][j] += tabulated.vertex_gradients[j](q, v) * vertices[v][i];
        }
      result.determinant[q] = positive_determinant(result.jacobian[q]);
      result.inverse[q] = invert(result.jacobian[q]);
    }
    return result;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template struct TabulatedElement<dim>;                                                                                                   \
  template class StraightCell<dim>;
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
