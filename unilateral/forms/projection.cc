#include "unilateral/forms/projection.h"

#include <fmt/format.h>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  Projection<dim>::Projection(const std::vector<Coefficients> &coefficients)
  {
    for (const auto &given : coefficients)
      regions.push_back({first_or(given.stiffness, 1.), first_or(given.load, 0.)});
  }

  template <int dim>
  double Projection<dim>::alpha(const Region &region, const Point<dim> &x) const
  {
    const double value = region.alpha.value(x);
    if (!(value > 0))
      throw InputError(region.alpha.where(), fmt::format("'stiffness' must be positive, it is {} at a point of the mesh", value),
                       MessageName("out-of-range"));
    return value;
  }

  template <int dim>
  void Projection<dim>::add_cell_terms(const FEValues<dim> &values, FullMatrix<double> &matrix, dealii::Vector<double> &load) const
  {
    const Region &region = regions[values.get_cell()->material_id()];
    for (const unsigned q : values.quadrature_point_indices())
    {
      const Point<dim> &x = values.quadrature_point(q);
      const double      a = alpha(region, x) * values.JxW(q), f = region.load.value(x) * values.JxW(q);
      for (unsigned i = 0; i < values.dofs_per_cell; ++i)
        if (const double phi = values.shape_value(i, q); phi != 0)
        {
          load(i) += f * phi;
          for (unsigned j = 0; j < values.dofs_per_cell; ++j)
            matrix(i, j) += a * phi * values.shape_value(j, q);
        }
    }
  }

  template <int dim>
  void Projection<dim>::add_gram_terms(const FEValues<dim> &values, FullMatrix<double> &matrix) const
  {
    for (const unsigned q : values.quadrature_point_indices())
      for (unsigned i = 0; i < values.dofs_per_cell; ++i)
        for (unsigned j = 0; j < values.dofs_per_cell; ++j)
          matrix(i, j) += values.shape_value(i, q) * values.shape_value(j, q) * values.JxW(q);
  }

  template <int dim>
  void Projection<dim>::flux(const FEValues<dim> &values, const dealii::Vector<double> &u, std::vector<Flux> &at) const
  {
    at.assign(values.n_quadrature_points, Flux{});
    for (const unsigned q : values.quadrature_point_indices())
      for (unsigned i = 0; i < values.dofs_per_cell; ++i)
        at[q][0] += alpha(regions[values.get_cell()->material_id()], values.quadrature_point(q)) * u(i) * values.shape_value(i, q);
  }

  template <int dim>
  double Projection<dim>::flux_energy(const Flux &flux, const types::material_id region, const Point<dim> &x) const
  {
    return flux[0] * flux[0] / alpha(regions[region], x);
  }

  template <int dim>
  std::pair<double, SourceLocation> Projection<dim>::load_samples() const
  {
    for (const auto &region : regions)
      if (region.load.sample_spacing() > 0)
        return {region.load.sample_spacing(), region.load.where()};
    return {0, {}};
  }

#define INSTANTIATE(dim) template class Projection<dim>;
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
