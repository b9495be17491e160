#include "unilateral/spaces/cell_points.h"

#include <deal.II/fe/fe_nothing.h>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  CellPoints<dim>::CellPoints(const Mapping<dim> &mapping, const ReferenceCell cell, const std::vector<Point<dim>> &unit_points)
    : points(unit_points.size())
  {
    if (is_multilinear(mapping))
      for (const auto &point : unit_points)
      {
        auto &weights = corner_weights.emplace_back();
        for (const unsigned v : cell.vertex_indices())
          weights.push_back(cell.d_linear_shape_function(point, v));
      }
    else
    {
      no_function = std::make_unique<FE_Nothing<dim>>(cell);
      values = std::make_unique<FEValues<dim>>(mapping, *no_function, Quadrature<dim>(unit_points), update_quadrature_points);
    }
  }

  template <int dim>
  const std::vector<Point<dim>> &CellPoints<dim>::on(const typename Triangulation<dim>::cell_iterator &cell)
  {
    if (values)
    {
      values->reinit(cell);
      return values->get_quadrature_points();
    }
    std::fill(points.begin(), points.end(), Point<dim>());
    const unsigned n_corners = cell->n_vertices();
    for (unsigned v = 0; v < n_corners; ++v)
    {
      const Point<dim> &corner = cell->vertex(v);
      for (std::size_t q = 0; q < points.size(); ++q)
        points[q] += corner_weights[q][v] * corner;
    }
    return points;
  }

  template <int dim>
  CellWeights<dim>::CellWeights(const Mapping<dim>       &mapping,
                                const Triangulation<dim> &triangulation,
                                const ReferenceCell       cell,
                                const Quadrature<dim>    &rule)
    : shapes(triangulation, mapping), no_function(std::make_unique<FE_Nothing<dim>>(cell)),
      values(mapping, *no_function, rule, update_JxW_values)
  {
  }

  template <int dim>
  const std::vector<double> &CellWeights<dim>::on(const typename Triangulation<dim>::cell_iterator &cell)
  {
    const unsigned shape = shapes(cell);
    if (shape < known.size())
      return known[shape];
    values.reinit(cell);
    return shape == shapes.none ? values.get_JxW_values() : known.emplace_back(values.get_JxW_values());
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template class CellPoints<dim>;                                                                                                          \
  template class CellWeights<dim>;
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
