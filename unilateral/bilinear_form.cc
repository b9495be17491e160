#include "unilateral/bilinear_form.h"

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
  void add_cell_terms(const FEValues<dim>             &values,
                      const MembraneCoefficients<dim> &coefficients,
                      FullMatrix<double>              &matrix,
                      dealii::Vector<double>          &load)
  {
    const unsigned n = values.dofs_per_cell;
    for (const unsigned q : values.quadrature_point_indices())
    {
      const Point<dim>    &x = values.quadrature_point(q);
      const double         JxW = values.JxW(q);
      const Tensor<2, dim> k = coefficients.stiffness_tensor(x);
      const Tensor<1, dim> b = coefficients.velocity_vector(x);
      const double         c = coefficients.reaction.value(x);
      const double         f = coefficients.load.value(x);
      for (unsigned j = 0; j < n; ++j)
      {
        const double         phi_j = values.shape_value(j, q);
        const Tensor<1, dim> flux_j = k * values.shape_grad(j, q);
        const double         lower_order_j = b * values.shape_grad(j, q) + c * phi_j;
        for (unsigned i = 0; i < n; ++i)
          matrix(i, j) += (flux_j * values.shape_grad(i, q) + lower_order_j * values.shape_value(i, q)) * JxW;
        load(j) += f * phi_j * JxW;
      }
    }
  }

  template <int dim>
  void add_face_terms(const FEFaceValues<dim> &values,
                      const BoundaryCondition &condition,
                      FullMatrix<double>      &matrix,
                      dealii::Vector<double>  &load)
  {
    const unsigned n = values.dofs_per_cell;
    for (const unsigned q : values.quadrature_point_indices())
    {
      const Point<dim> &x = values.quadrature_point(q);
      const double      flux = condition.flux.value(x) * values.JxW(q);
      const double      spring = condition.spring.value(x) * values.JxW(q);
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
  void add_gram_terms(const FEValues<dim> &values, FullMatrix<double> &matrix)
  {
    for (const unsigned q : values.quadrature_point_indices())
      for (unsigned i = 0; i < values.dofs_per_cell; ++i)
        for (unsigned j = 0; j < values.dofs_per_cell; ++j)
          matrix(i, j) +=
            (values.shape_grad(i, q) * values.shape_grad(j, q) + values.shape_value(i, q) * values.shape_value(j, q)) * values.JxW(q);
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template struct MembraneCoefficients<dim>;                                                                                               \
  template void add_cell_terms(const FEValues<dim> &, const MembraneCoefficients<dim> &, FullMatrix<double> &, dealii::Vector<double> &);  \
  template void add_face_terms(const FEFaceValues<dim> &, const BoundaryCondition &, FullMatrix<double> &, dealii::Vector<double> &);      \
  template void add_gram_terms(const FEValues<dim> &, FullMatrix<double> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
