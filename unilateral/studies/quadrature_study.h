// The rules I_G side by side for one case.
#pragma once

#include "unilateral/base/processes.h"
#include "unilateral/base/progress.h"
#include "unilateral/discretisation/problem_statement.h"
#include "unilateral/output/results.h"
#include "unilateral/stability/inf_sup.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  struct QuadratureStudy
  {
    struct Row
    {
      std::string              rule;
      std::string              refused; ///< why the rule cannot be used here; the rest is empty then
      bool                     exact_pairing = false;
      std::size_t              n_points = 0;
      std::optional<InfSup>    constants;               ///< of the finest level, on all of Q_h of the first constraint
      std::optional<Stability> stability;               ///< from the coarsest three levels
      double                   total_contact_force = 0; ///< over all constraints
      double                   energy = 0, max_penetration = 0;
      std::optional<double>    pressure_oscillation; ///< see pressure_oscillation.h, of the first constraint's side with the larger force
      std::optional<Errors>    errors;
      unsigned                 newton_iterations = 0, linear_iterations = 0;
      bool                     converged = false;
    };
    std::vector<Row> rows;
    std::string      element;
    std::string      missing; ///< why constants are
  };

  /// Solves the case with each of @p rules on every constraint. None given: nodal, the other named rules, and gauss(1) to gauss(p + 1) as
  /// far as they differ and are defined for the element.
  /// Several @p processes call this together: each takes some of the rules. All get the same numbers.
  /// Throws InputError for names that are no rule, and when none of those asked for can be used.
  template <int dim>
  QuadratureStudy study_quadrature(const ProblemStatement         &statement,
                                   const std::vector<std::string> &rules,
                                   Diagnostics                    &diagnostics,
                                   Progress                       &progress,
                                   const Processes                &processes = {});

  /// study_quadrature.json.
  nlohmann::ordered_json to_json(const QuadratureStudy &study, const CaseSource &source);

  /// study_quadrature.csv.
  std::string to_csv(const QuadratureStudy &study);
} // namespace unilateral
