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
#include <memory>
#include <stdexcept>

namespace unilateral
{
  using namespace dealii;
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// Where p_h is not unique the limit of p_eps is found with an epsilon that much smaller than the smallest of the study.
    constexpr double limit_factor = 1e-4;
    /// But no smaller than this part of the compliance: beside 1/epsilon the stiffness would be lost in round-off.
    constexpr double least_limit = 1e-14;
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

    /// Throws NoReference.
    template <int dim>
    Solution<dim> solve_by_mixed_method(const ProblemStatement &statement, Diagnostics &diagnostics, Progress &progress)
    {
      ProblemStatement mixed = statement;
      mixed.mesh.adapt.reset(); // one mesh for all epsilons
      mixed.method.formulation = Method::Formulation::mixed;
      mixed.method.epsilon.reset();
      mixed.method.tolerance = std::min(statement.method.tolerance, accuracy);
      Solution<dim> solution = solve<dim>(mixed, diagnostics, progress);
      if (!solution.result.converged)
        throw NoReference("the mixed method, against which the penalty is measured, did not converge: " + solution.result.reason);
      return solution;
    }

    /// The solution of the mixed method, against which the penalty is measured, and the discrete problem it solves.
    template <int dim>
    struct MixedReference
    {
      MixedReference(const ProblemStatement &statement, Diagnostics &diagnostics, Progress &progress)
        : solution(solve_by_mixed_method<dim>(statement, diagnostics, progress)), problem(*solution.problem), set(solution.constraint_set),
          discrete(assemble(problem, set, {.solver = statement.method.solver}, /*with_gram=*/true)), Q_h(*discrete),
          u_h(solution.displacement), p_h(solution.contact_pressure), compliance(set.size() > 0 ? discrete->compliance().linfty_norm() : 1.)
      {
        problem.space.dirichlet.set_zero(u_h);
      }
      MixedReference(const MixedReference &) = delete; // it holds references to its own members

      /// ||u||_V, u with its Dirichlet values.
      double norm_V(const Vector &u) const
      {
        const auto norms = solution_norms(problem, u);
        return std::hypot(norms.L2, norms.H1_semi);
      }

      const Solution<dim>              solution;
      const Problem<dim>              &problem;
      const ConstraintSet<dim>        &set;
      const std::unique_ptr<Assembled> discrete;
      const MultiplierSpace            Q_h;
      Vector                           u_h; ///< without its Dirichlet values
      const Vector                     p_h; ///< one of several where the pressure is not unique
      const double                     compliance;
    };

    /// Names of the rules of all blocks, each once.
    template <int dim>
    std::string rule_names(const ConstraintSet<dim> &set)
    {
      std::string names;
      for (const auto &block : set.blocks)
        if (names.find(block.rule.name()) == std::string::npos)
          names += (names.empty() ? "" : ", ") + block.rule.name();
      return names;
    }

    /// From the largest to the smallest, each once.
    template <int dim>
    std::vector<double> values_of_epsilon(std::vector<double> values, const MixedReference<dim> &mixed)
    {
      if (values.empty())
        values = default_values(mixed.solution.result.norm_L2, mixed.Q_h.norm(mixed.p_h), mixed.compliance);
      std::sort(values.begin(), values.end(), std::greater<>());
      values.erase(std::unique(values.begin(), values.end()), values.end());
      return values;
    }

