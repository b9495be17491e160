#include "unilateral/outcome.h"

#include "unilateral/solution_norms.h"

#include <algorithm>
#include <cmath>

namespace unilateral
{
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
    report.n_cells = problem.mesh.triangulation->n_active_cells();
    report.n_dofs = problem.dof_handler.n_dofs();
    report.n_points = lambda.size();
    report.n_active = std::count_if(lambda.begin(), lambda.end(), [](double pressure) { return pressure > 0; });
    report.n_flipped = outcome.flipped;
    report.outer_iterations = outcome.outer_iterations;
    report.newton_iterations = outcome.history.size();
    report.linear_iterations = outcome.linear_iterations;
    report.operator_applications = discrete.n_operator_applications();
    report.residual = std::max(outcome.equilibrium, outcome.complementarity);
    report.seconds = seconds;
    report.converged = outcome.converged;
    report.linear_solver = discrete.linear_solver_name();
    report.reason = outcome.reason;
    report.history = outcome.history;
    return report;
  }

  template <int dim>
  std::vector<ConstraintResult>
  constraint_results(const ConstraintSet<dim> &constraint_set, const double epsilon, const Vector &u, const Vector &lambda)
  {
    const auto                    values = constraint_set.values_of(u);
    std::vector<ConstraintResult> results;
    for (const auto &block : constraint_set.blocks)
    {
      ConstraintResult result;
      result.on = block.on;
      result.side = block.side == Side::lower ? "lower" : "upper";
      result.quadrature = block.rule.name();
      result.n_points = block.end - block.begin;
      result.exact_pairing = block.exact_pairing;
      for (std::size_t i = block.begin; i < block.end; ++i)
      {
        const double w = constraint_set.weights[i];
        const double overlap = constraint_set.sign[i] * (values[i] - constraint_set.bound[i]); // Bu - s
        result.max_penetration = std::max(result.max_penetration, overlap);
        result.complementarity += w * lambda(i) * std::abs(overlap - epsilon * lambda(i));
        result.total_contact_force += w * lambda(i);
        result.pressure_L2 += w * lambda(i) * lambda(i);
        result.max_contact_pressure = std::max(result.max_contact_pressure, lambda(i));
        if (lambda(i) > 0)
        {
          ++result.n_active;
          result.contact_measure += w;
        }
      }
      result.pressure_L2 = std::sqrt(result.pressure_L2);
      results.push_back(result);
    }
    return results;
  }

  template <int dim>
  void describe_outcome(RunResult                &result,
                        const Problem<dim>       &problem,
                        const ConstraintSet<dim> &constraint_set,
                        const DiscreteProblem    &discrete,
                        const PenaltyParameter   &penalty,
                        const MultiplierResult   &outcome,
                        const Vector             &u,
                        const Vector             &lambda)
  {
    result.converged = outcome.converged;
    result.reason = outcome.reason;

    result.dimension = dim;
    result.n_cells = problem.mesh.triangulation->n_active_cells();
    result.n_dofs = problem.dof_handler.n_dofs();
    result.n_levels = problem.level + 1;
    std::tie(result.h_min, result.h_max) = problem.cell_sizes();
    result.element = problem.request.model.element.name();
    result.m = 1;

    result.constraints = constraint_results(constraint_set, penalty.epsilon(), u, lambda);

    const MethodSpec &method = problem.request.method;
    result.formulation = method.formulation == MethodSpec::Formulation::mixed ? "mixed" : "penalty";
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
    result.probes = probe_values(problem, u);
    if (problem.request.exact.u || problem.request.exact.pressure)
      result.errors = solution_errors(problem, constraint_set, u, lambda);

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

#define INSTANTIATE(dim)                                                                                                                   \
  template LevelReport level_report(unsigned, const Problem<dim> &, const DiscreteProblem &, const MultiplierResult &, const Vector &,     \
                                    double);                                                                                               \
  template std::vector<ConstraintResult> constraint_results(const ConstraintSet<dim> &, double, const Vector &, const Vector &);           \
  template void describe_outcome(RunResult &, const Problem<dim> &, const ConstraintSet<dim> &, const DiscreteProblem &,                   \
                                 const PenaltyParameter &, const MultiplierResult &, const Vector &, const Vector &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
