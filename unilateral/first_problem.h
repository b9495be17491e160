// The problem on its coarse mesh, as a run begins: of several processes one makes the mesh, or each does.
#pragma once

#include "unilateral/base/progress.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/discretisation/solver_choice.h"
#include "unilateral/evaluation/faceted_surface.h"

#include <memory>
#include <optional>

namespace unilateral
{
  template <int dim>
  struct FirstProblem
  {
    std::unique_ptr<Problem<dim>>      problem;
    std::optional<Discretisation<dim>> discretisation;
    std::optional<FacetedSurface<dim>> coarse_faces; ///< of the mesh as a whole
  };

  /// Where a coarse mesh may be divided before anything is solved on it, the first process makes it and sends the others their parts: only
  /// it needs memory for the whole, and that before there are matrices. Else every process makes the whole mesh. Throws InputError, on
  /// all processes.
  template <int dim>
  FirstProblem<dim>
  make_first_problem(const ProblemStatement &statement, const Processes &processes, Diagnostics &diagnostics, Progress &progress);
} // namespace unilateral
