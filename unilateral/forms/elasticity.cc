#include "unilateral/forms/elasticity.h"

#include <deal.II/base/numbers.h>

#include <Eigen/Eigenvalues>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  double von_mises(const Stress &s)
  {
    const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
    return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
  }

  std::array<double, 3> principal_stresses(const Stress &s)
  {
    Eigen::Matrix3d matrix;
    matrix << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
    const Eigen::Vector3d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
    return {values(2), values(1), values(0)};
  }

  template <int dim>
  Elasticity<dim>::Elasticity(const Model                      &model,
                              const std::vector<Coefficients>  &coefficients,
                              const std::vector<std::string>   &region_names,
                              const std::vector<PartCondition> &conditions,
                              Diagnostics                      &diagnostics)
    : assumption(model.assumption), integration(model.integration), simplex(model.element.simplex()), degree(model.element.degree)
  {
    for (std::size_t r = 0; r < coefficients.size(); ++r)
    {
      const auto &given = coefficients[r];
      if (!given.young || !given.poisson)
        diagnostics.error(model.where,
                          fmt::format("region '{}' has no {}; give 'young' and 'poisson' in [model] or in a [[material]]", region_names[r],
                                      given.young ? "Poisson's ratio" : "Young's modulus"),
                          MessageName("missing-key"));
      regions.push_back({given.young.value_or(0.), given.poisson.value_or(0.), given.load.value_or(std::vector<FieldFunction>())});
      const auto &poisson = regions.back().poisson;
      if (!poisson.is_constant() || poisson.value(Point<dim>()) <= largest_locking_free_ratio ||
          assumption == ModelChoices::Assumption::plane_stress)
        continue;
      if (integration == ModelChoices::Integration::full && model.element.degree < 3)
        diagnostics.warning(poisson.where(),
                            fmt::format("nu = {} in region '{}': full integration locks where a material is nearly "
                                        "incompressible; integration = \"auto\" does not",
                                        poisson.value(Point<dim>()), region_names[r]),
                            MessageName("locking"));
    }
    for (const auto &given : conditions)
    {
      for (const auto &component : given.traction)
        if (given.traction_is_total && !component.is_constant())
          diagnostics.error(component.where(),
                            fmt::format("the total force on '{}' must be constant; a load that varies is a 'traction'", given.part),
                            MessageName("contradiction"));
      for (const auto &component : given.moments)
        if (!component.is_constant())
          diagnostics.error(component.where(), fmt::format("the moment on '{}' must be constant", given.part),
                            MessageName("contradiction"));
      parts.push_back({.traction = given.traction,
                       .pressure = given.pressure.value_or(0.),
                       .springs = given.springs,
                       .traction_is_total = given.traction_is_total,
                       .moments = given.moments,
                       .about = given.about,
                       .part = given.part,
                       .where = given.where,
                       .spin = {},
                       .centroid = {}});
      if (parts.back().has_moment() && (dim == 1 || (dim == 2 && assumption == ModelChoices::Assumption::axisymmetric)))
        diagnostics.error(given.where,
                          fmt::format("no moment can act on '{}': {}", given.part,
                                      dim == 1 ? "a 1-D body does not turn" : "it would turn with the body around the axis, and cancel"),
                          MessageName("kind-does-not-fit"));
    }
  }

  template <int dim>
  double Elasticity<dim>::measure(const Point<dim> &x) const
  {
    return dim == 2 && assumption == ModelChoices::Assumption::axisymmetric ? 2 * numbers::PI * x[0] : 1;
  }

  template <int dim>
  typename Elasticity<dim>::Moduli Elasticity<dim>::moduli(const Material &material, const Point<dim> &x) const
  {
    const double E = material.young.value(x), nu = material.poisson.value(x);
    if (!(E > 0))
      throw InputError(material.young.where(), fmt::format("Young's modulus must be positive, it is {} at a point of the mesh", E),
                       MessageName("out-of-range"));
    if (!(nu > -1 && nu < 0.5))
      throw InputError(material.poisson.where(),
                       fmt::format("Poisson's ratio must lie between -1 and 1/2, it is {} at a point of the mesh", nu),
                       MessageName("out-of-range"));
    const bool plane_stress = dim == 2 && assumption == ModelChoices::Assumption::plane_stress;
    if (averages_volume_in(&material - regions.data()))
      return {0, E / (2 * (1 + nu)), false};
    return {plane_stress ? E * nu / (1 - nu * nu) : E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu)),
            !simplex && !plane_stress &&
              (integration == ModelChoices::Integration::reduced ||
               (integration == ModelChoices::Integration::automatic && nu > largest_locking_free_ratio))};
  }

  template <int dim>
  void Elasticity<dim>::prepare(const types::material_id region, const std::vector<Point<dim>> &points) const
  {
    regions[region].young.prepare(points);
    regions[region].poisson.prepare(points);
  }

  template <int dim>
  bool Elasticity<dim>::uniform_in(const types::material_id region) const
  {
    const auto constant = [](const FieldFunction &f) { return f.is_constant(); };
    const auto &[young, poisson, load] = regions[region];
    return assumption != ModelChoices::Assumption::axisymmetric && constant(young) && constant(poisson) && !averages_volume_in(region);
  }

  template <int dim>
  bool Elasticity<dim>::load_uniform_in(const types::material_id region) const
  {
    return std::all_of(regions[region].load.begin(), regions[region].load.end(), [](const FieldFunction &f) { return f.is_constant(); });
  }

  template <int dim>
  void Elasticity<dim>::load_density(const unsigned                 component,
                                     const types::material_id       region,
                                     const std::vector<Point<dim>> &points,
                                     std::vector<double>           &at) const
  {
    if (regions[region].load.empty())
      at.assign(points.size(), 0.);
    else
      regions[region].load[component].values(points, at);
  }

  template <int dim>
  double Elasticity<dim>::volume_to_shape_stiffness() const
  {
    double largest = 0;
    if (assumption != ModelChoices::Assumption::plane_stress)
      for (const Material &material : regions)
        if (material.poisson.is_constant())
          if (const double nu = material.poisson.value(Point<dim>()); nu < 0.5)
            largest = std::max(largest, 2 * nu / (1 - 2 * nu));
    return largest;
  }

  template <int dim>
  void Elasticity<dim>::add_cell_terms(const FEValues<dim> &values, FullMatrix<double> &matrix, dealii::Vector<double> &load) const
  {
    add_cell_terms(values, /*with_volume=*/true, matrix, load);
  }

  template <int dim>
  void
  Elasticity<dim>::add_cell_terms_but_volume(const FEValues<dim> &values, FullMatrix<double> &matrix, dealii::Vector<double> &load) const
  {
    add_cell_terms(values, /*with_volume=*/false, matrix, load);
  }

  /// @p with_volume: where volume_rows() has rows.
  template <int dim>
  void Elasticity<dim>::add_cell_terms(const FEValues<dim>    &values,
                                       const bool              with_volume,
                                       FullMatrix<double>     &matrix,
                                       dealii::Vector<double> &load) const
  {
    const auto    &fe = values.get_fe();
    const bool     axisymmetric = dim == 2 && assumption == ModelChoices::Assumption::axisymmetric;
    const unsigned n = values.dofs_per_cell, n_shapes = n / dim;

    std::vector<unsigned> component(n), index(n); // index: of the unknown with the same shape function and component 0
    for (unsigned i = 0; i < n; ++i)
    {
      component[i] = fe.system_to_component_index(i).first;
      index[i] = fe.system_to_component_index(i).second;
    }
    std::vector<unsigned> unknown(n);
    for (unsigned i = 0; i < n; ++i)
      unknown[index[i] * dim + component[i]] = i;

    bool                      projected = false;
    const std::vector<Moduli> at = moduli_at_points(values, projected);
    const bool                but_volume = !with_volume && projected && has_stiff_volume(at);
    FullMatrix<double>        divergence;
    divergences(values, projected, divergence);

    // Products of gradients and of divergences, summed over the points as products of matrices.
    const unsigned  n_q = values.n_quadrature_points;
    Eigen::MatrixXd gradients(n_q, n), of_divergences(n_q, n);
    Eigen::VectorXd mu_w(n_q), lambda_w(n_q);
    for (unsigned q = 0; q < n_q; ++q)
    {
      const double w = values.JxW(q) * measure(values.quadrature_point(q));
      mu_w(q) = at[q].mu * w;
      lambda_w(q) = but_volume ? 0. : at[q].lambda * w;
      for (unsigned k = 0; k < n_shapes; ++k)
      {
        const Tensor<1, dim> &gradient = values.shape_grad(unknown[k * dim], q);
        for (unsigned d = 0; d < dim; ++d)
          gradients(q, k * dim + d) = gradient[d];
      }
      for (unsigned i = 0; i < n; ++i)
        of_divergences(q, i) = divergence(q, i);
    }
    const Eigen::MatrixXd products = gradients.transpose() * (mu_w.asDiagonal() * gradients),
                          volumetric = of_divergences.transpose() * (lambda_w.asDiagonal() * of_divergences);

    // 2 mu epsilon(u) : epsilon(v) = mu (grad u : grad v + grad u : grad v'), shape function by shape function.
    for (unsigned l = 0; l < n_shapes; ++l)
      for (unsigned k = 0; k < n_shapes; ++k)
      {
        double product = 0;
        for (unsigned d = 0; d < dim; ++d)
          product += products(k * dim + d, l * dim + d);
        for (unsigned c = 0; c < dim; ++c)
        {
          const unsigned i = unknown[k * dim + c];
          matrix(i, unknown[l * dim + c]) += product;
          for (unsigned d = 0; d < dim; ++d)
          {
            const unsigned j = unknown[l * dim + d];
            matrix(i, j) += products(k * dim + d, l * dim + c) + volumetric(i, j);
          }
        }
      }
    for (unsigned q = 0; q < n_q && axisymmetric; ++q)
    {
      const double r = values.quadrature_point(q)[0];
      for (unsigned k = 0; k < n_shapes; ++k)
        for (unsigned l = 0; l < n_shapes; ++l)
          matrix(unknown[k * dim], unknown[l * dim]) +=
            2 * mu_w(q) * values.shape_value(unknown[k * dim], q) * values.shape_value(unknown[l * dim], q) / (r * r);
    }
    add_cell_load(values, load);
  }

  template <int dim>
  void Elasticity<dim>::add_cell_load(const FEValues<dim> &values, dealii::Vector<double> &load) const
  {
    const auto &density = regions[values.get_cell()->material_id()].load;
    if (density.empty())
      return;
    for (const unsigned q : values.quadrature_point_indices())
    {
      const Point<dim>       &x = values.quadrature_point(q);
      const double            w = values.JxW(q) * measure(x);
      std::array<double, dim> f;
      for (unsigned c = 0; c < dim; ++c)
        f[c] = density[c].value(x) * w;
      for (unsigned i = 0; i < values.dofs_per_cell; ++i)
        load(i) += f[values.get_fe().system_to_component_index(i).first] * values.shape_value(i, q);
    }
  }

  template <int dim>
  void Elasticity<dim>::add_gram_terms(const FEValues<dim> &values, FullMatrix<double> &matrix) const
  {
    const auto  &fe = values.get_fe();
    const bool   axisymmetric = dim == 2 && assumption == ModelChoices::Assumption::axisymmetric;
    const double l = this->unit_of_length;
    for (const unsigned q : values.quadrature_point_indices())
    {
      const Point<dim> &x = values.quadrature_point(q);
      const double      w = values.JxW(q) * measure(x);
      for (unsigned i = 0; i < values.dofs_per_cell; ++i)
        for (unsigned j = 0; j < values.dofs_per_cell; ++j)
        {
          const unsigned c = fe.system_to_component_index(i).first;
          if (c != fe.system_to_component_index(j).first)
            continue;
          const double product = values.shape_value(i, q) * values.shape_value(j, q);
          matrix(i, j) += (values.shape_grad(i, q) * values.shape_grad(j, q) + product / (l * l)) * w;
          if (axisymmetric && c == 0) // the gradient in space has u_r / r along the hoop
            matrix(i, j) += product / (x[0] * x[0]) * w;
        }
    }
  }

  template <int dim>
  void Elasticity<dim>::flux(const FEValues<dim> &values, const dealii::Vector<double> &u, std::vector<Flux> &stress) const
  {
    const auto               &fe = values.get_fe();
    bool                      projected = false;
    const std::vector<Moduli> at = moduli_at_points(values, projected);
    FullMatrix<double>        divergence;
    divergences(values, projected, divergence);

    stress.assign(values.n_quadrature_points, Flux{});
    for (const unsigned q : values.quadrature_point_indices())
    {
      const Point<dim> &x = values.quadrature_point(q);
      Tensor<2, dim>    gradient;
      double            div_u = 0, u_r = 0;
      for (unsigned i = 0; i < values.dofs_per_cell; ++i)
      {
        const unsigned c = fe.system_to_component_index(i).first;
        gradient[c] += u(i) * values.shape_grad(i, q);
        div_u += u(i) * divergence(q, i);
        if (c == 0)
          u_r += u(i) * values.shape_value(i, q);
      }
      const double volumetric = at[q].lambda * div_u, mu = at[q].mu;
      for (unsigned d = 0; d < dim; ++d)
        stress[q][d] = volumetric + 2 * mu * gradient[d][d];
      if (dim == 2)
        switch (assumption)
        {
        case ModelChoices::Assumption::plane_strain:
          stress[q][2] = volumetric;
          break;
        case ModelChoices::Assumption::plane_stress:
          stress[q][2] = 0;
          break;
        case ModelChoices::Assumption::axisymmetric:
          stress[q][2] = volumetric + 2 * mu * u_r / x[0];
          break;
        }
      stress[q][3] = mu * (gradient[0][1 % dim] + gradient[1 % dim][0]);
      if (dim == 3)
      {
        stress[q][4] = mu * (gradient[0][2 % dim] + gradient[2 % dim][0]);
        stress[q][5] = mu * (gradient[1 % dim][2 % dim] + gradient[2 % dim][1 % dim]);
      }
    }
  }

  template <int dim>
  double Elasticity<dim>::flux_energy(const Flux &s, const types::material_id region, const Point<dim> &x) const
  {
    const double E = regions[region].young.value(x), nu = regions[region].poisson.value(x), trace = s[0] + s[1] + s[2];
    return ((1 + nu) * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + 2 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5])) - nu * trace * trace) / E;
  }

  template <int dim>
  std::vector<RigidBodyMode<dim>> Elasticity<dim>::rigid_body_modes(const Point<dim> &centre) const
  {
    std::vector<RigidBodyMode<dim>> result;
    for (unsigned c = 0; c < dim; ++c)
    {
      Tensor<1, dim> unit;
      unit[c] = 1;
      if (dim == 2 && assumption == ModelChoices::Assumption::axisymmetric && c == 0)
        continue;
      result.push_back({fmt::format("translation along {}", "xyz"[c]), [unit](const Point<dim> &) { return unit; }});
    }
    if (dim == 1 || (dim == 2 && assumption == ModelChoices::Assumption::axisymmetric))
      return result;
    const auto rotation = [&](const unsigned a, const unsigned b, const std::string &name)
    {
      result.push_back({name, [centre, a, b](const Point<dim> &x)
                        {
                          Tensor<1, dim> v;
                          v[a] = -(x[b] - centre[b]);
                          v[b] = x[a] - centre[a];
                          return v;
                        }});
    };
    if (dim == 2)
      rotation(0, 1, "rotation in the plane");
    else
    {
      rotation(1, 2, "rotation about x");
      rotation(2, 0, "rotation about y");
      rotation(0, 1, "rotation about z");
    }
    return result;
  }

  template <int dim>
  std::pair<double, SourceLocation> Elasticity<dim>::load_samples() const
  {
    for (const auto &material : regions)
      for (const auto &component : material.load)
        if (component.sample_spacing() > 0)
          return {component.sample_spacing(), component.where()};
    return {0, {}};
  }

  template <int dim>
  typename Elasticity<dim>::LameParameters Elasticity<dim>::lame_parameters(const types::material_id region, const Point<dim> &x) const
  {
    const auto [lambda, mu, projected] = moduli(regions[region], x);
    const bool averaged = averages_volume_in(region);
    return {averaged ? volume_modulus(region, x) : lambda, mu, projected || averaged};
  }

  template <int dim>
  void Elasticity<dim>::load_densities(const types::material_id       region,
                                       const std::vector<Point<dim>> &points,
                                       std::vector<Tensor<1, dim>>   &load) const
  {
    load.assign(points.size(), Tensor<1, dim>());
    std::vector<double> component;
    for (unsigned d = 0; d < dim && !regions[region].load.empty(); ++d)
    {
      regions[region].load[d].values(points, component);
      for (std::size_t q = 0; q < points.size(); ++q)
        load[q][d] = component[q];
    }
  }

  template <int dim>
  Tensor<1, dim> Elasticity<dim>::surface_load(const types::boundary_id part, const Point<dim> &x, const Tensor<1, dim> &normal) const
  {
    const auto    &terms = parts[part];
    Tensor<1, dim> load = -terms.pressure.value(x) * normal;
    for (unsigned c = 0; c < terms.traction.size(); ++c)
      load[c] += terms.share * terms.traction[c].value(x);
    if (terms.has_moment())
      load += terms.spin * (x - terms.centroid);
    return load;
  }

  template <int dim>
  Tensor<1, dim> Elasticity<dim>::springs(const types::boundary_id part, const Point<dim> &x) const
  {
    const auto    &given = parts[part].springs;
    Tensor<1, dim> stiffness;
    for (unsigned c = 0; c < dim && !given.empty(); ++c)
      stiffness[c] = given[given.size() == 1 ? 0 : c].value(x);
    return stiffness;
  }

#define INSTANTIATE(dim) template class Elasticity<dim>;
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