    /// Constants of the form and of all points, as far as the size allows. Returns the pairing on V_h they are computed from.
    template <int dim>
    std::optional<Pairing> add_constants(EpsilonStudy &study, const MixedReference<dim> &mixed, const FreeUnknowns &free)
    {
      const Problem<dim>       &problem = mixed.problem;
      const ConstraintSet<dim> &set = mixed.set;
      const InfSupLimits        limits = limits_for(dim);
      const std::vector<bool>   everywhere = each_point_once(set, std::vector<bool>(set.size(), true));
      std::optional<Pairing>    pairing;
      if (free.n_free + set.size() > limits.sparse)
      {
        study.constants.missing = fmt::format("{} unknowns and {} points are more than the {} for which constants are computed",
                                              free.n_free, set.size(), limits.sparse);
        return pairing;
      }
      try
      {
        pairing = make_pairing(problem, set, everywhere, PairingKind::by_rule);
        const FormConstants form =
          form_constants(free.restricted(mixed.discrete->stiffness_matrix()), pairing->gram, mixed.discrete->symmetric());
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
      return pairing;
    }

    /// The penalty solutions u_h + d for one epsilon after another, from the smallest up: each starts from the one before, which is close.
    template <int dim>
    class PenaltySolutions
    {
    public:
      /// Where @p pressure_is_unique is false, p_h becomes the multiplier of minimal norm, the limit of the penalty's pressure.
      PenaltySolutions(const MixedReference<dim> &mixed, bool pressure_is_unique, double smallest_epsilon, Progress &progress);

      /// The numbers of the penalty solution.
      EpsilonStudy::Row row(double epsilon, Progress &progress);

      /// The numbers of the mixed solution.
      const EpsilonStudy::Reference &reference() const { return mixed_numbers; }
      const Vector                  &limit_pressure() const { return p_h; }
      const std::vector<bool>       &active_for_some_epsilon() const { return ever_active; }

    private:
      void find_pressure_of_minimal_norm(double epsilon, Progress &progress);
      void measure_reference();
      void measure_differences(EpsilonStudy::Row &row);

      double total_force(const Vector &pressure) const { return pressure * discrete.weights(); }

      const MixedReference<dim> &mixed;
      Assembled                 &discrete;
      IncrementProblem           increment;
      MultiplierParameters       parameters;
      const double               shift; ///< of the certificate
      Vector                     p_h, d, lambda;
      Vector                     Hd, Ad;
      EpsilonStudy::Reference    mixed_numbers;
      bool                       reference_converged = true; ///< p_h is what the errors are to be measured against
      double            energy_norm = 0; ///< of u_h, or of what the pressure would do to its own points where u_h is next to nothing
      std::vector<bool> ever_active;
    };

    template <int dim>
    PenaltySolutions<dim>::PenaltySolutions(const MixedReference<dim> &mixed,
                                            const bool                 pressure_is_unique,
                                            const double               smallest_epsilon,
                                            Progress                  &progress)
      : mixed(mixed), discrete(*mixed.discrete), increment(discrete, mixed.u_h, mixed.p_h), shift(suitable_shift(mixed.set.at_nodes())),
        p_h(mixed.p_h), lambda(mixed.p_h)
    {
      parameters.tolerance = accuracy;
      // Where the pressure is not unique, only lambda = (Bu - s)^+/eps itself picks the right one.
      parameters.shift = pressure_is_unique ? shift : 0.;
      for (Vector *const v : {&d, &Hd, &Ad})
        discrete.initialize_dof_vector(*v);
      if (!pressure_is_unique)
        find_pressure_of_minimal_norm(std::max(limit_factor * smallest_epsilon, least_limit * mixed.compliance), progress);
      measure_reference();
      ever_active = positive(p_h);
    }

    template <int dim>
    void PenaltySolutions<dim>::find_pressure_of_minimal_norm(const double epsilon, Progress &progress)
    {
      parameters.epsilon = epsilon;
      progress.phase("solve", "the multiplier of minimal norm");
      reference_converged = method_of_multipliers(increment, parameters, positive(p_h), d, lambda, progress).converged;
      p_h = lambda;
    }

    template <int dim>
    void PenaltySolutions<dim>::measure_reference()
    {
      const RunResult &result = mixed.solution.result;
      mixed_numbers = {mixed.norm_V(mixed.solution.displacement), mixed.Q_h.norm(p_h), total_force(p_h), result.energy,
                       result.newton_iterations};
      discrete.apply_stiffness(Ad, mixed.u_h);
      energy_norm = std::max(std::sqrt(std::abs(mixed.u_h * Ad)), mixed_numbers.norm_p * std::sqrt(mixed.compliance));
    }

    template <int dim>
    EpsilonStudy::Row PenaltySolutions<dim>::row(const double epsilon, Progress &progress)
    {
      EpsilonStudy::Row row;
      row.epsilon = parameters.epsilon = epsilon;
      // The scale of the solver's tolerance is that of lambda, which d falls below like epsilon over the compliance.
      parameters.tolerance = std::clamp(accuracy * epsilon / mixed.compliance, EpsilonStudy::round_off, accuracy);
      progress.phase("solve", fmt::format("epsilon {:.3g}", epsilon));
      const MultiplierResult outcome = method_of_multipliers(increment, parameters, positive(lambda), d, lambda, progress);
      row.converged = outcome.converged && reference_converged;
      row.newton_iterations = outcome.history.size();
      row.linear_iterations = outcome.linear_iterations;
      measure_differences(row);
      const Certificate certificate = certify(increment, epsilon, shift, d, lambda, progress);
      if (certificate.available)
        row.bound_u_gap = certificate.penalty_error_bound;
      if (!outcome.converged) // the next one starts from the mixed solution
      {
        d = 0;
        lambda = p_h;
      }
      for (std::size_t i = 0; i < lambda.size(); ++i)
        if (lambda(i) > 0)
          ever_active[i] = true;
      return row;
    }

    template <int dim>
    void PenaltySolutions<dim>::measure_differences(EpsilonStudy::Row &row)
    {
      discrete.apply_gram(Hd, d);
      discrete.apply_stiffness(Ad, d);
      row.u_error_V = std::sqrt(d * Hd);
      row.u_error_energy = energy_norm_of(discrete, d);
      row.at_round_off = row.u_error_energy < 1e-12 * energy_norm;
      row.relative_round_off = row.u_error_energy > 0 ? EpsilonStudy::round_off * energy_norm / row.u_error_energy : 0.;
      Vector difference = lambda;
      difference -= p_h;
      row.p_error_L2 = mixed.Q_h.norm(difference);
      Vector u = mixed.u_h;
      u += d;
      mixed.problem.space.dirichlet.distribute(u);
      row.norm_u_V = mixed.norm_V(u);
      row.norm_p = mixed.Q_h.norm(lambda);
      row.penetration_L2 = row.epsilon * row.norm_p;
      row.max_penetration = row.epsilon * (lambda.size() > 0 ? lambda.linfty_norm() : 0.);
      row.total_contact_force = total_force(lambda);
      // f(d) - a(u_h, d) = (lambda_h, d)_G.
      row.bound_penetration = std::sqrt(std::max(0., row.epsilon * (mixed.Q_h.pairing(p_h, d) - d * Ad)));
    }

    /// ||B'W lambda||', the dual norm on V_h. @p gram: H on the free unknowns.
    double dual_norm_of_contact_load(const Assembled &discrete, const Vector &lambda, const FreeUnknowns &free, const SparseMatrixd &gram)
    {
      Vector r;
      discrete.initialize_dof_vector(r);
      discrete.apply_trace_transpose(r, lambda);
      Eigen::VectorXd residual(free.n_free);
      for (std::size_t j = 0; j < r.size(); ++j)
        if (free[j] >= 0)
          residual(free[j]) = r(j);
      const Eigen::CholmodDecomposition<SparseMatrixd, Eigen::Upper> factorisation(gram);
      const Eigen::VectorXd                                          lifted = factorisation.solve(residual);
      return std::sqrt(residual.dot(lifted));
    }

    std::vector<bool> active_on_any(const Processes &processes, const std::vector<bool> &active)
    {
      std::vector<double> sums(active.begin(), active.end());
      processes.sum(sums.data(), sums.size());
      std::vector<bool> result;
      for (const double sum : sums)
        result.push_back(sum > 0);
      return result;
    }

    /// C_h of the points that are active for some epsilon.
    template <int dim>
    std::optional<double> C_h_of(const std::vector<bool> &active, const MixedReference<dim> &mixed)
    {
      if (std::find(active.begin(), active.end(), true) == active.end())
        return {};
      return inf_sup(make_pairing(mixed.problem, mixed.set, each_point_once(mixed.set, active), PairingKind::by_rule)).C_h;
    }
  } // namespace

