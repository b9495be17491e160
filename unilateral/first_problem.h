// The problem on its coarse mesh, as a run begins: of several processes each makes a part of the mesh, or one makes it, or each does.
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

  /// Where a coarse mesh may be divided before anything is solved on it, the processes read it in pieces where its file allows that, see
  /// part_of_msh_file(), and none needs memory for the whole. Else the first process makes it and sends the others their parts: only it
  /// needs that memory, and before there are matrices. Where no coarse mesh is divided every process makes the whole. Throws InputError,
  /// on all processes.
  template <int dim>
  FirstProblem<dim>
  make_first_problem(const ProblemStatement &statement, const Processes &processes, Diagnostics &diagnostics, Progress &progress);
} // namespace unilateral
