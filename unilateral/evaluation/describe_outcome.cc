#include "unilateral/evaluation/describe_outcome.h"

#include "unilateral/base/processes.h"
#include "unilateral/evaluation/contact_components.h"
#include "unilateral/evaluation/coupling_results.h"
#include "unilateral/evaluation/equilibrium.h"
#include "unilateral/evaluation/functionals.h"
#include "unilateral/evaluation/probes.h"
#include "unilateral/evaluation/remark_on_rules.h"
#include "unilateral/evaluation/residual_at_nodes.h"
#include "unilateral/evaluation/solution_errors.h"
#include "unilateral/evaluation/solution_norms.h"
#include "unilateral/evaluation/upward_axis.h"
#include "unilateral/forms/elasticity.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  namespace
  {
    /// Of several processes each has all points then.
    constexpr std::uint64_t most_points_of_components = 1000000;

    /// Of the energy norm, for a solution to be called solved.
    constexpr double largest_algebraic_error = 0.2;
  } // namespace

  namespace types = dealii::types;

  template <int dim>
  LevelReport level_report(const unsigned          level,
                           const Problem<dim>     &problem,
                           const DiscreteProblem  &discrete,
                           const MultiplierResult &outcome,
                           const Vector           &lambda,
                           const double            seconds)
  {
    LevelReport report;
    report.level = level;
    report.n_cells = problem.space.n_cells();
    report.n_dofs = problem.space.n_unknowns();
    report.n_points = std::llround(discrete.sum_over_points([](std::size_t) { return 1.; }));
    report.n_active = std::llround(discrete.sum_over_points([&](const std::size_t i) { return lambda(i) > 0 ? 1. : 0.; }));
    report.n_flipped = outcome.flipped;
    report.outer_iterations = outcome.outer_iterations;
    report.newton_iterations = outcome.history.size();
    report.linear_iterations = outcome.linear_iterations;
    report.operator_applications = discrete.n_operator_applications();
    if constexpr (dim > 1)
      if (problem.space.subdomain)
        report.largest_part = largest_over_mean(problem.space.mesh.triangulation->n_active_cells(), problem.space.processes());
    report.residual = std::max(outcome.equilibrium, outcome.complementarity);
    report.seconds = seconds;
    report.converged = outcome.converged;
    report.linear_solver = discrete.linear_solver_name();
    report.reason = outcome.reason;
    report.history = outcome.history;
    return report;
  }

  template <int dim>
  std::vector<ConstraintResult> constraint_results(
    const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const double epsilon, const Vector &u, const Vector &lambda)
  {
    const auto                    running = problem.time_by_part.run("contact");
    const auto                    values = constraint_set.values_of(u);
    std::vector<ConstraintResult> results;
    for (const auto &block : constraint_set.blocks)
    {
      ConstraintResult result;
      result.on = block.on;
      result.side = block.side == Side::lower ? "lower" : "upper";
      result.quadrature = block.rule.name();
      result.exact_pairing = block.exact_pairing;
      std::uint64_t n_points = 0, n_active = 0;
      for (std::size_t i = block.begin; i < block.end; ++i)
      {
        if (!constraint_set.owns(i))
          continue;
        ++n_points;
        const double w = constraint_set.points[i].weight;
        const double overlap = constraint_set.points[i].sign * (values[i] - constraint_set.points[i].bound); // Bu - s
        result.max_penetration = std::max(result.max_penetration, overlap);
        result.complementarity += w * lambda(i) * std::abs(overlap - epsilon * lambda(i));
        result.total_contact_force += w * lambda(i);
        result.pressure_L2 += w * lambda(i) * lambda(i);
        result.max_contact_pressure = std::max(result.max_contact_pressure, lambda(i));
        if (lambda(i) > 0)
        {
          ++n_active;
          result.contact_measure += w;
        }
      }
      const Processes &processes = problem.space.processes();
      result.n_points = processes.sum(n_points);
      result.n_active = processes.sum(n_active);
      for (double *const sum : {&result.complementarity, &result.total_contact_force, &result.pressure_L2, &result.contact_measure})
        *sum = processes.sum(*sum);
      for (double *const largest : {&result.max_penetration, &result.max_contact_pressure})
        *largest = processes.max(*largest);
      result.pressure_L2 = std::sqrt(result.pressure_L2);
      if (problem.form->order() > 1)
      {
        if (processes.alone() || result.n_points <= most_points_of_components)
          result.components = contact_components(problem, constraint_set, results.size(), lambda);
        double concentrated = 0;
        for (const auto &component : result.components.value_or(std::vector<ContactComponent>()))
          concentrated += component.concentrated;
        result.concentrated = concentrated > 0.01 * result.total_contact_force;
      }
      if (problem.form->order() == 0)
        result.max_violation_between_points = largest_violation(problem, problem.conditions[results.size()], u);
      if (problem.form->n_components() > 1)
      {
        const auto on_body = contact_force(problem, constraint_set, block, lambda);
        result.contact_force = on_body.force;
        result.contact_moment = on_body.moment;
        result.n_missed = processes.sum(std::uint64_t(block.n_missed));
      }
      results.push_back(result);
    }
    return results;
  }

  namespace
  {
    /// Stress and forces of an elastic body.
    template <int dim>
    void describe_body(RunResult                &result,
                       const Problem<dim>       &problem,
                       const ConstraintSet<dim> &constraint_set,
                       const Vector             &u,
                       const Vector             &lambda,
                       const RecoveredFlux<dim> &stress)
    {
      const auto running = problem.time_by_part.run("forces");
      result.max_von_mises = 0;
      for (types::global_dof_index node = 0; node < stress.nodes->n_dofs(); ++node)
        for (types::material_id region = 0; region < problem.space.mesh.region_names.size(); ++region)
          result.max_von_mises = std::max(*result.max_von_mises, von_mises(stress.at(node, region)));
      result.max_von_mises = problem.space.processes().max(*result.max_von_mises);
      result.balance = force_balance(problem, constraint_set, u, lambda);
      result.platens = platen_results(problem, constraint_set, u, lambda);
    }
  } // namespace

  template <int dim>
  void describe_outcome(RunResult                &result,
                        const Problem<dim>       &problem,
                        const ConstraintSet<dim> &constraint_set,
                        const DiscreteProblem    &discrete,
                        const PenaltyParameter   &penalty,
                        const MultiplierResult   &outcome,
                        const Vector             &u,
                        const Vector             &lambda,
                        const RecoveredFlux<dim> &flux)
  {
    result.converged = outcome.converged;
    result.reason = outcome.reason;

    result.n_processes = Processes::all().size();
    result.dimension = dim;
    result.n_cells = problem.space.n_cells();
    result.n_dofs = problem.space.n_unknowns();
    result.n_levels = problem.space.level + 1;
    std::tie(result.h_min, result.h_max) = problem.space.cell_sizes();
    result.upward_axis = upward_axis(problem.statement);
    result.element = problem.statement.model.element.name();
    result.m = problem.form->order();

    result.constraints = constraint_results(problem, constraint_set, penalty.epsilon(), u, lambda);

    const Method &method = problem.statement.method;
    result.formulation = method.formulation == Method::Formulation::mixed ? "mixed" : "penalty";
    result.epsilon = penalty.epsilon();
    result.epsilon_reason = penalty.reason();
    result.linear_solver = discrete.linear_solver_name();
    result.tolerance = method.tolerance;
    if (method.penalty_tolerance && result.certificate)
      result.certificate_holds =
        result.certificate->available && result.certificate->penalty_error_bound <= asked_penalty_error(method, *result.certificate);

    const auto norms = solution_norms(problem, u);
    result.energy = norms.energy;
    result.norm_L2 = norms.L2;
    result.norm_H1_semi = norms.H1_semi;
    result.min = norms.min;
    result.max = norms.max;
    result.probes = probe_values(problem, u, flux);
    result.functionals = functional_values(problem, constraint_set, u, lambda, flux);
    if (problem.form->order() > 1)
    {
      result.norm_H2_semi = norms.H2_semi;
      result.reactions = support_reactions(problem, constraint_set, u, lambda);
    }
    if (problem.form->n_components() > 1)
    {
      describe_body(result, problem, constraint_set, u, lambda, flux);
      // Where nothing deforms, all forces are rounding, and so is their balance.
      if (const double imbalance = result.balance->residual;
          result.converged && !result.nothing_deforms() && !(imbalance <= std::max(1e-6, 100 * method.tolerance)))
      {
        result.converged = false;
        result.reason = fmt::format("not in equilibrium: the forces on the body are out of balance by {:.1e}", imbalance);
      }
      else if (result.converged && result.balance->side_conditions > 1e-3)
      {
        result.converged = false;
        result.reason =
          fmt::format("not in equilibrium: neither contact nor load should know of a {}, but the side condition that stops it "
                      "bears {:.1e} of the load; hold it by [boundary], or refine the mesh at the contact",
                      fmt::join(result.balance->side_conditions_on, " and a "), result.balance->side_conditions);
      }
    }
    else if (problem.form->order() <= 1 && result.converged && result.reference_norm() > 0 &&
             !(result.estimate && result.estimate->guaranteed))
    {
      // A bound that is guaranteed is made from u without the operators of the solver.
      const double residual = residual_at_nodes(problem, constraint_set, u, lambda);
      if (!(residual <= std::max(1e-6, 100 * method.tolerance) * result.reference_norm()))
      {
        result.converged = false;
        result.reason =
          fmt::format("not in equilibrium: the residual at the nodes, without the operators of the solver, is {:.1e} of the energy norm",
                      residual / result.reference_norm());
      }
    }
    if (const auto &certificate = result.certificate; result.converged && certificate && certificate->available &&
                                                      result.reference_norm() > 0 &&
                                                      certificate->algebraic_error > largest_algebraic_error * result.reference_norm())
    {
      result.converged = false;
      result.reason =
        fmt::format("the solver, rounding included, may leave an error of {:.0f} % of the energy norm of the solution: stiffnesses, "
                    "or the way that the body is moved and its deformation, differ by too many orders of magnitude",
                    100 * certificate->algebraic_error / result.reference_norm());
    }
    if (const std::string remark = result.converged ? "" : remark_on_rules(problem, constraint_set); !remark.empty())
      result.reason += "; " + remark;
    result.periodic = periodic_results(problem, constraint_set, u, lambda);
    if (!problem.statement.exact.u.empty() || problem.statement.exact.pressure)
      result.errors = solution_errors(problem, constraint_set, u, lambda);
    if (result.estimate && result.estimate->guaranteed && !result.converged)
    {
      result.estimate->guaranteed = false;
      result.estimate->reason = "the solution is not one: " + result.reason;
    }
    // An error that is nothing but round-off says nothing of the bound, and neither does the distance from samples.
    const auto &exact = problem.statement.exact.u;
    const bool  sampled = std::any_of(exact.begin(), exact.end(), [](const FieldFunction &u) { return u.sample_spacing() > 0; });
    if (result.estimate && result.errors && !sampled && result.reference_norm() > 0 &&
        result.errors->energy.value_or(0) > 1e-12 * result.energy_norm)
      result.estimate->effectivity = result.estimate->total / *result.errors->energy;

    // Work on a coarser level counts by its share of the unknowns.
    double applications = 0;
    for (const auto &level : result.levels)
    {
      result.outer_iterations += level.outer_iterations;
      result.newton_iterations += level.newton_iterations;
      result.linear_iterations += level.linear_iterations;
      applications += double(level.operator_applications) * level.n_dofs / result.n_dofs;
    }
    result.fine_operator_applications = std::llround(applications);
  }

  void warn_about_side_conditions(const RunResult &result, const ProblemStatement &statement, Diagnostics &diagnostics)
  {
    if (result.balance && result.balance->side_conditions > 1e-6)
      diagnostics.warning(
        statement.model.where,
        fmt::format("load and contact act a little on a {}, which nothing holds: the side condition that stops it bears {:.1e} of the "
                    "load; hold it by [boundary], or refine the mesh",
                    fmt::join(result.balance->side_conditions_on, " and a "), result.balance->side_conditions),
        MessageName("slight-resistance"));
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template LevelReport level_report(unsigned, const Problem<dim> &, const DiscreteProblem &, const MultiplierResult &, const Vector &,     \
                                    double);                                                                                               \
  template std::vector<ConstraintResult> constraint_results(const Problem<dim> &, const ConstraintSet<dim> &, double, const Vector &,      \
                                                            const Vector &);                                                               \
  template void describe_outcome(RunResult &, const Problem<dim> &, const ConstraintSet<dim> &, const DiscreteProblem &,                   \
                                 const PenaltyParameter &, const MultiplierResult &, const Vector &, const Vector &,                       \
                                 const RecoveredFlux<dim> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
