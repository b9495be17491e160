// The numbers of a run and their form as results.json.
#pragma once

#include "unilateral/case.h"
#include "unilateral/certificate.h"
#include "unilateral/progress.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  /// One side of one constraint.
  struct ConstraintResult
  {
    std::string on;   ///< boundary part, "domain" when in the domain
    std::string side; ///< "lower" | "upper"
    std::string quadrature;
    std::size_t n_points = 0, n_active = 0;
    bool        exact_pairing = false;   ///< (14)
    double      contact_measure = 0;     ///< sum of w_i over active points
    double      total_contact_force = 0; ///< sum_i w_i lambda_i
    double      max_contact_pressure = 0;
    double      pressure_L2 = 0;     ///< I_G(lambda^2)^(1/2)
    double      max_penetration = 0; ///< max (Bu - s)^+
    double      complementarity = 0; ///< I_G(lambda |Bu - s - eps lambda|)
  };

  struct ProbeResult
  {
    std::vector<double> point;
    double              value = 0;
  };

  struct Errors
  {
    std::optional<double> L2, H1_semi, max_nodal, mean_nodal, pressure_L2;
  };

  struct ExpectationResult
  {
    Expectation asked;
    double      value = 0; ///< NaN when the quantity does not exist or is not a number
    bool        passed = false;
    std::string problem; ///< why there is no value to compare; empty when there is one
  };

  /// "solution.energy = -0.25, expected -0.3 +- 0.01"; ">= 0", "<= 1" for bounds.
  std::string to_string(const ExpectationResult &expectation);

  /// Everything results.json says; plain numbers.
  struct RunResult
  {
    bool        converged = false;
    std::string reason; ///< why the solver stopped

    unsigned    dimension = 0;
    std::size_t n_cells = 0, n_dofs = 0;
    unsigned    n_levels = 0;
    double      h_min = 0, h_max = 0;
    std::string element;
    unsigned    m = 1; ///< order of the Sobolev space H^m

    std::vector<ConstraintResult> constraints;

    std::string formulation, epsilon_reason, linear_solver;
    double      epsilon = 0; ///< 0: mixed
    double      tolerance = 0;

    double                   energy = 0; ///< 1/2 a(u,u) - f(u), f with boundary flux
    double                   norm_L2 = 0, norm_H1_semi = 0, min = 0, max = 0;
    std::vector<ProbeResult> probes;
    std::optional<Errors>    errors;

    std::optional<Certificate> certificate;
    double                     discretisation_indicator = 0; ///< estimate of || u - u_h ||_a, see estimator.h
    bool                       certificate_holds = true;     ///< within [method] penalty_tolerance, when that is given

    unsigned                 outer_iterations = 0, newton_iterations = 0, linear_iterations = 0; ///< summed over levels
    std::size_t              fine_operator_applications = 0;
    std::vector<LevelReport> levels;

    struct
    {
      double total = 0, mesh = 0, setup = 0, solve = 0, certify = 0, output = 0;
    } timing; ///< seconds

    std::vector<ExpectationResult> expect;
  };

  /// results.json; key order as in the documentation. NaN and infinity become null. Times, those of the levels too, are in `timing` alone,
  /// so that two runs differ in `timing` and `memory` only.
  nlohmann::ordered_json to_json(const RunResult &result, const Case &request);

  /// The `errors` block: the norms that are there.
  nlohmann::ordered_json to_json(const Errors &errors);

  /// `program`: name, versions, what it was built for and runs on.
  nlohmann::ordered_json program_json();

  /// The text of a JSON file: two-space indent, a newline at the end; bytes that are not UTF-8 are replaced.
  std::string to_text(const nlohmann::ordered_json &json);

  /// Looks up every [[expect]] in the JSON and fills result.expect; true when all hold.
  /// A quantity is a path of keys and array indices, "solution.probes.0.value"; one that does not exist fails and says what does.
  bool evaluate_expectations(RunResult &result, const Case &request);

  /// Before anything is solved: an [[expect]] whose quantity is none of the numbers that a run of this case gives is an error at its
  /// place. Where the case has other errors, so that parts of it could not be read, what may lie in those parts is let pass.
  void check_expectations(const Case &request, Diagnostics &diagnostics);

  /// Every [[expect]] that failed, as an error at its place.
  std::vector<Diagnostic> failed_expectations(const RunResult &result);
} // namespace unilateral
