#include "unilateral/evaluation/probes.h"

#include "unilateral/discretisation/element_systems.h"
#include "unilateral/forms/elasticity.h"
#include "unilateral/spaces/point_location.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

namespace unilateral
{
  using namespace dealii;
  using VectorType = LinearAlgebra::distributed::Vector<double>;

  namespace
  {
    /// Of several processes the one speaks in whose part the point lies.
    void take_from_nearest(const Processes &processes, const double outside, ProbeResult &result)
    {
      if (processes.alone())
        return;
      const bool          nearest = outside == processes.min(outside);
      const unsigned      speaker = processes.min(nearest ? processes.rank() : processes.size());
      std::vector<double> numbers(result.value);
      if (result.stress)
        numbers.insert(numbers.end(), result.stress->begin(), result.stress->end());
      numbers.insert(numbers.end(), result.moments.begin(), result.moments.end());
      numbers.push_back(result.von_mises);
      processes.broadcast(numbers.data(), numbers.size(), speaker);
      auto next = numbers.begin();
      for (double &value : result.value)
        value = *next++;
      if (result.stress)
        for (double &component : *result.stress)
          component = *next++;
      for (double &moment : result.moments)
        moment = *next++;
      result.von_mises = *next;
    }
  } // namespace

  template <int dim>
  void check_probes(const Problem<dim> &problem)
  {
    Diagnostics diagnostics;
    const auto &output = problem.statement.output;
    for (std::size_t k = 0; k < output.probes.size(); ++k)
      if (problem.space.processes().min(locate(problem.space, to_point<dim>(output.probes[k])).outside) > outside_by_straight_sides)
        diagnostics.error(k < output.probes_where.size() ? output.probes_where[k] : problem.statement.mesh.where,
                          fmt::format("the probe ({:.6g}) lies in no cell of the mesh: there is no u; move it inside, or leave it out",
                                      fmt::join(output.probes[k], ", ")),
                          MessageName("point-outside"));
    diagnostics.throw_if_errors();
  }

  template <int dim>
  std::vector<ProbeResult> probe_values(const Problem<dim> &problem, const VectorType &u, const RecoveredFlux<dim> &flux)
  {
    std::vector<ProbeResult>             results;
    const auto                          &fe = *problem.space.fe;
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    const bool                           body = problem.form->n_components() > 1;
    const auto                           scalar = body ? problem.space.scalar_element() : nullptr;
    std::vector<types::global_dof_index> nodes(body ? scalar->n_dofs_per_cell() : 0);
    for (const auto &coordinates : problem.statement.output.probes)
    {
      const auto [owner, unit, outside] = locate(problem.space, to_point<dim>(coordinates));
      ProbeResult result{
        coordinates, std::vector<double>(problem.form->n_components(), std::numeric_limits<double>::quiet_NaN()), {}, 0, {}};
      if (problem.form->order() > 1)
        result.moments.assign(problem.form->n_flux_components(), std::numeric_limits<double>::quiet_NaN());
      if (outside <= outside_by_straight_sides)
      {
        owner->get_dof_indices(dofs);
        result.value.assign(result.value.size(), 0.);
        FEValues<dim> at_point(*problem.space.mapping, fe, Quadrature<dim>(unit), cell_flags(*problem.form));
        at_point.reinit(owner);
        dealii::Vector<double> local(dofs.size());
        for (unsigned i = 0; i < dofs.size(); ++i)
        {
          local(i) = u(dofs[i]);
          result.value[fe.system_to_component_index(i).first] += local(i) * at_point.shape_value(i, 0);
        }
        if (problem.form->order() > 1)
        {
          std::vector<Flux> moments;
          problem.form->flux(at_point, local, moments);
          result.moments.assign(moments[0].begin(), moments[0].begin() + problem.form->n_flux_components());
        }
        if (body)
        {
          Stress stress{};
          typename DoFHandler<dim>::active_cell_iterator(&*problem.space.mesh.triangulation, owner->level(), owner->index(), &*flux.nodes)
            ->get_dof_indices(nodes);
          for (unsigned i = 0; i < nodes.size(); ++i)
            for (std::size_t c = 0; c < stress.size(); ++c)
              stress[c] += scalar->shape_value(i, unit) * flux.at(nodes[i], owner->material_id())[c];
          result.stress = stress;
          result.von_mises = von_mises(stress);
        }
      }
      else if (body)
      {
        result.stress.emplace();
        result.stress->fill(std::numeric_limits<double>::quiet_NaN());
        result.von_mises = std::numeric_limits<double>::quiet_NaN();
      }
      take_from_nearest(problem.space.processes(), outside, result);
      results.push_back(std::move(result));
    }
    return results;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::vector<ProbeResult> probe_values(const Problem<dim> &, const VectorType &, const RecoveredFlux<dim> &);                    \
  template void                     check_probes(const Problem<dim> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
