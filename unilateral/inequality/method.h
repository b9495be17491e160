// How the inequality is solved.
#pragma once

#include "unilateral/base/diagnostics.h"

#include <optional>
#include <string>

namespace unilateral
{
  /// Formulation, tolerance and linear solver.
  struct Method
  {
    enum class Formulation
    {
      penalty,
      mixed
    };
    Formulation           formulation = Formulation::penalty;
    std::optional<double> epsilon;              ///< absent: "auto"
    std::optional<double> penalty_tolerance;    ///< largest certified error of the penalty, relative to the energy norm of the solution
    double                tolerance = 1e-8;     ///< relative, on equilibrium and complementarity
    std::string           solver = "auto";      ///< auto | direct | amg | multigrid
    unsigned              max_iterations = 200; ///< Newton steps a level before the run is called not converged
    SourceLocation        solver_where;
  };
} // namespace unilateral