  template <int dim>
  EpsilonStudy study_epsilon(const ProblemStatement    &statement,
                             const EpsilonStudyOptions &options,
                             Diagnostics               &diagnostics,
                             Progress                  &progress,
                             const Processes           &processes)
  {
    if (statement.constraints.empty())
      throw InputError(statement.model.where, "the case has no [constraint]: there is no penalty to study",
                       MessageName("nothing-to-study"));
    EpsilonStudy              study;
    const MixedReference<dim> mixed(statement, diagnostics, progress);
    study.element = statement.model.element.name();
    study.quadrature = rule_names(mixed.set);
    study.n_dofs = mixed.problem.space.dof_handler.n_dofs();
    const std::vector<double> values = values_of_epsilon(options.values, mixed);

    progress.phase("constants", fmt::format("{} unknowns", study.n_dofs));
    const FreeUnknowns           free(mixed.problem);
    const std::optional<Pairing> pairing = add_constants(study, mixed, free);

    const bool            pressure_is_unique = study.constants.nullity && *study.constants.nullity == 0;
    PenaltySolutions<dim> penalty(mixed, pressure_is_unique, values.back(), progress);
    study.reference = penalty.reference();
    // Each process has neighbouring values: a solution is a good start for the next.
    const auto first_of = [&](const std::size_t rank) { return values.size() * rank / processes.size(); };
    for (std::size_t k = first_of(processes.rank() + 1); k-- > first_of(processes.rank());)
    {
      if (progress.stop_requested())
        throw Interrupted();
      study.rows.insert(study.rows.begin(), penalty.row(values[k], progress));
    }
    study.rows = processes.gather(study.rows);

    if (study.constants.C_h)
    {
      study.constants.C_h_active = C_h_of(active_on_any(processes, penalty.active_for_some_epsilon()), mixed);
      // (13): m ||u_eps - u_h||^2 <= (lambda_h, u_eps - u_h)_G <= ||B'W lambda_h||' ||u_eps - u_h||.
      if (const double m = *study.constants.m; m > 0)
        study.bound_norm_u =
          study.reference.norm_u_V + dual_norm_of_contact_load(*mixed.discrete, penalty.limit_pressure(), free, pairing->gram) / m;
    }
    study.hypotheses.symmetric = mixed.discrete->symmetric();
    study.hypotheses.exact_pairing =
      std::all_of(mixed.set.blocks.begin(), mixed.set.blocks.end(), [](const auto &b) { return b.exact_pairing; });
    study.hypotheses.obstacle_in_V_h = obstacle_in_V_h(mixed.problem);
    judge(study);
    return study;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template EpsilonStudy study_epsilon<dim>(const ProblemStatement &, const EpsilonStudyOptions &, Diagnostics &, Progress &,               \
                                           const Processes &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
