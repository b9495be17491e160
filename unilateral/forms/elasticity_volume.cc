// What changes of volume cost in an elastic body: where they are averaged at vertices, projected cell by cell, or neither.
#include "unilateral/algebra/dense_solvers.h"
#include "unilateral/forms/elasticity.h"

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  std::vector<typename Elasticity<dim>::Moduli> Elasticity<dim>::moduli_at_points(const FEValues<dim> &values, bool &projected) const
  {
    std::vector<Moduli> at;
    const auto         &material = regions[values.get_cell()->material_id()];
    projected = false;
    for (const Point<dim> &x : values.get_quadrature_points())
    {
      at.push_back(moduli(material, x));
      projected |= at.back().projected;
    }
    return at;
  }

  /// Materials that get thinner as they are pressed together, nu < 0, have a lambda < 0, and no C.
  template <int dim>
  bool Elasticity<dim>::has_stiff_volume(const std::vector<Moduli> &at)
  {
    return std::all_of(at.begin(), at.end(), [](const Moduli &moduli) { return moduli.lambda > 0; });
  }

  template <int dim>
  void Elasticity<dim>::divergences(const FEValues<dim> &values, const bool projected, FullMatrix<double> &result) const
  {
    const auto    &fe = values.get_fe();
    const bool     axisymmetric = dim == 2 && assumption == ModelChoices::Assumption::axisymmetric;
    const unsigned n = values.dofs_per_cell, n_q = values.n_quadrature_points;
    result.reinit(n_q, n);
    for (const unsigned q : values.quadrature_point_indices())
      for (unsigned i = 0; i < n; ++i)
      {
        const unsigned c = fe.system_to_component_index(i).first;
        result(q, i) = values.shape_grad(i, q)[c];
        if (axisymmetric && c == 0)
          result(q, i) += values.shape_value(i, q) / values.quadrature_point(q)[0];
      }
    if (!projected)
      return;
    const auto [polynomials, coefficients] = project(values, result);
    polynomials.mmult(result, coefficients);
  }

  /// Onto the polynomials of degree p - 1 in each coordinate of the reference cell, by powers about its centre.
  template <int dim>
  typename Elasticity<dim>::ProjectedDivergence Elasticity<dim>::project(const FEValues<dim>      &values,
                                                                         const FullMatrix<double> &divergence) const
  {
    const unsigned p = values.get_fe().degree, n = values.dofs_per_cell, n_q = values.n_quadrature_points;
    unsigned       n_p = 1;
    for (unsigned d = 0; d < dim; ++d)
      n_p *= p;
    FullMatrix<double> polynomials(n_q, n_p), weighted(n_q, n_p), mass(n_p, n_p), moments(n_p, n), coefficients(n_p, n);
    for (unsigned q = 0; q < n_q; ++q)
    {
      const double w = values.JxW(q) * measure(values.quadrature_point(q));
      for (unsigned k = 0; k < n_p; ++k)
      {
        double value = 1;
        for (unsigned d = 0, index = k; d < dim; ++d, index /= p)
          value *= std::pow(2 * values.get_quadrature().point(q)[d] - 1, index % p);
        polynomials(q, k) = value;
        weighted(q, k) = w * value;
      }
    }
    polynomials.Tmmult(mass, weighted);
    weighted.Tmmult(moments, divergence);
    mass.gauss_jordan();
    mass.mmult(coefficients, moments);
    return {polynomials, coefficients};
  }

  template <int dim>
  bool Elasticity<dim>::averages_volume_in(const types::material_id region) const
  {
    if (!simplex || degree > 2 || (dim == 2 && assumption == ModelChoices::Assumption::plane_stress) ||
        integration == ModelChoices::Integration::full)
      return false;
    const auto &poisson = regions[region].poisson;
    return integration == ModelChoices::Integration::reduced ||
           (poisson.is_constant() && poisson.value(Point<dim>()) > largest_locking_free_ratio);
  }

  template <int dim>
  double Elasticity<dim>::volume_modulus(const types::material_id region, const Point<dim> &x) const
  {
    const double E = regions[region].young.value(x), nu = regions[region].poisson.value(x);
    return E * nu / ((1 + nu) * (1 - 2 * nu));
  }

  template <int dim>
  void Elasticity<dim>::volume_changes(const FEValues<dim> &values, FullMatrix<double> &divergence) const
  {
    divergences(values, false, divergence);
  }

  template <int dim>
  bool Elasticity<dim>::projects_volume() const
  {
    if (simplex || (dim == 2 && assumption == ModelChoices::Assumption::plane_stress) || integration == ModelChoices::Integration::full)
      return false;
    const auto may_be_projected = [](const Material &material)
    { return !material.poisson.is_constant() || material.poisson.value(Point<dim>()) > largest_locking_free_ratio; };
    return integration == ModelChoices::Integration::reduced || std::any_of(regions.begin(), regions.end(), may_be_projected);
  }

  /// With the coefficients c of the projection and G = int lambda P_k P_l = L L' it is C = L' c: |C u|^2 = int lambda (Pi div u)^2.
  template <int dim>
  bool Elasticity<dim>::volume_rows(const FEValues<dim> &values, FullMatrix<double> &rows) const
  {
    bool       projected = false;
    const auto at = moduli_at_points(values, projected);
    if (!projected || !has_stiff_volume(at))
      return false;
    FullMatrix<double> divergence;
    divergences(values, false, divergence);
    const auto [polynomials, coefficients] = project(values, divergence);
    const unsigned  n_p = polynomials.n(), n = values.dofs_per_cell;
    Eigen::MatrixXd P(values.n_quadrature_points, n_p), c(n_p, n);
    Eigen::VectorXd lambda_w(values.n_quadrature_points);
    for (const unsigned q : values.quadrature_point_indices())
    {
      lambda_w(q) = at[q].lambda * values.JxW(q) * measure(values.quadrature_point(q));
      for (unsigned k = 0; k < n_p; ++k)
        P(q, k) = polynomials(q, k);
    }
    for (unsigned k = 0; k < n_p; ++k)
      for (unsigned i = 0; i < n; ++i)
        c(k, i) = coefficients(k, i);
    const Eigen::MatrixXd G = P.transpose() * (lambda_w.asDiagonal() * P);
    const Eigen::MatrixXd L = G.llt().matrixL(), C = L.transpose() * c;
    rows.reinit(n_p, n);
    for (unsigned k = 0; k < n_p; ++k)
      for (unsigned i = 0; i < n; ++i)
        rows(k, i) = C(k, i);
    return true;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::vector<Elasticity<dim>::Moduli> Elasticity<dim>::moduli_at_points(const FEValues<dim> &, bool &) const;                    \
  template bool                                 Elasticity<dim>::has_stiff_volume(const std::vector<Moduli> &);                            \
  template void                                 Elasticity<dim>::divergences(const FEValues<dim> &, bool, FullMatrix<double> &) const;     \
  template bool                                 Elasticity<dim>::averages_volume_in(types::material_id) const;                             \
  template double                               Elasticity<dim>::volume_modulus(types::material_id, const Point<dim> &) const;             \
  template void                                 Elasticity<dim>::volume_changes(const FEValues<dim> &, FullMatrix<double> &) const;        \
  template bool                                 Elasticity<dim>::projects_volume() const;                                                  \
  template bool                                 Elasticity<dim>::volume_rows(const FEValues<dim> &, FullMatrix<double> &) const;
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
