// The steps of a case, one after the other.
#pragma once

#include "unilateral/case/case.h"
#include "unilateral/case/restart.h"
#include "unilateral/solve.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <functional>
#include <memory>

namespace unilateral
{
  template <int dim>
  struct SolvedStep
  {
    std::size_t        k = 0;        ///< from 0
    bool               last = false; ///< none follows, be it because this one did not converge
    const Case        &request;      ///< of this step alone
    Solution<dim>     &solution;
    const Diagnostics &diagnostics; ///< warnings
    double             seconds = 0; ///< of the solve
    /// The solution, where the next step uses it.
    std::shared_ptr<const CellFunctions> functions;
  };

  /// Gets a step that has been solved, and the entries of `steps` up to it.
  template <int dim>
  using OnStep = std::function<void(const SolvedStep<dim> &, const nlohmann::ordered_json &steps)>;

  /// Solves the steps of @p request after those @p before with @p stepping until one does not converge; the solution of the last one is
  /// stepping.solution(). Returns the block `steps` of results.json: step_json() of each. @p on_step is called after each. Throws
  /// InputError, which names the step, and Interrupted.
  template <int dim>
  nlohmann::ordered_json
  solve_history(const Case &request, LoadStepping<dim> &stepping, const OnStep<dim> &on_step, const StepsBefore &before = {});

  /// States the problem of each step on the coarse mesh, and solves none: what [boundary] and contact hold in each, names, data, bounds
  /// that boundary data violate. Steps that depend on the solution of the one before are not looked at. Adds the warnings that are new.
  /// Throws InputError, which names the step.
  template <int dim>
  void check_history(const Case &request, Diagnostics &diagnostics);
} // namespace unilateral
