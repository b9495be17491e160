#include "unilateral/studies/epsilon_study.h"

#include "unilateral/base/processes.h"
#include "unilateral/output/json.h"
#include "unilateral/output/results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace unilateral
{
  using Json = nlohmann::ordered_json;

  namespace
  {
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
      const auto above_round_off = [&](const double error, const double size) { return error > 100 * EpsilonStudy::accuracy * size; };
      using Points = std::vector<std::pair<double, double>>;
      Points u_points, p_points;
      for (std::size_t k = study.rows.size(); k-- > 0;)
      {
        auto &row = study.rows[k];
        if (!row.converged || row.at_round_off)
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
  } // namespace

  void judge(EpsilonStudy &study)
  {
    add_slopes(study);
    const auto &c = study.constants;
    const auto  positive = [](const std::optional<double> &value) { return value ? std::optional<bool>(*value > 0) : std::nullopt; };
    study.hypotheses.coercive = positive(c.m);
    study.hypotheses.lbb = positive(c.C_h);
    study.hypotheses.lbb_active = positive(c.C_h_active);
    if (study.rows.empty())
      return;

    // What is computed is right to its own round-off: inequalities get a tolerance.
    bool bounded = true, penetration = true, p_bounded = true, lbb_free = true, gap = true, u_22 = true, p_22 = true;
    bool has_gap = false, has_22 = false, all_converged = true;
    for (auto &row : study.rows)
    {
      all_converged &= row.converged;
      const double tolerance = 1e-5 + row.relative_round_off;
      const auto   below = [&](const double value, const double bound) { return row.at_round_off || value <= bound * (1 + tolerance); };
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
          p_22 &= below(row.p_error_L2, *bound_p + 10 * EpsilonStudy::accuracy * study.reference.norm_p);
        };
        if (study.hypotheses.lbb.value_or(false))
          bounds(*c.C_h, row.bound_u, row.bound_p);
        if (study.hypotheses.lbb_active.value_or(false))
          bounds(*c.C_h_active, row.bound_u_active, row.bound_p_active);
      }
      if (study.bound_norm_u)
        bounded &= below(row.norm_u_V, *study.bound_norm_u);
      // An equality where contact is at one point, made of the difference of two solutions, each of them as accurate as its solve.
      const double digits_lost = EpsilonStudy::accuracy / EpsilonStudy::round_off * row.relative_round_off;
      penetration &= below(row.penetration_L2, row.bound_penetration * (1 + digits_lost));
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
    const bool  enough = first.epsilon >= 9.9 * last.epsilon || last.p_error_L2 <= 1e-6 * study.reference.norm_p;
    const bool  tends_to_p = (last.p_error_L2 < 0.5 * first.p_error_L2 || last.p_error_L2 <= 1e-6 * study.reference.norm_p);
    if (enough || !p_bounded) // a limit is not seen from one epsilon, or from two that are close
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

  Json to_json(const EpsilonStudy &study, const CaseSource &source)
  {
    Json json;
    json["schema_version"] = 1;
    json["program"] = program_json(Processes::all().size());
    json["case"] = to_json(source);
    json["space"] = {{"element", study.element}, {"n_dofs", study.n_dofs}};
    json["quadrature"] = study.quadrature;
    const auto &c = study.constants;
    json["constants"] = {{"m", or_null(c.m)},           {"M", or_null(c.M)},
                         {"C_h", or_null(c.C_h)},       {"C_h_active", or_null(c.C_h_active)},
                         {"beta_h", or_null(c.beta_h)}, {"nullity", or_null(c.nullity)}};
    if (!c.missing.empty())
      json["constants"]["missing"] = c.missing;
    json["reference"] = {{"formulation", "mixed"},
                         {"energy", study.reference.energy},
                         {"norm_u_V", study.reference.norm_u_V},
                         {"norm_p", study.reference.norm_p},
                         {"total_contact_force", study.reference.total_contact_force},
                         {"newton_iterations", study.reference.newton_iterations}};
    json["bound_norm_u_V"] = or_null(study.bound_norm_u);
    json["rows"] = Json::array();
    for (const auto &row : study.rows)
      json["rows"].push_back({{"epsilon", row.epsilon},
                              {"u_error_V", row.u_error_V},
                              {"u_error_energy", row.u_error_energy},
                              {"p_error_L2", row.p_error_L2},
                              {"bound_u", or_null(row.bound_u)},
                              {"bound_p", or_null(row.bound_p)},
                              {"bound_u_active", or_null(row.bound_u_active)},
                              {"bound_p_active", or_null(row.bound_p_active)},
                              {"bound_u_lbb_free", or_null(row.bound_u_lbb_free)},
                              {"bound_u_gap", or_null(row.bound_u_gap)},
                              {"penetration_L2", row.penetration_L2},
                              {"bound_penetration", row.bound_penetration},
                              {"max_penetration", row.max_penetration},
                              {"total_contact_force", row.total_contact_force},
                              {"norm_u_V", row.norm_u_V},
                              {"norm_p", row.norm_p},
                              {"slope_u", or_null(row.slope_u)},
                              {"slope_p", or_null(row.slope_p)},
                              {"newton_iterations", row.newton_iterations},
                              {"linear_iterations", row.linear_iterations},
                              {"converged", row.converged},
                              {"at_round_off", row.at_round_off}});
    json["slopes"] = {{"u_error_V", or_null(study.slope_u)}, {"p_error_L2", or_null(study.slope_p)}};
    const auto &h = study.hypotheses;
    json["hypotheses"] = {{"coercive", or_null(h.coercive)},      {"symmetric", h.symmetric}, {"exact_pairing", h.exact_pairing},
                          {"obstacle_in_V_h", h.obstacle_in_V_h}, {"lbb", or_null(h.lbb)},    {"lbb_active", or_null(h.lbb_active)}};
    json["holds"] = {{"theorem1_bounded", or_null(study.holds.theorem1_bounded)},
                     {"theorem2", or_null(study.holds.theorem2)},
                     {"theorem3_u", or_null(study.holds.theorem3_u)},
                     {"theorem3_p", or_null(study.holds.theorem3_p)},
                     {"lbb_free", or_null(study.holds.lbb_free)},
                     {"gap", or_null(study.holds.gap)}};
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
} // namespace unilateral
