#include "unilateral/equilibration/straight_face.h"

#include "unilateral/equilibration/orthonormal_polynomials.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/grid/reference_cell.h>

#include <cmath>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  std::vector<unsigned> corners_of_face(const bool simplex, const unsigned face)
  {
    const ReferenceCell   cell = simplex ? ReferenceCells::get_simplex<dim>() : ReferenceCells::get_hypercube<dim>();
    std::vector<unsigned> corners;
    for (unsigned v = 0; v < (simplex ? dim : 1u << (dim - 1)); ++v)
      corners.push_back(cell.face_to_cell_vertices(face, v, 1));
    return corners;
  }

  template <int dim>
  std::vector<Point<dim>> reference_corners(const bool simplex)
  {
    std::vector<Point<dim>> corners;
    if (simplex)
    {
      corners.push_back(Point<dim>());
      for (unsigned d = 0; d < dim; ++d)
        corners.push_back(Point<dim>(Point<dim>::unit_vector(d)));
    }
    else
      for (const unsigned v : GeometryInfo<dim>::vertex_indices())
        corners.push_back(GeometryInfo<dim>::unit_cell_vertex(v));
    return corners;
  }

  template <int dim>
  StraightFace<dim>::StraightFace(const std::vector<Point<dim>> &corners, const bool simplex, const unsigned face)
  {
    const auto own = corners_of_face<dim>(simplex, face);
    origin = corners[own[0]];
    for (unsigned k = 0; k + 1 < dim; ++k)
      edges[k] = corners[own[k + 1]] - origin;
    if constexpr (dim == 2)
    {
      normal = cross_product_2d(edges[0]);
      dual[0] = edges[0] / edges[0].norm_square();
    }
    else
    {
      normal = cross_product_3d(edges[0], edges[1]);
      const double a = edges[0] * edges[0], b = edges[0] * edges[1], c = edges[1] * edges[1], determinant = a * c - b * b;
      dual[0] = (c * edges[0] - b * edges[1]) / determinant;
      dual[1] = (a * edges[1] - b * edges[0]) / determinant;
    }
    Tensor<1, dim> centre;
    for (const auto &corner : corners)
      centre += (corner - origin) / double(corners.size());
    dS = normal.norm();
    normal /= normal * centre > 0 ? -dS : dS;
  }

  namespace
  {
    template <int dim>
    std::vector<Point<dim>> corners_of(const typename Triangulation<dim>::cell_iterator &cell)
    {
      std::vector<Point<dim>> corners;
      for (const unsigned v : cell->vertex_indices())
        corners.push_back(cell->vertex(v));
      return corners;
    }
  } // namespace

  template <int dim>
  StraightFace<dim>::StraightFace(const typename Triangulation<dim>::cell_iterator &cell, const unsigned face)
    : StraightFace(corners_of<dim>(cell), cell->reference_cell().is_simplex(), face)
  {
  }

  template <int dim>
  Point<dim> StraightFace<dim>::at(const Point<dim - 1> &xi) const
  {
    Point<dim> x = origin;
    for (unsigned k = 0; k + 1 < dim; ++k)
      x += xi[k] * edges[k];
    return x;
  }

  template <int dim>
  Point<dim - 1> StraightFace<dim>::parameters(const Point<dim> &x) const
  {
    Point<dim - 1> xi;
    for (unsigned k = 0; k + 1 < dim; ++k)
      xi[k] = (x - origin) * dual[k];
    return xi;
  }

  template <int dim>
  Quadrature<dim - 1> rule_on_face(const bool simplex, const unsigned degree)
  {
    if (!simplex || dim == 2)
      return QGauss<dim - 1>(degree / 2 + 1);
    std::array<Point<dim - 1>, dim> corners;
    for (unsigned d = 0; d + 1 < dim; ++d)
      corners[d + 1][d] = 1;
    return simplex_rule<dim - 1>(corners, degree);
  }

  template <int dim>
  Quadrature<dim> on_reference_cell(const bool simplex, const unsigned face, const Quadrature<dim - 1> &rule)
  {
    const StraightFace<dim> reference(reference_corners<dim>(simplex), simplex, face);
    std::vector<Point<dim>> points;
    for (const auto &xi : rule.get_points())
      points.push_back(reference.at(xi));
    return Quadrature<dim>(points, rule.get_weights());
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::vector<unsigned>   corners_of_face<dim>(bool, unsigned);                                                                   \
  template std::vector<Point<dim>> reference_corners<dim>(bool);                                                                           \
  template struct StraightFace<dim>;                                                                                                       \
  template Quadrature<dim - 1> rule_on_face<dim>(bool, unsigned);                                                                          \
  template Quadrature<dim>     on_reference_cell<dim>(bool, unsigned, const Quadrature<dim - 1> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
