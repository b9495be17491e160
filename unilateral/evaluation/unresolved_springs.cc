#include "unilateral/evaluation/unresolved_springs.h"

#include "unilateral/forms/elasticity.h"
#include "unilateral/forms/membrane.h"

#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    class BoundaryTerms
    {
    public:
      explicit BoundaryTerms(const Problem<dim> &problem)
        : membrane(dynamic_cast<const Membrane<dim> *>(problem.form.get())),
          elasticity(dynamic_cast<const Elasticity<dim> *>(problem.form.get())), axisymmetric(problem.axisymmetric())
      {
      }

      bool serves() const { return membrane || elasticity; }

      Tensor<1, dim> springs(const types::boundary_id part, const Point<dim> &x) const
      {
        if (elasticity)
          return elasticity->springs(part, x);
        Tensor<1, dim> result;
        result[0] = membrane->terms_on(part).spring.value(x);
        return result;
      }

      double stiffness(const types::material_id region, const Point<dim> &x) const
      {
        if (membrane)
          return trace(membrane->coefficients_in(region).stiffness_tensor(x)) / dim;
        const auto lame = elasticity->lame_parameters(region, x);
        return lame.lambda + 2 * lame.mu;
      }

      /// Load less flux of u, by component: what springs should bear. @p u: values, @p gradients: of each component.
      Tensor<1, dim> borne(const types::material_id           region,
                           const types::boundary_id           part,
                           const Point<dim>                  &x,
                           const Tensor<1, dim>              &normal,
                           const dealii::Vector<double>      &u,
                           const std::vector<Tensor<1, dim>> &gradients) const
      {
        Tensor<1, dim> result;
        if (membrane)
        {
          const auto k = membrane->coefficients_in(region).stiffness_tensor(x);
          result[0] = membrane->terms_on(part).flux.value(x) - (k * gradients[0]) * normal;
          return result;
        }
        const auto lame = elasticity->lame_parameters(region, x);
        result = elasticity->surface_load(part, x, normal);
        double volume = axisymmetric && x[0] > 0 ? u(0) / x[0] : 0.;
        for (unsigned d = 0; d < dim; ++d)
          volume += gradients[d][d];
        for (unsigned a = 0; a < dim; ++a)
        {
          result[a] -= lame.lambda * volume * normal[a];
          for (unsigned b = 0; b < dim; ++b)
            result[a] -= lame.mu * (gradients[a][b] + gradients[b][a]) * normal[b];
        }
        return result;
      }

    private:
      const Membrane<dim> *const   membrane;
      const Elasticity<dim> *const elasticity;
      const bool                   axisymmetric;
    };
  } // namespace

  template <int dim>
  double add_unresolved_springs(const Problem<dim> &problem, const Vector &u, std::vector<double> &cell_squares)
  {
    const BoundaryTerms<dim> terms(problem);
    const unsigned           n_components = problem.form->n_components();
    if (!terms.serves())
      return 0;
    std::vector<bool> counts;
    for (types::boundary_id part = 0; part < problem.space.mesh.part_names.size(); ++part)
      counts.push_back(problem.form->has_face_terms(part) &&
                       std::none_of(problem.conditions.begin(), problem.conditions.end(),
                                    [&](const UnilateralCondition &condition) { return condition.part == part; }));
    FEFaceValues<dim>                        values(*problem.space.mapping, *problem.space.fe, problem.face_quadrature(),
                                                    update_values | update_gradients | update_quadrature_points | update_JxW_values | update_normal_vectors);
    const unsigned                           n_q = values.n_quadrature_points;
    std::vector<dealii::Vector<double>>      u_at(n_q, dealii::Vector<double>(n_components));
    std::vector<std::vector<Tensor<1, dim>>> gradients(n_q, std::vector<Tensor<1, dim>>(n_components));
    double                                   sum = 0;
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      for (const unsigned f : cell->face_indices())
      {
        if (!problem.space.is_outside(cell, f) || !counts[cell->face(f)->boundary_id()])
          continue;
        values.reinit(cell, f);
        values.get_function_values(u, u_at);
        values.get_function_gradients(u, gradients);
        double square = 0;
        for (unsigned q = 0; q < n_q; ++q)
        {
          const Point<dim>    &x = values.quadrature_point(q);
          const auto           region = cell->material_id();
          const auto           part = cell->face(f)->boundary_id();
          const Tensor<1, dim> springs = terms.springs(part, x);
          if (springs.norm() == 0)
            continue;
          const Tensor<1, dim> rho = cell->diameter() / terms.stiffness(region, x) * springs;
          if (*std::max_element(rho.begin_raw(), rho.end_raw()) <= 1)
            continue;
          const Tensor<1, dim> borne = terms.borne(region, part, x, values.normal_vector(q), u_at[q], gradients[q]);
          for (unsigned c = 0; c < n_components; ++c)
            if (rho[c] > 1)
              square +=
                (1 - 1 / rho[c]) * std::pow(borne[c] - springs[c] * u_at[q](c), 2) / springs[c] * values.JxW(q) * problem.form->measure(x);
        }
        cell_squares[cell->active_cell_index()] += square;
        sum += square;
      }
    return std::sqrt(problem.space.processes().sum(sum));
  }

#define INSTANTIATE(dim) template double add_unresolved_springs(const Problem<dim> &, const Vector &, std::vector<double> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
