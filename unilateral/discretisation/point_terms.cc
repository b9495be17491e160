#include "unilateral/discretisation/point_terms.h"

#include "unilateral/forms/spring.h"

#include "unilateral/spaces/point_location.h"

#include <deal.II/fe/fe_values.h>

#include <optional>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Of several processes one has it, in whose part the point lies.
    template <int dim>
    std::optional<PointTerm> point_term(const Problem<dim>        &problem,
                                        const std::vector<double> &at,
                                        const double               force,
                                        const double               moment,
                                        const double               spring,
                                        const SourceLocation      &where)
    {
      const auto       place = locate(problem.space, to_point<dim>(at));
      const Processes &processes = problem.space.processes();
      const double     outside = processes.min(place.outside);
      if (outside > 1e-6)
        throw InputError(where, "the point does not lie in the mesh", MessageName("point-outside"));
      const double owner = processes.min(place.outside == outside ? processes.rank() : processes.size());
      if (owner != processes.rank())
        return {};
      FEValues<dim> values(*problem.space.mapping, *problem.space.fe, Quadrature<dim>(place.unit), update_values | update_gradients);
      values.reinit(place.cell);
      const unsigned n = values.dofs_per_cell;
      PointTerm      term{std::vector<types::global_dof_index>(n), FullMatrix<double>(n, n), dealii::Vector<double>(n)};
      place.cell->get_dof_indices(term.dofs);
      for (unsigned i = 0; i < n; ++i)
      {
        term.load(i) = force * values.shape_value(i, 0) + moment * values.shape_grad(i, 0)[0];
        for (unsigned j = 0; j < n; ++j)
          term.matrix(i, j) = spring * values.shape_value(i, 0) * values.shape_value(j, 0);
      }
      return term;
    }
  } // namespace

  template <int dim>
  std::vector<PointTerm> point_terms(const Problem<dim> &problem)
  {
    std::vector<PointTerm> terms;
    const auto             add = [&](std::optional<PointTerm> term)
    {
      if (term)
        terms.push_back(std::move(*term));
    };
    for (const auto &load : problem.statement.point_loads)
      add(point_term(problem, load.at, load.force, load.moment, 0, load.where));
    for (const auto &support : problem.statement.supports)
      if (support.spring)
        add(point_term(problem, support.at, 0, 0, spring_at(*support.spring, to_point<dim>(support.at)), support.where));
    return terms;
  }

  template std::vector<PointTerm> point_terms(const Problem<1> &);
  template std::vector<PointTerm> point_terms(const Problem<2> &);
  template std::vector<PointTerm> point_terms(const Problem<3> &);
} // namespace unilateral
