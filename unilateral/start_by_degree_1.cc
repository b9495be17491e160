#include "unilateral/start_by_degree_1.h"

#include "unilateral/base/stopwatch.h"
#include "unilateral/discretisation/dear_functions.h"
#include "unilateral/discretisation/solver_choice.h"
#include "unilateral/inequality/penalty_parameter.h"
#include "unilateral/level_solve.h"
#include "unilateral/mesh/sent_part.h"
#include "unilateral/solution.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// The solver of degree 1 need not be more accurate than its mesh.
    constexpr double tolerance_of_guess = 1e-4;

    template <int dim>
    bool serves(const Problem<dim> &problem)
    {
      const auto &element = problem.space.element;
      const auto &own = problem.statement.own_form;
      const bool  lagrange = element.family == ElementName::Family::P || element.family == ElementName::Family::Q;
      const bool  refined_part =
        problem.space.subdomain && (problem.space.mesh.triangulation->n_levels() > 1 || !problem.space.lines_cut_by_refinement.empty());
      return dim > 1 && lagrange && element.degree > 1 && !problem.space.processes().any(refined_part) && problem.symmetric() &&
             problem.form->order() == 1 && !problem.form->projects_volume() && !own.in_1d && !own.in_2d && !own.in_3d &&
             !problem.space.processes().any(problem.space.mesh.triangulation->has_hanging_nodes());
    }

    template <int dim>
    Mesh<dim> copy_of(const Mesh<dim> &mesh)
    {
      Mesh<dim> copy;
      copy.triangulation = std::make_unique<Triangulation<dim>>();
      copy.triangulation->copy_triangulation(*mesh.triangulation);
      copy.part_names = mesh.part_names;
      copy.region_names = mesh.region_names;
      copy.curved = mesh.curved;
      copy.approximates_curves = mesh.approximates_curves;
      copy.simplex = mesh.simplex;
      return copy;
    }

    ProblemStatement with_degree_1(const ProblemStatement &statement)
    {
      ProblemStatement lower = statement;
      lower.model.element.degree = 1;
      lower.mesh.adapt.reset();
      lower.mesh.local.clear();
      lower.mesh.refine = 0;
      lower.output.probes_where.clear();
      lower.output.probes.clear();
      lower.functionals.clear();
      lower.method.tolerance = std::max(lower.method.tolerance, tolerance_of_guess);
      for (auto &constraint : lower.constraints)
        constraint.quadrature = {};
      return lower;
    }

    template <int dim>
    std::unique_ptr<Problem<dim>> lower_problem(const Problem<dim> &problem, Diagnostics &diagnostics)
    {
      const ProblemStatement statement = with_degree_1(problem.statement);
      if constexpr (dim > 1)
        if (problem.space.subdomain)
          return std::make_unique<Problem<dim>>(
            statement, ReceivedPart<dim>{copy_of(problem.space.mesh), without_whole(*problem.space.subdomain)}, problem.of_whole());
      return std::make_unique<Problem<dim>>(statement, copy_of(problem.space.mesh), diagnostics);
    }

    /// What is done here is part of the setup of the level.
    class Within : public Progress
    {
    public:
      explicit Within(const Progress &outer) : outer(outer) {}
      bool stop_requested() const override { return outer.stop_requested(); }

    private:
      const Progress &outer;
    };

    /// Functions of degree 1 at the nodes of another element on a copy of the mesh.
    template <int dim>
    std::vector<Vector> carry_over(const Problem<dim> &from, const std::vector<Vector> &functions, const Problem<dim> &to)
    {
      const auto                          &fe = *to.space.fe, &fe_from = *from.space.fe;
      std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell()), dofs_from(fe_from.n_dofs_per_cell());
      FullMatrix<double>                   values(dofs.size(), dofs_from.size()); // of the functions of degree 1 at nodes
      for (unsigned i = 0; i < dofs.size(); ++i)
        for (unsigned j = 0; j < dofs_from.size(); ++j)
          if (const auto [component, node] = fe.system_to_component_index(i); component == fe_from.system_to_component_index(j).first)
            values(i, j) = fe_from.shape_value(j, fe.get_unit_support_points()[i]);
      std::vector<Vector> result(functions.size(), Vector(to.space.dof_handler.n_dofs()));
      auto                cell_from = from.space.dof_handler.begin_active();
      for (const auto &cell : to.space.dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        cell_from->get_dof_indices(dofs_from);
        ++cell_from;
        for (std::size_t k = 0; k < functions.size(); ++k)
          for (unsigned i = 0; i < dofs.size(); ++i)
          {
            double sum = 0;
            for (unsigned j = 0; j < dofs_from.size(); ++j)
              sum += values(i, j) * functions[k](dofs_from[j]);
            result[k](dofs[i]) = sum;
          }
      }
      for (Vector &function : result) // rounded alike on all processes
        to.space.shared().take_from_owner(function.begin());
      return result;
    }
  } // namespace

  template <int dim>
  StartingGuess start_by_degree_1(const Problem<dim> &problem, Progress &progress)
  {
    if (!serves(problem))
      return {};
    const auto running = problem.time_by_part.run("guess");
    progress.phase("setup", "a guess by elements of degree 1");
    try
    {
      Diagnostics   of_guess;
      Within        within(progress);
      Stopwatch     watch;
      Solution<dim> solution;
      StartingGuess nothing;
      solution.problem = lower_problem(problem, of_guess);
      auto               &lower = *solution.problem;
      Discretisation<dim> discretisation(lower);
      PenaltyParameter    penalty(lower.statement.method, lower.statement.constrains_boundary());
      prepare_dear_functions(lower);
      solution.constraint_set = lower.make_constraint_set();
      auto lower_discrete = discretisation.on_level(lower, solution.constraint_set);
      penalty.start_level(*lower_discrete);
      start_from(nothing, *lower_discrete, lower, solution.constraint_set, solution.displacement, solution.contact_pressure);
      const auto outcome = solve_on_level(solution, lower_discrete, discretisation, penalty, nothing, {.finest = false}, watch, within);
      progress.log(fmt::format("guess by elements of degree 1: {} unknowns, {} Newton steps, {:.2f} s{}", lower.space.n_unknowns(),
                               outcome.history.size(), watch.lap() + solution.result.timing.solve,
                               outcome.converged ? "" : "; not taken: " + outcome.reason));
      if (!outcome.converged)
        return {};
      lower.space.dirichlet.distribute(solution.displacement);
      StartingGuess guess = guess_from(lower, solution.constraint_set, solution.displacement, solution.contact_pressure);
      guess.functions = carry_over(lower, guess.functions, problem);
      return guess;
    }
    catch (const Interrupted &)
    {
      throw;
    }
    catch (const std::exception &error)
    {
      progress.log(std::string("no guess by elements of degree 1: ") + error.what());
      return {};
    }
  }

#define INSTANTIATE(dim) template StartingGuess start_by_degree_1(const Problem<dim> &, Progress &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
