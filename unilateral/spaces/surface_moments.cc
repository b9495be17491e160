#include "unilateral/spaces/surface_moments.h"

#include <deal.II/fe/fe.h>
#include <deal.II/fe/fe_values.h>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  std::vector<SurfaceMoments<dim>> surface_moments(const Mapping<dim>                              &mapping,
                                                   const DoFHandler<dim>                           &dof_handler,
                                                   const Quadrature<dim - 1>                       &rule,
                                                   const unsigned                                   n_parts,
                                                   const std::function<double(const Point<dim> &)> &measure,
                                                   const Processes                                 &processes)
  {
    std::vector<SurfaceMoments<dim>> result(n_parts);
    FEFaceValues<dim>                values(mapping, dof_handler.get_fe(), rule, update_quadrature_points | update_JxW_values);
    const auto                       for_each_point = [&](const auto &visit)
    {
      for (const auto &cell : dof_handler.active_cell_iterators())
        for (const auto face : cell->face_indices())
          if (cell->at_boundary(face) && cell->face(face)->boundary_id() < n_parts)
          {
            values.reinit(cell, face);
            for (const unsigned q : values.quadrature_point_indices())
            {
              const Point<dim> &x = values.quadrature_point(q);
              visit(result[cell->face(face)->boundary_id()], x, values.JxW(q) * measure(x));
            }
          }
    };
    for_each_point(
      [](SurfaceMoments<dim> &part, const Point<dim> &x, const double w)
      {
        part.measure += w;
        part.centroid += w * x;
      });
    for (auto &part : result)
    {
      part.measure = processes.sum(part.measure);
      for (unsigned d = 0; d < dim; ++d)
        part.centroid[d] = processes.sum(part.centroid[d]) / (part.measure > 0 ? part.measure : 1.);
    }
    // About the centroid: those about the origin would cancel for a small part far from it.
    for_each_point([](SurfaceMoments<dim> &part, const Point<dim> &x, const double w)
                   { part.second += w * symmetrize(outer_product(x - part.centroid, x - part.centroid)); });
    for (auto &part : result)
      for (unsigned d = 0; d < dim; ++d)
        for (unsigned e = 0; e <= d; ++e)
          part.second[d][e] = processes.sum(part.second[d][e]);
    return result;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::vector<SurfaceMoments<dim>> surface_moments(const Mapping<dim> &, const DoFHandler<dim> &, const Quadrature<dim - 1> &,    \
                                                            unsigned, const std::function<double(const Point<dim> &)> &,                   \
                                                            const Processes &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
