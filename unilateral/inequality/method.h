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
    /// Of the linear systems.
    enum class Solver
    {
      automatic, ///< by the size of the problem and the levels of the mesh
      direct,
      amg, ///< conjugate gradients or GMRES with algebraic multigrid
      multigrid
    };
    Formulation           formulation = Formulation::penalty;
    std::optional<double> epsilon;           ///< absent: "auto"
    std::optional<double> penalty_tolerance; ///< largest certified error of the penalty, relative to the energy norm of the solution
    double                tolerance = 1e-8;  ///< relative, on equilibrium and complementarity
    Solver                solver = Solver::automatic;
    unsigned              max_iterations = 200; ///< Newton steps a level before the run is called not converged
    SourceLocation        solver_where;
  };

  std::string                   name_of(Method::Solver solver); ///< auto, direct, amg, multigrid
  std::optional<Method::Solver> solver_called(const std::string &name);
} // namespace unilateral
