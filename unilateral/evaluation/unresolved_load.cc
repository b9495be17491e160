#include "unilateral/evaluation/unresolved_load.h"

#include "unilateral/discretisation/element_systems.h"
#include "unilateral/forms/membrane.h"
#include "unilateral/mesh/subdivided_rule.h"

#include <deal.II/fe/fe_values.h>

#include <algorithm>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    constexpr unsigned n_halvings = dim == 1   ? 5
                                    : dim == 2 ? 3
                                               : 1;

    /// The points of @p rule and others next to the corners, where it has none.
    template <int dim>
    Quadrature<dim> with_corners(const Quadrature<dim> &rule, const ReferenceCell &cell)
    {
      std::vector<Point<dim>> points = rule.get_points();
      const Point<dim>        centre = cell.template barycenter<dim>();
      for (const unsigned v : cell.vertex_indices())
      {
        const Point<dim> corner = cell.template vertex<dim>(v);
        points.push_back(corner + 1e-4 * (centre - corner)); // beyond the corner the load may be another one
      }
      return Quadrature<dim>(points);
    }

    template <int dim>
    class UnresolvedLoad
    {
    public:
      UnresolvedLoad(const Problem<dim> &problem, const Vector &u, const Vector &z)
        : problem(problem), form(*problem.form), u(u), z(z), n(problem.space.fe->n_dofs_per_cell()),
          coarse(*problem.space.mapping, *problem.space.fe, problem.cell_quadrature(), cell_flags(form)),
          fine(*problem.space.mapping,
               *problem.space.fe,
               subdivided(problem.cell_quadrature(), problem.space.element.simplex(), n_halvings<dim>),
               cell_flags(form)),
          samples(*problem.space.mapping,
                  *problem.space.fe,
                  with_corners(problem.cell_quadrature(), problem.space.fe->reference_cell()),
                  update_quadrature_points),
          dofs(n)
      {
      }

      std::vector<double> by_cell()
      {
        std::vector<double> work;
        for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
          work.push_back(may_be_unresolved(cell) ? work_in(cell, fine) - work_in(cell, coarse) : 0.);
        return work;
      }

    private:
      using Cell = typename DoFHandler<dim>::active_cell_iterator;

      bool with_matrix(const Cell &cell) const { return form.n_components() == 1 && !form.uniform_in(cell->material_id()); }

      bool may_be_unresolved(const Cell &cell)
      {
        const auto region = cell->material_id();
        if (form.uniform_in(region) && form.load_uniform_in(region))
          return false;
        if (form.order() > 1)
          return true;
        samples.reinit(cell);
        const auto &x = samples.get_quadrature_points();
        for (unsigned c = 0; c < form.n_components(); ++c)
        {
          form.load_density(c, region, x, at_samples);
          if (varies_much(at_samples))
            return true;
        }
        const auto varies = [&](const FieldFunction &coefficient)
        {
          coefficient.values(x, at_samples);
          return varies_much(at_samples);
        };
        if (const auto *const membrane = dynamic_cast<const Membrane<dim> *>(&form))
        {
          const auto &coefficients = membrane->coefficients_in(region);
          return varies(coefficients.reaction) || std::any_of(coefficients.stiffness.begin(), coefficients.stiffness.end(), varies);
        }
        return false;
      }

      double work_in(const Cell &cell, FEValues<dim> &values)
      {
        values.reinit(cell);
        cell->get_dof_indices(dofs);
        dealii::Vector<double> load(n);
        if (with_matrix(cell))
        {
          FullMatrix<double>     matrix(n, n);
          dealii::Vector<double> local_u(n), Au(n);
          form.add_cell_terms(values, matrix, load);
          for (unsigned i = 0; i < n; ++i)
            local_u(i) = u(dofs[i]);
          matrix.vmult(Au, local_u);
          load -= Au;
        }
        else
          form.add_cell_load(values, load);
        double work = 0;
        for (unsigned i = 0; i < n; ++i)
          work += load(i) * z(dofs[i]);
        return work;
      }

      const Problem<dim>                  &problem;
      const BilinearForm<dim>             &form;
      const Vector                        &u, &z;
      const unsigned                       n;
      FEValues<dim>                        coarse, fine, samples;
      std::vector<types::global_dof_index> dofs;
      std::vector<double>                  at_samples;
    };
  } // namespace

  template <int dim>
  std::vector<double> work_of_unresolved_load(const Problem<dim> &problem, const Vector &u, const Vector &z)
  {
    return UnresolvedLoad<dim>(problem, u, z).by_cell();
  }

  template std::vector<double> work_of_unresolved_load(const Problem<1> &, const Vector &, const Vector &);
  template std::vector<double> work_of_unresolved_load(const Problem<2> &, const Vector &, const Vector &);
  template std::vector<double> work_of_unresolved_load(const Problem<3> &, const Vector &, const Vector &);
} // namespace unilateral
