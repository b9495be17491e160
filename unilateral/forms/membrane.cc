#include "unilateral/forms/membrane.h"
#include "unilateral/forms/spring.h"

#include <fmt/format.h>

#include <Eigen/Core>

#include <algorithm>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  Tensor<2, dim> MembraneCoefficients<dim>::stiffness_tensor(const Point<dim> &p) const
  {
    Tensor<2, dim> k;
    if (stiffness.size() == 1)
    {
      const double value = stiffness[0].value(p);
      for (unsigned d = 0; d < dim; ++d)
        k[d][d] = value;
      return k;
    }
    unsigned entry = 0;
    for (unsigned i = 0; i < dim; ++i)
      for (unsigned j = i; j < dim; ++j, ++entry)
        k[i][j] = k[j][i] = stiffness[entry].value(p);
    return k;
  }

  template <int dim>
  Tensor<1, dim> MembraneCoefficients<dim>::velocity_vector(const Point<dim> &p) const
  {
    Tensor<1, dim> b;
    for (unsigned d = 0; d < velocity.size(); ++d)
      b[d] = velocity[d].value(p);
    return b;
  }

  template <int dim>
  bool MembraneCoefficients<dim>::symmetric() const
  {
    return std::all_of(velocity.begin(), velocity.end(), [](const FieldFunction &component) { return component.is_zero(); });
  }

  template <int dim>
  Membrane<dim>::Membrane(const std::vector<Coefficients> &coefficients, const std::vector<PartCondition> &conditions)
  {
    for (const auto &given : coefficients)
      regions.push_back({given.stiffness.value_or(std::vector<FieldFunction>{FieldFunction(1.)}),
                         given.velocity.value_or(std::vector<FieldFunction>()), given.reaction.value_or(0.), first_or(given.load, 0.)});
    // Where the value is prescribed, flux and spring have no say.
    for (const auto &given : conditions)
      parts.push_back(given.value ? FaceTerms{} : FaceTerms{given.flux.value_or(0.), given.spring.value_or(0.)});
  }

  template <int dim>
  bool Membrane<dim>::symmetric() const
  {
    return std::all_of(regions.begin(), regions.end(), [](const auto &coefficients) { return coefficients.symmetric(); });
  }

  template <int dim>
  void Membrane<dim>::add_cell_terms(const FEValues<dim> &values, FullMatrix<double> &matrix, dealii::Vector<double> &load) const
  {
    const auto    &coefficients = regions[values.get_cell()->material_id()];
    const unsigned n = values.dofs_per_cell, n_q = values.n_quadrature_points;
    const auto    &points = values.get_quadrature_points();

    // Rows: quadrature points, and directions; columns: shape functions. The sums over points are products of such matrices.
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::Map<RowMajor> a(&matrix(0, 0), n, n);
    RowMajor             gradient(n_q * dim, n), flux(n_q * dim, n);
    for (unsigned q = 0; q < n_q; ++q)
    {
      Tensor<2, dim> k = coefficients.stiffness_tensor(points[q]);
      for (unsigned d = 0; d < dim; ++d)
        if (!(k[d][d] > 0))
          throw InputError(coefficients.stiffness[0].where(),
                           fmt::format("the stiffness must be positive, it is {} at a point of the mesh", k[d][d]),
                           MessageName("out-of-range"));
      k *= values.JxW(q);
      for (unsigned j = 0; j < n; ++j)
      {
        const Tensor<1, dim> &gradient_j = values.shape_grad(j, q);
        const Tensor<1, dim>  flux_j = k * gradient_j;
        for (unsigned d = 0; d < dim; ++d)
        {
          gradient(q * dim + d, j) = gradient_j[d];
          flux(q * dim + d, j) = flux_j[d];
        }
      }
    }
    a.noalias() += gradient.transpose() * flux;

    std::vector<double> c, f;
    coefficients.reaction.values(points, c);
    coefficients.load.values(points, f);
    for (unsigned q = 0; q < n_q; ++q)
      for (unsigned j = 0; j < n; ++j)
      {
        const double phi_j = values.shape_value(j, q) * values.JxW(q);
        load(j) += f[q] * phi_j;
        if (c[q] != 0)
          for (unsigned i = 0; i < n; ++i)
            a(i, j) += c[q] * phi_j * values.shape_value(i, q);
      }
    add_convection_terms(values, matrix);
  }

  template <int dim>
  void Membrane<dim>::add_convection_terms(const FEValues<dim> &values, FullMatrix<double> &matrix) const
  {
    const auto &coefficients = regions[values.get_cell()->material_id()];
    if (coefficients.symmetric())
      return;
    for (const unsigned q : values.quadrature_point_indices())
    {
      const Tensor<1, dim> b = coefficients.velocity_vector(values.quadrature_point(q));
      for (const unsigned i : values.dof_indices())
        for (const unsigned j : values.dof_indices())
          matrix(i, j) += b * values.shape_grad(j, q) * values.shape_value(i, q) * values.JxW(q);
    }
  }

  template <int dim>
  bool Membrane<dim>::has_face_terms(const types::boundary_id part) const
  {
    return part < parts.size() && (!parts[part].flux.is_zero() || !parts[part].spring.is_zero());
  }

  template <int dim>
  void Membrane<dim>::add_face_terms(const FEFaceValues<dim> &values,
                                     const types::boundary_id part,
                                     FullMatrix<double>      &matrix,
                                     dealii::Vector<double>  &load) const
  {
    const unsigned n = values.dofs_per_cell;
    for (const unsigned q : values.quadrature_point_indices())
    {
      const Point<dim> &x = values.quadrature_point(q);
      const double      flux = parts[part].flux.value(x) * values.JxW(q);
      const double      spring = spring_at(parts[part].spring, x) * values.JxW(q);
      for (unsigned i = 0; i < n; ++i)
      {
        const double phi_i = values.shape_value(i, q);
        load(i) += flux * phi_i;
        if (spring != 0)
          for (unsigned j = 0; j < n; ++j)
            matrix(i, j) += spring * phi_i * values.shape_value(j, q);
      }
    }
  }

  template <int dim>
  std::vector<FieldFunction> Membrane<dim>::face_functions(const types::boundary_id part) const
  {
    return not_constant({parts[part].flux, parts[part].spring});
  }

  template <int dim>
  void Membrane<dim>::add_gram_terms(const FEValues<dim> &values, FullMatrix<double> &matrix) const
  {
    const double l = this->unit_of_length;
    for (const unsigned q : values.quadrature_point_indices())
      for (unsigned i = 0; i < values.dofs_per_cell; ++i)
        for (unsigned j = 0; j < values.dofs_per_cell; ++j)
          matrix(i, j) +=
            (values.shape_grad(i, q) * values.shape_grad(j, q) + values.shape_value(i, q) * values.shape_value(j, q) / (l * l)) *
            values.JxW(q);
  }

  template <int dim>
  void Membrane<dim>::flux(const FEValues<dim> &values, const dealii::Vector<double> &u, std::vector<Flux> &at) const
  {
    at.assign(values.n_quadrature_points, Flux{});
    for (const unsigned q : values.quadrature_point_indices())
    {
      Tensor<1, dim> gradient;
      for (unsigned i = 0; i < values.dofs_per_cell; ++i)
        gradient += u(i) * values.shape_grad(i, q);
      const Tensor<1, dim> k_gradient = regions[values.get_cell()->material_id()].stiffness_tensor(values.quadrature_point(q)) * gradient;
      for (unsigned d = 0; d < dim; ++d)
        at[q][d] = k_gradient[d];
    }
  }

  template <int dim>
  double Membrane<dim>::flux_energy(const Flux &flux, const types::material_id region, const Point<dim> &x) const
  {
    Tensor<1, dim> q;
    for (unsigned d = 0; d < dim; ++d)
      q[d] = flux[d];
    const Tensor<2, dim> k = regions[region].stiffness_tensor(x);
    return determinant(k) > 0 ? q * (invert(k) * q) : 0;
  }

  template <int dim>
  void Membrane<dim>::prepare(const types::material_id region, const std::vector<Point<dim>> &points) const
  {
    for (const FieldFunction &entry : regions[region].stiffness)
      entry.prepare(points);
  }

  template <int dim>
  bool Membrane<dim>::uniform_in(const types::material_id region) const
  {
    const auto constant = [](const FieldFunction &f) { return f.is_constant(); };
    const auto &[stiffness, velocity, reaction, load] = regions[region];
    return std::all_of(stiffness.begin(), stiffness.end(), constant) && std::all_of(velocity.begin(), velocity.end(), constant) &&
           constant(reaction);
  }

  template <int dim>
  bool Membrane<dim>::load_uniform_in(const types::material_id region) const
  {
    return regions[region].load.is_constant();
  }

  template <int dim>
  void Membrane<dim>::load_density(const unsigned,
                                   const types::material_id       region,
                                   const std::vector<Point<dim>> &points,
                                   std::vector<double>           &at) const
  {
    regions[region].load.values(points, at);
  }

  template <int dim>
  double Membrane<dim>::convection_to_diffusion(const types::material_id region, const Point<dim> &x) const
  {
    const SymmetricTensor<2, dim> k(symmetrize(regions[region].stiffness_tensor(x)));
    return regions[region].velocity_vector(x).norm() / eigenvalues(k)[dim - 1];
  }

  template <int dim>
  bool Membrane<dim>::holds_rigid_body_modes() const
  {
    return std::any_of(regions.begin(), regions.end(), [](const auto &coefficients) { return !coefficients.reaction.is_zero(); });
  }

  template <int dim>
  std::vector<RigidBodyMode<dim>> Membrane<dim>::rigid_body_modes(const Point<dim> &) const
  {
    Tensor<1, dim> one;
    one[0] = 1;
    return {{"a constant", [one](const Point<dim> &) { return one; }}};
  }

  template <int dim>
  std::pair<double, SourceLocation> Membrane<dim>::load_samples() const
  {
    for (const auto &coefficients : regions)
      if (coefficients.load.sample_spacing() > 0)
        return {coefficients.load.sample_spacing(), coefficients.load.where()};
    return {0, {}};
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template struct MembraneCoefficients<dim>;                                                                                               \
  template class Membrane<dim>;
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
