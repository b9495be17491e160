// Theorems 1 to 3 on the user's own problem: errors of the penalty method against the mixed solution, and what bounds them.
#pragma once

#include "unilateral/base/processes.h"
#include "unilateral/base/progress.h"
#include "unilateral/discretisation/problem_statement.h"
#include "unilateral/output/results.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace unilateral
{
  /// Everything `study epsilon` finds out. u_h, p_h: the mixed solution (21) on the finest level, p_h of minimal norm where it is not
  /// unique. ||.||_V is the full H^m norm, ||.||_a the energy norm, ||.||_0 that of I_G. Absent numbers: no such bound here.
  struct EpsilonStudy
  {
    /// Relative accuracy of every solve: pressures are known to about this, displacements better, since they are computed as u_eps - u_h.
    static constexpr double accuracy = 1e-12;
    /// The smallest tolerance of a solve, relative to u_h and p_h: u_eps - u_h is known to this.
    static constexpr double round_off = 1e-3 * accuracy;

    struct Row
    {
      double epsilon = 0;
      double u_error_V = 0;      ///< ||u_h - u_eps||_V
      double u_error_energy = 0; ///< ||u_h - u_eps||_a
      double p_error_L2 = 0;     ///< ||p_h - p_eps||_0
      double norm_u_V = 0, norm_p = 0;
      double penetration_L2 = 0; ///< I_G(((u_eps - s)^+)^2)^1/2 = eps ||p_eps||_0
      double max_penetration = 0;
      double total_contact_force = 0;

      std::optional<double> bound_u, bound_p;               ///< (22) with C_h of all of Q_h
      std::optional<double> bound_u_active, bound_p_active; ///< (22) with C_h of the points that are active for some epsilon
      std::optional<double> bound_u_lbb_free;               ///< 1/2 sqrt(eps/m) ||p_h||_0
      std::optional<double> bound_u_gap;                    ///< of ||u_h - u_eps||_a, from the duality gap
      double                bound_penetration = 0; ///< Theorem 1's proof with v = u_h: (eps (f(u_eps - u_h) - a(u_eps, u_eps - u_h)))^1/2
      std::optional<double> slope_u, slope_p;      ///< d log(error) / d log(epsilon) towards the next larger epsilon

      unsigned newton_iterations = 0, linear_iterations = 0;
      bool     converged = false;
      double   relative_round_off = 0; ///< of the differences of displacements
      bool     at_round_off = false;   ///< the error is below 1e-12 of u: shown, but neither judged nor fitted
    };

    struct Reference
    {
      double   norm_u_V = 0, norm_p = 0, total_contact_force = 0, energy = 0;
      unsigned newton_iterations = 0;
    };

    struct
    {
      std::optional<double>      m, M, C_h, C_h_active, beta_h;
      std::optional<std::size_t> nullity;
      std::string                missing; ///< why some are
    } constants;
    Reference reference;

    std::vector<Row>      rows;             ///< from the largest epsilon to the smallest
    std::optional<double> slope_u, slope_p; ///< least squares over the three smallest epsilon above round-off
    std::optional<double> bound_norm_u;     ///< (13): ||u_h||_V + ||B'W lambda_h||_{V'} / m, whatever epsilon is

    struct
    {
      bool                symmetric = false, exact_pairing = false, obstacle_in_V_h = false;
      std::optional<bool> coercive, lbb, lbb_active; ///< absent where the constants are
    } hypotheses;
    struct
    {
      std::optional<bool> theorem1_bounded;       ///< ||u_eps||_V stays below (13), the penetration below its estimate
      std::optional<bool> theorem2;               ///< ||p_eps||_0 <= ||p_h||_0, and p_eps tends to p_h
      std::optional<bool> theorem3_u, theorem3_p; ///< (22); absent where C_h = 0 on the active points too
      std::optional<bool> lbb_free, gap;
    } holds;
    std::string element, quadrature;
    std::size_t n_dofs = 0;
  };

  /// There is no reference to measure the penalty against.
  class NoReference : public std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  struct EpsilonStudyOptions
  {
    std::vector<double> values; ///< epsilon > 0; empty: ten decades down from the size of u over that of p
  };

  /// Solves the case by the mixed method, then by the penalty method for each epsilon, in the unknown u_eps - u_h, so that errors far
  /// below the digits of u are measured. Constants are computed where the limits of inf_sup() allow.
  /// Several @p processes call this together: each solves the mixed problem, then a part of the penalty problems. All get the same numbers.
  /// Throws InputError and Interrupted; NoReference when the mixed method does not converge.
  template <int dim>
  EpsilonStudy study_epsilon(const ProblemStatement    &statement,
                             const EpsilonStudyOptions &options,
                             Diagnostics               &diagnostics,
                             Progress                  &progress,
                             const Processes           &processes = {});

  /// Adds bounds, slopes and what was seen to hold to a study with its rows, constants and hypotheses.
  void judge(EpsilonStudy &study);

  /// study_epsilon.json.
  nlohmann::ordered_json to_json(const EpsilonStudy &study, const CaseSource &source);

  /// study_epsilon.csv: a heading and a line an epsilon.
  std::string to_csv(const EpsilonStudy &study);
} // namespace unilateral
