// How Discretisation divides a mesh among processes.
#include "unilateral/discretisation/mesh_hierarchy.h"
#include "unilateral/discretisation/solver_choice.h"
#include "unilateral/discretisation/unknowns_on_finest.h"
#include "unilateral/discretisation/vertex_volumes.h"
#include "unilateral/mesh/refinement_at_cuts.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace unilateral
{
  namespace
  {
    template <int dim>
    bool is_refined_in_places(const Problem<dim> &problem)
    {
      return !problem.statement.mesh.local.empty() || problem.statement.mesh.adapt;
    }

    /// No part is empty or has more than twice the mean.
    bool is_balanced(const Division &division, const unsigned n_parts)
    {
      std::vector<std::size_t> n_cells(n_parts, 0);
      for (const unsigned owner : division.owner)
        ++n_cells[owner];
      const auto [least, most] = std::minmax_element(n_cells.begin(), n_cells.end());
      return *least > 0 && *most * n_parts <= 2 * division.owner.size();
    }
  } // namespace

  /// Fewer than unknowns_to_share() are not worth a division.
  template <int dim>
  bool Discretisation<dim>::limits_unknowns(const Problem<dim> &problem) const
  {
    return !hierarchy && problem.statement.method.solver == Method::Solver::automatic;
  }

  template <int dim>
  double Discretisation<dim>::unknowns_to_share(const Problem<dim> &problem) const
  {
    if (problem.statement.mesh.adapt && problem.symmetric() && !factorises_parts(problem) && !VertexVolumes<dim>::any(problem))
      return parameters.unknowns_to_share_adapted;
    return dim == 2 ? parameters.unknowns_to_share_2d : parameters.unknowns_to_share_3d;
  }

  /// Why several processes cannot each have a part of the problem; empty: they can.
  template <int dim>
  std::string Discretisation<dim>::obstacle_to_sharing(const Problem<dim> &problem, const double n_finest) const
  {
    if (hierarchy)
      return "";
    if (dim == 1)
      return "the mesh is one-dimensional";
    if (problem.space.element.family == ElementName::Family::discontinuous)
      return "the element is not continuous";
    if (is_refined_in_places(problem) && !problem.prescribed.periodic.empty() && !problem.space.element.simplex())
      return "cells that cuts add where the mesh is refined in places might be beside one of two periodic parts alone";
    if (factorises_parts(problem) && VertexVolumes<dim>::any(problem))
      return "a factorisation with volumes that are averaged at vertices solves it";
    const auto  &bounds = problem.conditions;
    const double most_for_one = dim == 2 ? parameters.factorised_by_one_2d : parameters.factorised_by_one_3d;
    if (factorises_parts(problem) && problem.symmetric() && problem.form->order() == 1 && !bounds.empty() && n_finest < most_for_one &&
        std::all_of(bounds.begin(), bounds.end(), [](const auto &bound) { return bound.part.has_value(); }))
      return fmt::format("one factorisation serves for all contact sets, where those of parts would take one for each, and there are fewer "
                         "than {:.0f} unknowns",
                         most_for_one);
    if (limits_unknowns(problem) && n_finest < unknowns_to_share(problem))
      return fmt::format("it has fewer than {:.0f} unknowns", unknowns_to_share(problem));
    return "";
  }

  template <int dim>
  std::vector<TiedParts> tied_parts(const Problem<dim> &problem)
  {
    std::vector<TiedParts> tied;
    const auto            &conditions = problem.prescribed.conditions;
    for (dealii::types::boundary_id part = 0; part < conditions.size(); ++part)
      if (conditions[part].rigid)
        tied.push_back({part});
    for (const auto &pair : problem.prescribed.periodic)
      tied.push_back({pair.first, pair.second});
    return tied;
  }

  template <int dim>
  std::vector<double> cells_to_come(const Problem<dim> &problem)
  {
    return problem.space.refines_in_places() ? problem.cells_by_local_refinements() : std::vector<double>();
  }

  template <int dim>
  void Discretisation<dim>::say_if_not_shared(const Problem<dim> &problem, const Processes &processes, Progress &progress)
  {
    if (processes.alone() || problem.space.subdomain || std::exchange(told, true))
      return;
    const bool adapts = problem.statement.mesh.adapt.has_value();
    if (const std::string obstacle =
          obstacle_to_sharing(problem, adapts ? std::numeric_limits<double>::infinity() : unknowns_on_finest(problem));
        !obstacle.empty())
      progress.log("every process solves the whole problem: " + obstacle);
    else if (adapts)
      progress.log(
        fmt::format("every process solves the whole problem until a mesh has {} cells for each of them{}", cells_to_share(problem),
                    limits_unknowns(problem) ? fmt::format(", and the next one {:.0f} unknowns", unknowns_to_share(problem)) : ""));
    else
      progress.log(fmt::format("every process solves the whole problem: no mesh that could be divided has {} cells for each of them{}",
                               cells_to_share(problem),
                               tied_parts(problem).empty() ? "" : ", or one would have too many, those at rigid and periodic parts"));
  }

  template <int dim>
  std::size_t Discretisation<dim>::cells_to_share(const Problem<dim> &problem) const
  {
    return is_refined_in_places(problem) ? parameters.cells_to_share_in_places : parameters.cells_to_share;
  }

  /// Of a mesh that is refined everywhere.
  template <int dim>
  std::size_t Discretisation<dim>::cells_before_last_refinement(const Problem<dim> &problem) const
  {
    std::size_t n = problem.space.n_cells();
    for (unsigned level = problem.space.level + 1; level < problem.statement.mesh.refine; ++level)
      n <<= dim;
    return n;
  }

  template <int dim>
  void Discretisation<dim>::share_work(Problem<dim>              &problem,
                                       std::vector<Vector>       &functions,
                                       std::vector<bool>         &cells,
                                       const std::vector<double> &weights,
                                       const double               n_finest,
                                       const bool                 refined_next,
                                       const Processes           &processes,
                                       Progress                  &progress)
  {
    const unsigned n_alike = problem.space.subdomain ? problem.space.subdomain->n_alike : processes.size();
    if (n_alike == 1 || !obstacle_to_sharing(problem, n_finest).empty())
      return;
    const std::size_t n_cells = problem.space.n_cells(), for_each = cells_to_share(problem);
    const bool        in_steps =
      hierarchy && !is_refined_in_places(problem) && cells_before_last_refinement(problem) >= for_each * processes.size();
    const auto steps = in_steps ? division_steps(processes.size(), parameters.parts_at_once) : std::vector<unsigned>{processes.size()};
    // Where nodes hang, the mesh may need one more refinement before it conforms at the cuts, so that is prepared early.
    const bool early = is_refined_in_places(problem) && !problem.space.element.simplex();
    const auto next = next_division(steps, processes.size(), n_alike, n_cells, early ? for_each / 2. : for_each);
    if (n_alike < processes.size())
      for (auto &function : functions) // equal up to rounding
        processes.block(n_alike).broadcast(function.begin(), function.size(), 0);
    if (next.n_parts == 1)
      return;
    if constexpr (dim > 1)
    {
      auto &whole = *problem.space.mesh.triangulation;
      if (!division)
        division = divide(whole, next.n_parts, weights, tied_parts(problem));
      if (!tied_parts(problem).empty() && !is_balanced(*division, next.n_parts))
      {
        division.reset(); // finer cells may be fewer at such parts
        return;
      }
      if (n_cells < for_each * processes.size() / next.n_alike || !conforms_at_cuts(whole, *division))
      {
        if (cells.empty())
          cells.assign(n_cells, true);
        refine_alike_at_cuts(whole, *division, cells);
        return;
      }
      const Processes group = processes.block(n_alike).every(next.n_alike);
      for (unsigned &owner : division->owner)
        owner += processes.rank() / n_alike * next.n_parts;
      problem.keep_own_part(processes.every(next.n_alike), std::move(*division), next.n_alike, functions, refined_next);
      division.reset();
      std::vector<bool> of_part;
      for (std::size_t k = 0; k < problem.space.subdomain->own_active_cells.size() && !cells.empty(); ++k)
        of_part.push_back(cells[problem.space.subdomain->own_active_cells[k]]);
      cells = std::move(of_part);
      if (hierarchy)
        add_own_part(*hierarchy, problem, group);
      if (next.n_alike == 1)
        progress.log(fmt::format("{} processes share the mesh of {} cells and all that are finer", processes.size(), n_cells));
      else
        progress.log(
          fmt::format("{} groups of {} processes share the mesh of {} cells", processes.size() / next.n_alike, next.n_alike, n_cells));
    }
  }

  template <int dim>
  bool Discretisation<dim>::shares_coarse_mesh(const Problem<dim> &problem, const Processes &processes) const
  {
    // With geometric multigrid a level that every process knows has to come before.
    if (processes.alone() || hierarchy || !obstacle_to_sharing(problem, unknowns_on_finest(problem)).empty() ||
        problem.space.n_cells() < cells_to_share(problem) * processes.size())
      return false;
    if constexpr (dim > 1)
      if (const auto tied = tied_parts(problem); !tied.empty())
        return !problem.space.subdomain &&
               is_balanced(divide(*problem.space.mesh.triangulation, processes.size(), {}, tied), processes.size());
    return true;
  }

  template <int dim>
  void Discretisation<dim>::share_coarse_mesh(Problem<dim> &problem, const Processes &processes, Progress &progress)
  {
    std::vector<Vector> no_functions;
    std::vector<bool>   no_cells;
    if (!problem.space.subdomain && shares_coarse_mesh(problem, processes))
      share_work(problem, no_functions, no_cells, cells_to_come(problem), unknowns_on_finest(problem), /*refined_next=*/false, processes,
                 progress);
  }

  template <int dim>
  void Discretisation<dim>::refine(Problem<dim>                  &problem,
                                   std::vector<Vector>           &functions,
                                   const Processes               &processes,
                                   Progress                      &progress,
                                   const RefinementByError *const by_error)
  {
    std::vector<bool>   cells = by_error ? *by_error->cells : problem.cells_of_next_refinement();
    std::vector<double> weights;
    if (problem.space.refines_in_places()) // else each cell becomes as many
      weights = by_error ? by_error->expected : cells_to_come(problem);
    const double n_finest = by_error ? by_error->n_unknowns : unknowns_on_finest(problem);
    const bool   has_parts = bool(problem.space.subdomain);
    share_work(problem, functions, cells, weights, n_finest, /*refined_next=*/true, processes, progress);
    if (has_parts && !weights.empty())
      balance_parts(problem, functions, cells, weights, progress);
    problem.refine(functions, /*smoothly=*/true, by_error || !cells.empty() ? &cells : nullptr);
  }

  /// Where the parts of the mesh have become, or are about to become, of different size.
  template <int dim>
  void Discretisation<dim>::balance_parts(Problem<dim>              &problem,
                                          std::vector<Vector>       &functions,
                                          std::vector<bool>         &cells,
                                          const std::vector<double> &weights,
                                          Progress                  &progress) const
  {
    const bool as_divided = problem.space.lines_cut_by_refinement.empty();
    if (!problem.space.can_be_divided_anew())
      return;
    const double differ = largest_over_mean(std::accumulate(weights.begin(), weights.end(), 0.), problem.space.processes());
    if (differ > (as_divided ? parameters.imbalance : parameters.imbalance_once_refined) && problem.divide_anew(weights, functions, cells))
      progress.log(fmt::format("the mesh of {} cells is divided anew: one part would have come to {:.1f} times the mean",
                               problem.space.n_cells(), differ));
  }

  template std::vector<TiedParts> tied_parts(const Problem<1> &);
  template std::vector<TiedParts> tied_parts(const Problem<2> &);
  template std::vector<TiedParts> tied_parts(const Problem<3> &);
#define INSTANTIATE(dim)                                                                                                                   \
  template std::vector<double> cells_to_come(const Problem<dim> &);                                                                        \
  template bool                Discretisation<dim>::shares_coarse_mesh(const Problem<dim> &, const Processes &) const;                     \
  template void                Discretisation<dim>::share_coarse_mesh(Problem<dim> &, const Processes &, Progress &);                      \
  template void                Discretisation<dim>::say_if_not_shared(const Problem<dim> &, const Processes &, Progress &);                \
  template void                Discretisation<dim>::refine(Problem<dim> &, std::vector<Vector> &, const Processes &, Progress &,           \
                                                           const RefinementByError *);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
