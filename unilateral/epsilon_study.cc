#include "unilateral/epsilon_study.h"

#include "unilateral/assembled.h"
#include "unilateral/certificate.h"
#include "unilateral/form_constants.h"
#include "unilateral/increment_problem.h"
#include "unilateral/inf_sup.h"
#include "unilateral/method_of_multipliers.h"
#include "unilateral/results.h"
#include "unilateral/semismooth_newton.h"
#include "unilateral/solution_norms.h"
#include "unilateral/solve.h"

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
    /// Relative accuracy of every solve; errors below ten times this are round-off.
    constexpr double accuracy = 1e-12;

    /// I_G(a b).
    double inner_product(const DiscreteProblem &problem, const Vector &a, const Vector &b)
    {
      double sum = 0;
      for (std::size_t i = 0; i < a.size(); ++i)
        sum += problem.weights()(i) * a(i) * b(i);
      return sum;
    }

    double norm(const DiscreteProblem &problem, const Vector &q)
    {
      return std::sqrt(inner_product(problem, q, q));
    }

    /// Is every bound a function of V_h? Compared with its interpolant at the points of a Gauss rule, to 1e-10 of its size.
    template <int dim>
    bool obstacle_in_V_h(const Problem<dim> &problem)
    {
      std::vector<Point<dim>> nodes(problem.dof_handler.n_dofs());
      DoFTools::map_dofs_to_support_points(*problem.mapping, problem.dof_handler, nodes);
      const auto flags = update_values | update_quadrature_points;
      for (const auto &condition : problem.conditions)
        try
        {
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
          FEValues<dim>     cell_values(*problem.mapping, *problem.fe, problem.cell_quadrature(), flags);
          FEFaceValues<dim> face_values(*problem.mapping, *problem.fe, problem.face_quadrature(), flags);
          for (const auto &cell : problem.dof_handler.active_cell_iterators())
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

    /// Both sides of a constraint feel the same points: each point once, from the first block that has it in @p flags.
    template <int dim>
    std::vector<bool> without_second_sides(const ConstraintSet<dim> &set, std::vector<bool> flags)
    {
      for (std::size_t b = 1; b < set.blocks.size(); ++b)
      {
        const auto &first = set.blocks[b - 1], &second = set.blocks[b];
        if (first.side == second.side || first.on != second.on || first.rule.name() != second.rule.name())
          continue;
        for (std::size_t i = second.begin; i < second.end; ++i)
          if (flags[first.begin + (i - second.begin)])
            flags[i] = false;
      }
      return flags;
    }

    /// Ten decades down from ||u_h||_0 / ||p_h||_0, at a power of ten: in any units from "far too soft" to "hard".
    std::vector<double> default_values(const double norm_u, const double norm_p)
    {
      const double        top = norm_u > 0 && norm_p > 0 ? std::round(std::log10(norm_u / norm_p)) : -1;
      std::vector<double> values;
      for (int k = 0; k < 10; ++k)
        values.push_back(std::pow(10., top - k));
      return values;
    }

    /// Slope of log(error) over log(epsilon) by least squares.
    std::optional<double> fitted_slope(const std::vector<std::pair<double, double>> &points)
    {
      if (points.size() < 2)
        return {};
      double n = 0, x = 0, y = 0, xx = 0, xy = 0;
      for (const auto &[epsilon, error] : points)
      {
        const double a = std::log(epsilon), b = std::log(error);
        n += 1;
        x += a;
        y += b;
        xx += a * a;
        xy += a * b;
      }
      return (n * xy - x * y) / (n * xx - x * x);
    }

    void add_slopes(EpsilonStudy &study)
    {
      const auto above_round_off = [&](const double error, const double size) { return error > 100 * accuracy * size; };
      using Points = std::vector<std::pair<double, double>>;
      Points u_points, p_points;
      for (std::size_t k = study.rows.size(); k-- > 0;)
      {
        auto &row = study.rows[k];
        if (!row.converged)
          continue;
        const bool u_counts = row.u_error_V > 0, p_counts = above_round_off(row.p_error_L2, study.reference.norm_p);
        if (k > 0)
        {
          const auto &larger = study.rows[k - 1];
          if (u_counts && larger.u_error_V > 0)
            row.slope_u = fitted_slope({{row.epsilon, row.u_error_V}, {larger.epsilon, larger.u_error_V}});
          if (p_counts && larger.p_error_L2 > 0)
            row.slope_p = fitted_slope({{row.epsilon, row.p_error_L2}, {larger.epsilon, larger.p_error_L2}});
        }
        if (u_counts && u_points.size() < 3)
          u_points.emplace_back(row.epsilon, row.u_error_V);
        if (p_counts && p_points.size() < 3)
          p_points.emplace_back(row.epsilon, row.p_error_L2);
      }
      study.slope_u = fitted_slope(u_points);
      study.slope_p = fitted_slope(p_points);
    }

    /// The bounds of each row, once the constants are known, and which statements are seen to hold.
    void judge(EpsilonStudy &study)
    {
      const auto &c = study.constants;
      const auto  positive = [](const std::optional<double> &value) { return value ? std::optional<bool>(*value > 0) : std::nullopt; };
      study.hypotheses.coercive = positive(c.m);
      study.hypotheses.lbb = positive(c.C_h);
      study.hypotheses.lbb_active = positive(c.C_h_active);
      if (study.rows.empty())
        return;

      // What is computed is right to its own round-off: inequalities get that much room.
      const auto below = [](const double value, const double bound) { return value <= bound * (1 + 1e-6); };
      bool       bounded = true, penetration = true, p_bounded = true, lbb_free = true, gap = true, u_22 = true, p_22 = true;
      bool       has_gap = false, has_22 = false, all_converged = true;
      for (auto &row : study.rows)
      {
        all_converged &= row.converged;
        if (study.hypotheses.coercive.value_or(false))
        {
          row.bound_u_lbb_free = 0.5 * std::sqrt(row.epsilon / *c.m) * study.reference.norm_p;
          lbb_free &= below(row.u_error_V, *row.bound_u_lbb_free);
          const auto bounds = [&](const double C_h, std::optional<double> &bound_u, std::optional<double> &bound_p)
          {
            has_22 = true;
            bound_u = *c.M / *c.m * study.reference.norm_p * row.epsilon / C_h;
            bound_p = *c.M / C_h * row.u_error_V;
            u_22 &= below(row.u_error_V, *bound_u);
            p_22 &= below(row.p_error_L2, *bound_p + 10 * accuracy * study.reference.norm_p);
          };
          if (study.hypotheses.lbb.value_or(false))
            bounds(*c.C_h, row.bound_u, row.bound_p);
          if (study.hypotheses.lbb_active.value_or(false))
            bounds(*c.C_h_active, row.bound_u_active, row.bound_p_active);
        }
        if (study.bound_norm_u)
          bounded &= below(row.norm_u_V, *study.bound_norm_u);
        penetration &= below(row.penetration_L2, row.bound_penetration);
        p_bounded &= below(row.norm_p, study.reference.norm_p);
        if (row.bound_u_gap)
        {
          has_gap = true;
          gap &= below(row.u_error_energy, *row.bound_u_gap);
        }
      }
      if (!all_converged)
        return;
      if (study.bound_norm_u)
        study.holds.theorem1_bounded = bounded && penetration;
      const auto &first = study.rows.front(), &last = study.rows.back();
      const bool  tends_to_p =
        study.rows.size() > 1 && (last.p_error_L2 < 0.5 * first.p_error_L2 || last.p_error_L2 < 1e-6 * study.reference.norm_p);
      study.holds.theorem2 = p_bounded && tends_to_p;
      if (has_22)
      {
        study.holds.theorem3_u = u_22;
        study.holds.theorem3_p = p_22;
      }
      if (study.hypotheses.coercive.value_or(false))
        study.holds.lbb_free = lbb_free;
      if (has_gap)
        study.holds.gap = gap;
    }
  } // namespace

  template <int dim>
  EpsilonStudy study_epsilon(const Case &request, const EpsilonStudyOptions &options, Diagnostics &diagnostics, Progress &progress)
  {
    if (request.constraints.empty())
      throw InputError(request.model.where, "the case has no [constraint]: there is no penalty to study");
    EpsilonStudy study;

    // The reference: the mixed method.
    Case mixed = request;
    mixed.method.formulation = MethodSpec::Formulation::mixed;
    mixed.method.epsilon.reset();
    mixed.method.tolerance = std::min(request.method.tolerance, accuracy);
    mixed.expect.clear();
    const Solution<dim> reference = solve<dim>(mixed, diagnostics, progress);
    if (!reference.result.converged)
      throw std::runtime_error("the mixed method, against which the penalty is measured, did not converge: " + reference.result.reason);
    const Problem<dim>       &problem = *reference.problem;
    const ConstraintSet<dim> &set = reference.constraint_set;
    const auto                discrete = assemble(problem, set, {.solver = request.method.solver}, /*with_gram=*/true);
    Vector                    u_h = reference.displacement, p_h = reference.contact_pressure;
    problem.dirichlet.set_zero(u_h);
    study.element = request.model.element.name();
    study.quadrature = set.blocks[0].rule.name();
    study.n_dofs = problem.dof_handler.n_dofs();

    std::vector<double> values = options.values;
    if (values.empty())
      values = default_values(reference.result.norm_L2, norm(*discrete, p_h));
    std::sort(values.begin(), values.end(), std::greater<>());

    // Constants, as far as the size allows.
    progress.phase("constants", fmt::format("{} unknowns", problem.dof_handler.n_dofs()));
    const FreeUnknowns      free(problem);
    const std::vector<bool> everywhere = without_second_sides(set, std::vector<bool>(set.size(), true));
    const bool              computable = free.n_free + set.size() <= InfSupLimits().sparse;
    std::optional<Pairing>  pairing;
    if (computable)
    {
      pairing = make_pairing(problem, set, everywhere, PairingKind::by_rule);
      const FormConstants form = form_constants(free.restricted(discrete->stiffness_matrix()), pairing->gram, discrete->symmetric());
      study.constants.m = form.m;
      study.constants.M = form.M;
      const bool             by_L2 = set.blocks[0].exact_pairing && has_polynomials(problem, set);
      std::optional<Pairing> dual;
      if (n_dual_unknowns(problem) <= InfSupLimits().dual)
        dual = make_dual_pairing(problem, set, everywhere, by_L2 ? PairingKind::by_L2 : PairingKind::by_rule);
      const InfSup all = inf_sup(*pairing, dual ? &*dual : nullptr);
      study.constants.C_h = all.C_h;
      study.constants.beta_h = all.beta_h;
      study.constants.nullity = all.nullity;
    }
    else
      study.constants.missing = fmt::format("{} unknowns and {} points are more than the {} for which constants are computed", free.n_free,
                                            set.size(), InfSupLimits().sparse);

    // The penalty solutions u_h + d, from the smallest epsilon up: each is close to the one before.
    IncrementProblem     increment(*discrete, u_h, p_h);
    const bool           kernel = !study.constants.nullity || *study.constants.nullity > 0;
    MultiplierParameters parameters{.tolerance = accuracy,
                                    // Where the pressure is not unique, only lambda = (Bu - s)^+/eps itself picks the right one.
                                    .shift = kernel ? 0. : suitable_shift(set.at_nodes()),
                                    .singular_without_contact = problem.semicoercive()};
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
      problem.dirichlet.distribute(u);
      return u;
    };
    const auto norm_V = [&](const Vector &u)
    {
      const auto norms = solution_norms(problem, u);
      return std::hypot(norms.L2, norms.H1_semi);
    };
    study.reference = {norm_V(reference.displacement), norm(*discrete, p_h), 0, reference.result.energy,
                       reference.result.newton_iterations};
    const auto force = [&](const Vector &pressure) { return pressure * discrete->weights(); };
    study.reference.total_contact_force = force(p_h);
    std::vector<bool> ever_active = positive(p_h);
    Vector            Hd, Ad, Bd;
    discrete->initialize_dof_vector(Hd);
    discrete->initialize_dof_vector(Ad);
    discrete->initialize_point_vector(Bd);
    for (std::size_t k = values.size(); k-- > 0;)
    {
      if (progress.stop_requested())
        throw Interrupted();
      EpsilonStudy::Row row;
      row.epsilon = parameters.epsilon = values[k];
      progress.phase("solve", fmt::format("epsilon {:.3g}", row.epsilon));
      const MultiplierResult outcome = method_of_multipliers(increment, parameters, positive(lambda), d, lambda, progress);
      row.converged = outcome.converged;
      row.newton_iterations = outcome.history.size();
      row.linear_iterations = outcome.linear_iterations;

      discrete->apply_gram(Hd, d);
      discrete->apply_stiffness(Ad, d);
      discrete->apply_trace(Bd, d);
      row.u_error_V = std::sqrt(d * Hd);
      row.u_error_energy = std::sqrt(std::max(0., d * Ad));
      Vector difference = lambda;
      difference -= p_h;
      row.p_error_L2 = norm(*discrete, difference);
      row.norm_u_V = norm_V(with_dirichlet(d));
      row.norm_p = norm(*discrete, lambda);
      row.penetration_L2 = row.epsilon * row.norm_p;
      row.max_penetration = row.epsilon * (lambda.size() > 0 ? lambda.linfty_norm() : 0.);
      row.total_contact_force = force(lambda);
      // f(d) - a(u_h, d) = (lambda_h, d)_G.
      row.bound_penetration = std::sqrt(std::max(0., row.epsilon * (inner_product(*discrete, p_h, Bd) - d * Ad)));
      const Certificate certificate =
        certify(increment, row.epsilon, suitable_shift(set.at_nodes()), !problem.semicoercive(), d, lambda, progress);
      if (certificate.available)
        row.bound_u_gap = certificate.penalty_error_bound;
      for (std::size_t i = 0; i < lambda.size(); ++i)
        if (lambda(i) > 0)
          ever_active[i] = true;
      study.rows.insert(study.rows.begin(), row);
    }

    if (pairing)
    {
      study.constants.C_h_active = inf_sup(make_pairing(problem, set, without_second_sides(set, ever_active), PairingKind::by_rule)).C_h;
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
    add_slopes(study);
    judge(study);
    return study;
  }

  namespace
  {
    template <typename T>
    Json optional(const std::optional<T> &value)
    {
      return value ? Json(*value) : Json(nullptr);
    }
  } // namespace

  Json to_json(const EpsilonStudy &study, const Case &request)
  {
    Json json;
    json["schema_version"] = 1;
    json["program"] = program_json();
    json["case"] = {{"path", request.path}, {"sha256", request.sha256}};
    json["space"] = {{"element", study.element}, {"n_dofs", study.n_dofs}};
    json["quadrature"] = study.quadrature;
    const auto &c = study.constants;
    json["constants"] = {{"m", optional(c.m)},           {"M", optional(c.M)},
                         {"C_h", optional(c.C_h)},       {"C_h_active", optional(c.C_h_active)},
                         {"beta_h", optional(c.beta_h)}, {"nullity", optional(c.nullity)}};
    if (!c.missing.empty())
      json["constants"]["missing"] = c.missing;
    json["reference"] = {{"formulation", "mixed"},
                         {"energy", study.reference.energy},
                         {"norm_u_V", study.reference.norm_u_V},
                         {"norm_p", study.reference.norm_p},
                         {"total_contact_force", study.reference.total_contact_force},
                         {"newton_iterations", study.reference.newton_iterations}};
    json["bound_norm_u_V"] = optional(study.bound_norm_u);
    json["rows"] = Json::array();
    for (const auto &row : study.rows)
      json["rows"].push_back({{"epsilon", row.epsilon},
                              {"u_error_V", row.u_error_V},
                              {"u_error_energy", row.u_error_energy},
                              {"p_error_L2", row.p_error_L2},
                              {"bound_u", optional(row.bound_u)},
                              {"bound_p", optional(row.bound_p)},
                              {"bound_u_active", optional(row.bound_u_active)},
                              {"bound_p_active", optional(row.bound_p_active)},
                              {"bound_u_lbb_free", optional(row.bound_u_lbb_free)},
                              {"bound_u_gap", optional(row.bound_u_gap)},
                              {"penetration_L2", row.penetration_L2},
                              {"bound_penetration", row.bound_penetration},
                              {"max_penetration", row.max_penetration},
                              {"total_contact_force", row.total_contact_force},
                              {"norm_u_V", row.norm_u_V},
                              {"norm_p", row.norm_p},
                              {"slope_u", optional(row.slope_u)},
                              {"slope_p", optional(row.slope_p)},
                              {"newton_iterations", row.newton_iterations},
                              {"linear_iterations", row.linear_iterations},
                              {"converged", row.converged}});
    json["slopes"] = {{"u_error_V", optional(study.slope_u)}, {"p_error_L2", optional(study.slope_p)}};
    const auto &h = study.hypotheses;
    json["hypotheses"] = {{"coercive", optional(h.coercive)},     {"symmetric", h.symmetric}, {"exact_pairing", h.exact_pairing},
                          {"obstacle_in_V_h", h.obstacle_in_V_h}, {"lbb", optional(h.lbb)},   {"lbb_active", optional(h.lbb_active)}};
    json["holds"] = {{"theorem1_bounded", optional(study.holds.theorem1_bounded)},
                     {"theorem2", optional(study.holds.theorem2)},
                     {"theorem3_u", optional(study.holds.theorem3_u)},
                     {"theorem3_p", optional(study.holds.theorem3_p)},
                     {"lbb_free", optional(study.holds.lbb_free)},
                     {"gap", optional(study.holds.gap)}};
    return json;
  }

  std::string to_csv(const EpsilonStudy &study)
  {
    std::string text = "epsilon,u_error_V,u_error_energy,p_error_L2,bound_u,bound_p,bound_u_active,bound_p_active,bound_u_lbb_free,"
                       "bound_u_gap,penetration_L2,bound_penetration,max_penetration,total_contact_force,norm_u_V,norm_p,"
                       "newton_iterations,linear_iterations\n";
    const auto  optional = [](const std::optional<double> &value) { return value ? fmt::format("{:.12g}", *value) : std::string(); };
    for (const auto &row : study.rows)
      text += fmt::format("{:.12g},{:.12g},{:.12g},{:.12g},{},{},{},{},{},{},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{},{}\n",
                          row.epsilon, row.u_error_V, row.u_error_energy, row.p_error_L2, optional(row.bound_u), optional(row.bound_p),
                          optional(row.bound_u_active), optional(row.bound_p_active), optional(row.bound_u_lbb_free),
                          optional(row.bound_u_gap), row.penetration_L2, row.bound_penetration, row.max_penetration,
                          row.total_contact_force, row.norm_u_V, row.norm_p, row.newton_iterations, row.linear_iterations);
    return text;
  }

#define INSTANTIATE(dim) template EpsilonStudy study_epsilon<dim>(const Case &, const EpsilonStudyOptions &, Diagnostics &, Progress &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
