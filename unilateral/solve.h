// The main path: mesh -> V_h -> K_h -> solve, level by level, and step by step where a load has a history.
#pragma once

#include "unilateral/base/progress.h"
#include "unilateral/discretisation/solver_choice.h"
#include "unilateral/evaluation/faceted_surface.h"
#include "unilateral/functions/former_level.h"
#include "unilateral/inequality/penalty_parameter.h"
#include "unilateral/nested_iteration.h"
#include "unilateral/solution.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace unilateral
{
  /// Solves the problem on each refinement level in turn, each from the one before (nested iteration).
  /// Non-convergence is a result (`result.converged`, `result.reason`).
  /// Where @p processes are several, all of them call this together, and once a mesh is fine enough each has a part of it: the solution is
  /// that on the part, the numbers are those of the whole. A problem that is not worth sharing, or cannot be shared
  /// (FunctionSpace::subdomain is empty then), is solved by each of them. Throws InputError (names that the mesh does not have, data that
  /// violate the obstacle, ...) and Interrupted.
  template <int dim>
  Solution<dim> solve(const ProblemStatement &statement, Diagnostics &diagnostics, Progress &progress, const Processes &processes = {});

  /// The same; @p on_cycle gets the solution on each mesh of adaptive refinement but the last, with its flux and the numbers that were
  /// computed on the way: all but those that describe_outcome() adds.
  template <int dim>
  Solution<dim> solve(const ProblemStatement                           &statement,
                      Diagnostics                                      &diagnostics,
                      Progress                                         &progress,
                      const Processes                                  &processes,
                      const std::function<void(const Solution<dim> &)> &on_cycle);

  /// Solves problems that differ in their data on one mesh, one after the other, each from the solution before.
  template <int dim>
  class LoadStepping
  {
  public:
    /// Is shown a solution on a mesh that another one follows.
    using Watcher = std::function<void(const Solution<dim> &)>;

    /// @p on_cycle: as for solve(). @p on_level: the same for levels before refinement by the error, without flux and numbers, and without
    /// those on which several processes have each part.
    explicit LoadStepping(Progress &progress, const Processes &processes = {}, Watcher on_cycle = {}, Watcher on_level = {});

    /// The first solve() starts with what an unfinished run has left, on its level; none before it is solved.
    void go_on_with(FormerLevel former_level) { former = std::move(former_level); }

    /// The first statement is solved level by level. Every other one must have the same mesh, parts and element; it is solved on the mesh
    /// of the one before, which adaptive refinement may refine further, from its solution and active set. What has not changed serves on:
    /// matrices, factorisations and multigrid where the form a is the same (same_form()) and Dirichlet conditions fix the same unknowns.
    /// Else they are made anew, for which geometric multigrid begins again with the coarse mesh. So does a problem after one whose adapted
    /// mesh is finer than it has to be in most places, or of which several processes have come to have very different parts.
    /// @p bound_error: with the bounds of the total error and of Theorem 3, which may take longer than the rest; without them
    /// `result.estimate` is an estimate.
    /// `result.timing` adds up over all problems. Throws as solve() does; then nothing can follow.
    Solution<dim> &solve(const ProblemStatement &statement, Diagnostics &diagnostics, bool bound_error = true);

    /// The last one.
    Solution<dim>       &solution() { return current; }
    const Solution<dim> &solution() const { return current; }

    /// After Interrupted: u and the contact pressure of solution() belong to its mesh, and FormerLevel may be made of them.
    bool has_iterate() const { return has_functions_of_mesh && !several_have_each_part(); }

  private:
    void start(const ProblemStatement &statement, Diagnostics &diagnostics);
    bool go_on(const ProblemStatement &statement, Diagnostics &diagnostics);
    void set_up_level(bool finest);
    void start_from_zero();
    void refine_until_held(bool finest);
    void refine(const RefinementByError *by_error = nullptr);

    bool             several_have_each_part() const;
    const Processes &deciding_processes() const;

    Progress                          &progress;
    const Processes                    processes;
    const Watcher                      on_cycle, on_level;
    std::optional<FormerLevel>         former;                        ///< until it is reached
    bool                               has_functions_of_mesh = false; ///< see has_iterate()
    Solution<dim>                      current;
    std::optional<Discretisation<dim>> discretisation;
    std::unique_ptr<DiscreteProblem>   discrete; ///< on the mesh of `current`
    std::optional<PenaltyParameter>    penalty;
    std::optional<FacetedSurface<dim>> coarse_faces;
    StartingGuess                      guess;
    unsigned                           n_cells_unrefined = 0; ///< before refinement by the error
    std::string                        why_not_this_mesh;     ///< the next step does not go on with that of `current`
    std::string                        reason_at_first;       ///< for the linear solver
  };
} // namespace unilateral
