#include "unilateral/equilibration/cell_split.h"

#include "unilateral/equilibration/straight_face.h"

#include <cmath>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    Tensor<1, dim> unit_normal(const std::array<Point<dim>, dim> &corners)
    {
      Tensor<1, dim> normal;
      if constexpr (dim == 2)
        normal = cross_product_2d(Tensor<1, dim>(corners[1] - corners[0]));
      else
        normal = cross_product_3d(Tensor<1, dim>(corners[1] - corners[0]), Tensor<1, dim>(corners[2] - corners[0]));
      return normal / normal.norm();
    }

    /// Where the diagonals of a convex quadrilateral meet.
    template <int dim>
    Point<dim> crossing(const Point<dim> &a, const Point<dim> &b, const Point<dim> &c, const Point<dim> &d)
    {
      const Tensor<1, dim> first = b - a, second = d - c, between = c - a;
      const double         area = first[0] * second[1] - first[1] * second[0];
      return a + (between[0] * second[1] - between[1] * second[0]) / area * first;
    }
  } // namespace

  template <int dim>
  CellSplit<dim>::CellSplit(const std::vector<Point<dim>> &corners, const bool simplex)
  {
    for (const auto &corner : corners)
      centre += corner / double(corners.size());
    if (!simplex && dim == 2)
      centre = crossing(corners[0], corners[3], corners[1], corners[2]);

    // Points of the boundary by number, those in the middle of faces last.
    std::vector<Point<dim>>                points = corners;
    std::vector<std::array<unsigned, dim>> numbers; // of the facets
    const auto                             add = [&](const unsigned face, const std::array<unsigned, dim> &own)
    {
      Facet facet;
      facet.face = face;
      for (unsigned k = 0; k < dim; ++k)
        facet.corners[k] = points[own[k]];
      facet.normal = unit_normal<dim>(facet.corners);
      if (facet.normal * (facet.corners[0] - centre) < 0)
        facet.normal *= -1.;
      facets.push_back(facet);
      numbers.push_back(own);
    };
    for (unsigned f = 0; f < (simplex ? dim + 1 : 2 * dim); ++f)
    {
      const auto                own = corners_of_face<dim>(simplex, f);
      std::array<unsigned, dim> first{};
      if (own.size() == dim)
      {
        for (unsigned k = 0; k < dim; ++k)
          first[k] = own[k];
        add(f, first);
        continue;
      }
      Point<dim> middle;
      for (const unsigned v : own)
        middle += points[v] / double(own.size());
      points.push_back(middle);
      const std::array<unsigned, 4> ring = {0, 1, 3, 2};
      for (unsigned k = 0; k < 4; ++k)
      {
        first[0] = own[ring[k]];
        first[1] = own[ring[(k + 1) % 4]];
        first[dim - 1] = points.size() - 1;
        add(f, first);
      }
    }

    // Facets that share all points but one lie next to each other.
    for (unsigned a = 0; a < facets.size(); ++a)
      for (unsigned b = 0; b < a; ++b)
      {
        InnerFacet facet;
        unsigned   n = 0;
        for (unsigned k = 0; k < dim; ++k)
          for (unsigned l = 0; l < dim; ++l)
            if (numbers[a][k] == numbers[b][l] && n + 1 < dim)
              facet.corners[n++] = points[numbers[a][k]];
        if (n + 1 < dim)
          continue;
        facet.corners[dim - 1] = centre;
        facet.parts = {a, b};
        facet.normal = unit_normal<dim>(facet.corners);
        inner.push_back(facet);
      }
  }

  template <int dim>
  std::array<Point<dim>, dim + 1> CellSplit<dim>::part(const unsigned j) const
  {
    std::array<Point<dim>, dim + 1> result;
    for (unsigned k = 0; k < dim; ++k)
      result[k] = facets[j].corners[k];
    result[dim] = centre;
    return result;
  }

  template <int dim>
  double CellSplit<dim>::volume(const unsigned j) const
  {
    const auto     corners = part(j);
    Tensor<2, dim> edges;
    for (unsigned k = 0; k < dim; ++k)
      edges[k] = corners[k + 1] - corners[0];
    return std::abs(determinant(edges)) / (dim == 2 ? 2 : 6);
  }

  template <int dim>
  std::vector<Point<dim>> points_on_facet(const std::array<Point<dim>, dim> &corners, const Quadrature<dim - 1> &rule)
  {
    std::vector<Point<dim>> points;
    for (const auto &xi : rule.get_points())
    {
      Point<dim> x = corners[0];
      for (unsigned k = 0; k + 1 < dim; ++k)
        x += xi[k] * (corners[k + 1] - corners[0]);
      points.push_back(x);
    }
    return points;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template struct CellSplit<dim>;                                                                                                          \
  template std::vector<Point<dim>> points_on_facet<dim>(const std::array<Point<dim>, dim> &, const Quadrature<dim - 1> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
