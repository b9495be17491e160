#include "unilateral/studies/epsilon_study.h"

#include "unilateral/discretisation/assembled.h"
#include "unilateral/evaluation/solution_norms.h"
#include "unilateral/inequality/augmented_problem.h"
#include "unilateral/inequality/certificate.h"
#include "unilateral/inequality/increment_problem.h"
#include "unilateral/inequality/method_of_multipliers.h"
#include "unilateral/inequality/multiplier_space.h"
#include "unilateral/output/results.h"
#include "unilateral/solve.h"
#include "unilateral/stability/form_constants.h"
#include "unilateral/stability/inf_sup.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>

#include <Eigen/CholmodSupport>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace unilateral
{
  using namespace dealii;
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// Where p_h is not unique the limit of p_eps is found with an epsilon that much smaller than the smallest of the study.
    constexpr double limit_factor = 1e-4;
    /// Relative accuracy of the solves.
    constexpr double accuracy = EpsilonStudy::accuracy;

    /// Is every bound a function of V_h? Compared with its interpolant at the points of a Gauss rule, to 1e-10 of its size.
    template <int dim>
    bool obstacle_in_V_h(const Problem<dim> &problem)
    {
      const auto              scalar = problem.space.nodes();
      std::vector<Point<dim>> nodes(scalar->n_dofs());
      DoFTools::map_dofs_to_support_points(*problem.space.mapping, *scalar, nodes);
      const auto flags = update_values | update_quadrature_points;
      for (const auto &condition : problem.conditions)
        try
        {
          if (condition.surface || problem.space.hermite())
            return false; // a field's interpolant is not made for these
          Vector interpolant(nodes.size());
          double size = 0, worst = 0;
          for (std::size_t j = 0; j < nodes.size(); ++j)
          {
            interpolant(j) = condition.bound.value(nodes[j]);
            size = std::max(size, std::abs(interpolant(j)));
          }
          std::vector<double> values;
          const auto          compare = [&](const FEValuesBase<dim> &on)
          {
            values.resize(on.n_quadrature_points);
            on.get_function_values(interpolant, values);
            for (const unsigned q : on.quadrature_point_indices())
              worst = std::max(worst, std::abs(values[q] - condition.bound.value(on.quadrature_point(q))));
          };
          FEValues<dim>     cell_values(*problem.space.mapping, scalar->get_fe(), problem.cell_quadrature(), flags);
          FEFaceValues<dim> face_values(*problem.space.mapping, scalar->get_fe(), problem.face_quadrature(), flags);
          for (const auto &cell : scalar->active_cell_iterators())
            if (!condition.part)
            {
              cell_values.reinit(cell);
              compare(cell_values);
            }
            else
              for (const auto face : cell->face_indices())
                if (cell->face(face)->at_boundary() && cell->face(face)->boundary_id() == *condition.part)
                {
                  face_values.reinit(cell, face);
                  compare(face_values);
                }
          if (worst > 1e-10 * size)
            return false;
        }
        catch (const InputError &)
        {
          return false; // a bound that has no value away from the points of I_G
        }
      return true;
    }

    /// ||d||_a. Modes that a does not see are taken out first: the rounding of a large one would hide the rest.
    double energy_norm_of(const DiscreteProblem &discrete, Vector d)
    {
      std::vector<Vector> orthonormal;
      for (Vector mode : discrete.null_space())
      {
        for (const Vector &other : orthonormal)
          mode.add(-(mode * other), other);
        mode *= 1 / mode.l2_norm();
        orthonormal.push_back(mode);
        d.add(-(d * mode), mode);
      }
      Vector Ad;
      discrete.initialize_dof_vector(Ad);
      discrete.apply_stiffness(Ad, d);
      return std::sqrt(std::max(0., d * Ad));
    }

    /// Ten decades down from ||u_h||_0 / ||p_h||_0, or from the local compliance where u_h is next to nothing, at a power of ten: in any
    /// units from "far too soft" to "hard".
    std::vector<double> default_values(const double norm_u, const double norm_p, const double compliance)
    {
      const double        top = std::round(std::log10(norm_p > 0 ? std::max(norm_u / norm_p, compliance) : compliance));
      std::vector<double> values;
      for (int k = 0; k < 10; ++k)
        values.push_back(std::pow(10., top - k));
      return values;
    }
  } // namespace

  template <int dim>
  EpsilonStudy
  study_epsilon(const ProblemStatement &statement, const EpsilonStudyOptions &options, Diagnostics &diagnostics, Progress &progress)
  {
    if (statement.constraints.empty())
      throw InputError(statement.model.where, "the case has no [constraint]: there is no penalty to study");
    EpsilonStudy study;

    // The reference: the mixed method.
    ProblemStatement mixed = statement;
    mixed.method.formulation = Method::Formulation::mixed;
    mixed.method.epsilon.reset();
    mixed.method.tolerance = std::min(statement.method.tolerance, accuracy);
    const Solution<dim> reference = solve<dim>(mixed, diagnostics, progress);
    if (!reference.result.converged)
      throw NoReference("the mixed method, against which the penalty is measured, did not converge: " + reference.result.reason);
    const Problem<dim>       &problem = *reference.problem;
    const ConstraintSet<dim> &set = reference.constraint_set;
    const auto                discrete = assemble(problem, set, {.solver = statement.method.solver}, /*with_gram=*/true);
    const MultiplierSpace     Q_h(*discrete);
    Vector                    u_h = reference.displacement, p_h = reference.contact_pressure;
    problem.space.dirichlet.set_zero(u_h);
    study.element = statement.model.element.name();
    for (const auto &block : set.blocks)
      if (study.quadrature.find(block.rule.name()) == std::string::npos)
        study.quadrature += (study.quadrature.empty() ? "" : ", ") + block.rule.name();
    study.n_dofs = problem.space.dof_handler.n_dofs();

    const double        compliance = set.size() > 0 ? discrete->compliance().linfty_norm() : 1.;
    std::vector<double> values = options.values;
    if (values.empty())
      values = default_values(reference.result.norm_L2, Q_h.norm(p_h), compliance);
    std::sort(values.begin(), values.end(), std::greater<>());
    values.erase(std::unique(values.begin(), values.end()), values.end());

    // Constants, as far as the size allows.
    progress.phase("constants", fmt::format("{} unknowns", problem.space.dof_handler.n_dofs()));
    const FreeUnknowns      free(problem);
    const InfSupLimits      limits = limits_for(dim);
    const std::vector<bool> everywhere = each_point_once(set, std::vector<bool>(set.size(), true));
    const bool              computable = free.n_free + set.size() <= limits.sparse;
    std::optional<Pairing>  pairing;
    if (computable)
      try
      {
        pairing = make_pairing(problem, set, everywhere, PairingKind::by_rule);
        const FormConstants form = form_constants(free.restricted(discrete->stiffness_matrix()), pairing->gram, discrete->symmetric());
        study.constants.m = form.m;
        study.constants.M = form.M;
        const bool             by_L2 = set.blocks[0].exact_pairing && has_polynomials(problem, set);
        std::optional<Pairing> dual;
        if (n_dual_unknowns(problem) <= limits.dual)
          dual = make_dual_pairing(problem, set, everywhere, by_L2 ? PairingKind::by_L2 : PairingKind::by_rule);
        const InfSup all = inf_sup(*pairing, dual ? &*dual : nullptr);
        study.constants.C_h = all.C_h;
        study.constants.beta_h = all.beta_h;
        study.constants.nullity = all.nullity;
      }
      catch (const std::runtime_error &failure)
      {
        study.constants.missing = failure.what();
      }
    else
      study.constants.missing = fmt::format("{} unknowns and {} points are more than the {} for which constants are computed", free.n_free,
                                            set.size(), limits.sparse);

    // The penalty solutions u_h + d, from the smallest epsilon up: each is close to the one before.
    IncrementProblem     increment(*discrete, u_h, p_h);
    const bool           kernel = !study.constants.nullity || *study.constants.nullity > 0;
    MultiplierParameters parameters{.tolerance = accuracy,
                                    // Where the pressure is not unique, only lambda = (Bu - s)^+/eps itself picks the right one.
                                    .shift = kernel ? 0. : suitable_shift(set.at_nodes())};
    Vector               d, lambda = p_h;
    discrete->initialize_dof_vector(d);
    if (kernel)
    {
      parameters.epsilon = limit_factor * values.back();
      progress.phase("solve", "the multiplier of minimal norm");
      method_of_multipliers(increment, parameters, positive(p_h), d, lambda, progress);
      p_h = lambda;
    }
    const auto with_dirichlet = [&](const Vector &v)
    {
      Vector u = u_h;
      u += v;
      problem.space.dirichlet.distribute(u);
      return u;
    };
    const auto norm_V = [&](const Vector &u)
    {
      const auto norms = solution_norms(problem, u);
      return std::hypot(norms.L2, norms.H1_semi);
    };
    study.reference = {norm_V(reference.displacement), Q_h.norm(p_h), 0, reference.result.energy, reference.result.newton_iterations};
    const auto force = [&](const Vector &pressure) { return pressure * discrete->weights(); };
    study.reference.total_contact_force = force(p_h);
    std::vector<bool> ever_active = positive(p_h);
    Vector            Hd, Ad;
    discrete->initialize_dof_vector(Hd);
    discrete->initialize_dof_vector(Ad);
    discrete->apply_stiffness(Ad, u_h);
    // Of u_h, or of what the pressure would do to its own points where u_h is next to nothing.
    const double energy_norm = std::max(std::sqrt(std::abs(u_h * Ad)), study.reference.norm_p * std::sqrt(compliance));
    for (std::size_t k = values.size(); k-- > 0;)
    {
      if (progress.stop_requested())
        throw Interrupted();
      EpsilonStudy::Row row;
      row.epsilon = parameters.epsilon = values[k];
      // The scale of the solver's tolerance is that of lambda, which d falls below like epsilon over the compliance.
      parameters.tolerance = accuracy * std::clamp(row.epsilon / compliance, 1e-3, 1.);
      progress.phase("solve", fmt::format("epsilon {:.3g}", row.epsilon));
      const MultiplierResult outcome = method_of_multipliers(increment, parameters, positive(lambda), d, lambda, progress);
      row.converged = outcome.converged;
      row.newton_iterations = outcome.history.size();
      row.linear_iterations = outcome.linear_iterations;

      discrete->apply_gram(Hd, d);
      discrete->apply_stiffness(Ad, d);
      row.u_error_V = std::sqrt(d * Hd);
      row.u_error_energy = energy_norm_of(*discrete, d);
      row.at_round_off = row.u_error_energy < 1e-12 * energy_norm;
      Vector difference = lambda;
      difference -= p_h;
      row.p_error_L2 = Q_h.norm(difference);
      row.norm_u_V = norm_V(with_dirichlet(d));
      row.norm_p = Q_h.norm(lambda);
      row.penetration_L2 = row.epsilon * row.norm_p;
      row.max_penetration = row.epsilon * (lambda.size() > 0 ? lambda.linfty_norm() : 0.);
      row.total_contact_force = force(lambda);
      // f(d) - a(u_h, d) = (lambda_h, d)_G.
      row.bound_penetration = std::sqrt(std::max(0., row.epsilon * (Q_h.pairing(p_h, d) - d * Ad)));
      const Certificate certificate = certify(increment, row.epsilon, suitable_shift(set.at_nodes()), d, lambda, progress);
      if (certificate.available)
        row.bound_u_gap = certificate.penalty_error_bound;
      for (std::size_t i = 0; i < lambda.size(); ++i)
        if (lambda(i) > 0)
          ever_active[i] = true;
      study.rows.insert(study.rows.begin(), row);
    }

    if (study.constants.C_h)
    {
      if (std::find(ever_active.begin(), ever_active.end(), true) != ever_active.end())
        study.constants.C_h_active = inf_sup(make_pairing(problem, set, each_point_once(set, ever_active), PairingKind::by_rule)).C_h;
      // (13): m ||u_eps - u_h||^2 <= (lambda_h, u_eps - u_h)_G <= ||B'W lambda_h||' ||u_eps - u_h||.
      Vector r;
      discrete->initialize_dof_vector(r);
      discrete->apply_trace_transpose(r, p_h);
      Eigen::VectorXd residual(free.n_free);
      for (std::size_t j = 0; j < r.size(); ++j)
        if (free[j] >= 0)
          residual(free[j]) = r(j);
      const Eigen::CholmodDecomposition<SparseMatrixd, Eigen::Upper> gram(pairing->gram);
      const Eigen::VectorXd                                          lifted = gram.solve(residual);
      if (*study.constants.m > 0)
        study.bound_norm_u = study.reference.norm_u_V + std::sqrt(residual.dot(lifted)) / *study.constants.m;
    }
    study.hypotheses.symmetric = discrete->symmetric();
    study.hypotheses.exact_pairing = std::all_of(set.blocks.begin(), set.blocks.end(), [](const auto &b) { return b.exact_pairing; });
    study.hypotheses.obstacle_in_V_h = obstacle_in_V_h(problem);
    judge(study);
    return study;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template EpsilonStudy study_epsilon<dim>(const ProblemStatement &, const EpsilonStudyOptions &, Diagnostics &, Progress &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
