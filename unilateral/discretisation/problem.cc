#include "unilateral/discretisation/problem.h"

#include "unilateral/constraints/periodic_points.h"
#include "unilateral/constraints/quadrature_rule.h"
#include "unilateral/mesh/gauss_rule.h"
#include "unilateral/spaces/refinement_count.h"

#include <deal.II/base/quadrature_lib.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace unilateral
{
  using namespace dealii;

  RuleName first_rule(const ProblemStatement &statement, const unsigned dim)
  {
    const auto rule = statement.constraints.empty() ? std::nullopt : statement.constraints[0].quadrature;
    return rule.value_or(default_rule(statement.model.element, dim));
  }

  template <int dim>
  bool Problem<dim>::axisymmetric() const
  {
    return statement.model.kind == ModelChoices::Kind::elasticity && dim == 2 &&
           statement.model.assumption == ModelChoices::Assumption::axisymmetric;
  }

  template <int dim>
  Quadrature<dim> Problem<dim>::cell_quadrature() const
  {
    // A projection integrates by I_G where its points are the nodes: the problem is then one of single points.
    if (form->order() == 0)
      if (const RuleName rule = first_rule(statement, dim);
          space.element.family == ElementName::Family::discontinuous || rule.family == RuleName::Family::nodal)
        return quadrature_rule<dim>(rule, space.element);
    // A body's matrices in 3-D are dear, and their coefficients nearly always constant.
    const unsigned n = space.element.degree + (dim == 3 && form->n_components() > 1 ? 1 : 2);
    return gauss_rule<dim>(space.element.simplex(), n);
  }

  template <int dim>
  Quadrature<dim - 1> Problem<dim>::face_quadrature() const
  {
    return gauss_rule<dim - 1>(space.element.simplex(), space.element.degree + 2);
  }

  template <int dim>
  std::vector<double> Problem<dim>::cells_by_local_refinements() const
  {
    std::vector<FieldFunction> places;
    for (unsigned k = std::max(statement.mesh.refine, space.level); k < statement.mesh.n_refinements(); ++k)
      places.push_back(*statement.mesh.place_of_refinement(k));
    if (places.empty())
      return {};
    const unsigned       whole_rounds = statement.mesh.refine - std::min(statement.mesh.refine, space.level);
    RefinementCount<dim> count(std::move(places), whole_rounds);
    std::vector<double>  n_cells;
    for (const auto &cell : space.mesh.triangulation->active_cell_iterators())
      n_cells.push_back(count(cell));
    return n_cells;
  }

  template <int dim>
  double Problem<dim>::growth_in_places() const
  {
    const auto n_cells = cells_by_local_refinements();
    return n_cells.empty() ? 1 : space.processes().sum(std::accumulate(n_cells.begin(), n_cells.end(), 0.)) / space.n_cells();
  }

  template <int dim>
  ConstraintSet<dim> Problem<dim>::make_constraint_set(const std::vector<UnilateralCondition> &conditions) const
  {
    const auto running = time_by_part.run("constraints");
    auto       set = unilateral::make_constraint_set(conditions, space.element, *space.mapping, space.dof_handler, space.dirichlet,
                                                     space.hanging_nodes, *form, space.shared());
    merge_periodic_points(set, space.couplings.periodic);
    for (std::size_t b = 0; b < set.blocks.size(); ++b)
      if (space.level >= statement.mesh.n_refinements() && !space.processes().any(set.blocks[b].begin < set.blocks[b].end))
        throw NoPoints(conditions[b].where, "no point is left where this constraint could act: every point of the rule lies where the "
                                            "values are fixed by [boundary]; refine the mesh or free a part");
    return set;
  }

  template <int dim>
  void warn_about_fine_rasters(const Problem<dim> &problem, Diagnostics &diagnostics)
  {
    const auto look_at = [&](const std::pair<double, SourceLocation> &samples)
    {
      const auto &[spacing, where] = samples;
      if (spacing <= 0)
        return;
      const double h = problem.space.cell_sizes().second / std::sqrt(double(dim)) / std::max(problem.space.element.degree, 1u);
      if (3 * spacing < h)
        diagnostics.warning(where,
                            fmt::format("its samples lie {:.3g} apart, the nodes of the finest mesh {:.3g}: detail in "
                                        "between is not seen; refine the mesh or smooth the data",
                                        spacing, h),
                            MessageName("detail-unseen"));
    };
    for (const auto &condition : problem.conditions)
      look_at({condition.bound.sample_spacing(), condition.bound.where()});
    look_at(problem.form->load_samples());
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template class Problem<dim>;                                                                                                             \
  template void warn_about_fine_rasters(const Problem<dim> &, Diagnostics &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
