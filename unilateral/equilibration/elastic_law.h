// Hooke's law as small matrices.
#pragma once

#include "unilateral/equilibration/composite_stresses.h"

#include <deal.II/base/tensor.h>

#include <algorithm>

namespace unilateral
{
  /// Stresses as StressVector; strains likewise, with twice the shear, so that their product is the energy.
  template <int dim>
  struct ElasticLaw
  {
    static constexpr unsigned n = dim * (dim + 1) / 2;
    using Matrix = Eigen::Matrix<double, n, n>;

    ElasticLaw(const double lambda, const double mu) : least(std::min(2 * mu, 2 * mu + dim * lambda))
    {
      stiffness.setZero();
      compliance.setZero();
      stiffness.template topLeftCorner<dim, dim>().setConstant(lambda);
      compliance.template topLeftCorner<dim, dim>().setConstant(-lambda / (2 * mu * (2 * mu + dim * lambda)));
      for (unsigned k = 0; k < n; ++k)
      {
        stiffness(k, k) += k < dim ? 2 * mu : mu;
        compliance(k, k) += k < dim ? 1 / (2 * mu) : 1 / mu;
      }
    }

    Matrix stiffness, compliance;
    double least; ///< the energy density eps : C eps is at least this times |eps|^2
  };

  /// The strain of a displacement with this gradient, sym(gradient).
  template <int dim>
  StressVector<dim> strain_of(const dealii::Tensor<2, dim> &gradient)
  {
    StressVector<dim> strain;
    for (unsigned a = 0; a < dim; ++a)
      for (unsigned b = a; b < dim; ++b)
        strain(stress_index<dim>(a, b)) = a == b ? gradient[a][a] : gradient[a][b] + gradient[b][a];
    return strain;
  }

  /// tau = J s J' as a matrix that acts on s.
  template <int dim>
  typename ElasticLaw<dim>::Matrix congruence(const dealii::Tensor<2, dim> &J)
  {
    typename ElasticLaw<dim>::Matrix L = ElasticLaw<dim>::Matrix::Zero();
    for (unsigned a = 0; a < dim; ++a)
      for (unsigned b = a; b < dim; ++b)
        for (unsigned c = 0; c < dim; ++c)
          for (unsigned d = 0; d < dim; ++d)
            L(stress_index<dim>(a, b), stress_index<dim>(c, d)) += J[a][c] * J[b][d];
    return L;
  }
} // namespace unilateral
