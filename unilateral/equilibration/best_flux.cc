#include "unilateral/equilibration/best_flux.h"

#include "unilateral/algebra/dense_solvers.h"

#include <algorithm>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Shapes of cells of a mesh that is refined in halves are few; those of an unstructured one are all different.
    constexpr std::size_t most_known = 16;

    /// A tensor in each point times the rows of a table for that point.
    template <int dim>
    Eigen::MatrixXd times_tensors(const std::vector<Tensor<2, dim>> &tensors, const Eigen::MatrixXd &table)
    {
      Eigen::MatrixXd result = Eigen::MatrixXd::Zero(table.rows(), table.cols());
      for (unsigned q = 0; q < tensors.size(); ++q)
        for (unsigned d = 0; d < dim; ++d)
          for (unsigned e = 0; e < dim; ++e)
            result.row(q * dim + d) += tensors[q][d][e] * table.row(q * dim + e);
      return result;
    }
  } // namespace

  template <int dim>
  BestFlux<dim>::BestFlux(const ReferenceFluxes<dim> &fields, const Quadrature<dim> &rule)
    : values(fields.values_at(rule.get_points())), divergences(fields.divergences_at(rule.get_points())), particular(fields.particular),
      bubbles(fields.bubbles), weights(rule.get_weights()), bubble_values(values * bubbles)
  {
  }

  template <int dim>
  void BestFlux<dim>::find(Solution &solution) const
  {
    std::vector<Tensor<2, dim>> weighted;
    Eigen::VectorXd             w(weights.size() * dim);
    for (unsigned q = 0; q < weights.size(); ++q)
    {
      weighted.push_back(weights[q] * solution.T);
      w.segment(q * dim, dim).setConstant(weights[q]);
    }
    const Eigen::MatrixXd             TV = times_tensors<dim>(weighted, bubble_values);
    const Eigen::LLT<Eigen::MatrixXd> factors(bubble_values.transpose() * TV);
    solution.of_moments = particular - bubbles * factors.solve(TV.transpose() * (values * particular));
    solution.of_gradient = bubbles * factors.solve(bubble_values.transpose() * w.asDiagonal());
    solution.found = true;
  }

  template <int dim>
  Eigen::VectorXd BestFlux<dim>::coefficients(const Eigen::VectorXd                      &moments,
                                              const StraightCell<dim>                    &cell,
                                              const typename StraightCell<dim>::AtPoints &at,
                                              const std::vector<Tensor<2, dim>>          &inverse_k,
                                              const bool                                  uniform,
                                              const std::vector<Tensor<1, dim>>          &gradient)
  {
    if (bubbles.cols() == 0)
      return particular * moments;
    const unsigned  n_q = weights.size();
    const auto      T = [&](const unsigned q) { return transpose(at.jacobian[q]) * inverse_k[q] * at.jacobian[q] / at.determinant[q]; };
    Eigen::VectorXd v_hat(n_q * dim); // J' grad v
    for (unsigned q = 0; q < n_q; ++q)
    {
      const Tensor<1, dim> of_reference = transpose(at.jacobian[q]) * gradient[q];
      for (unsigned d = 0; d < dim; ++d)
        v_hat(q * dim + d) = of_reference[d];
    }
    if (uniform && cell.affine())
    {
      const double         size = T(0).norm();
      const Tensor<2, dim> direction = T(0) / size;
      auto                 same =
        std::find_if(known.begin(), known.end(), [&](const Solution &solution) { return (solution.T - direction).norm() < 1e-13; });
      if (same != known.end())
      {
        if (!same->found)
          find(*same);
        return same->of_moments * moments + same->of_gradient * v_hat / size;
      }
      if (known.size() < most_known)
        known.push_back({direction, false, {}, {}});
    }
    std::vector<Tensor<2, dim>> weighted(n_q);
    for (unsigned q = 0; q < n_q; ++q)
    {
      weighted[q] = weights[q] * T(q);
      v_hat.segment(q * dim, dim) *= weights[q];
    }
    const Eigen::VectorXd             plain = particular * moments;
    const Eigen::MatrixXd             TV = times_tensors<dim>(weighted, bubble_values);
    const Eigen::LLT<Eigen::MatrixXd> factors(bubble_values.transpose() * TV);
    return plain + bubbles * factors.solve(bubble_values.transpose() * v_hat - TV.transpose() * (values * plain));
  }

  template class BestFlux<1>;
  template class BestFlux<2>;
  template class BestFlux<3>;
} // namespace unilateral
