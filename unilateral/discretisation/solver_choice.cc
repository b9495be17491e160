#include "unilateral/discretisation/solver_choice.h"

#include "unilateral/discretisation/assembled.h"
#include "unilateral/discretisation/matrix_free.h"
#include "unilateral/discretisation/mesh_hierarchy.h"
#include "unilateral/discretisation/rigid_body_modes.h"
#include "unilateral/discretisation/shared_assembled.h"
#include "unilateral/discretisation/shared_sparse.h"
#include "unilateral/discretisation/unknowns_on_finest.h"
#include "unilateral/discretisation/vertex_volumes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace unilateral
{
  namespace
  {
    template <int dim>
    Multigrid::Parameters smoother(const Problem<dim> &problem)
    {
      return Multigrid::Parameters::for_volume_to_shape_stiffness(problem.form->volume_to_shape_stiffness());
    }

    /// What is worth saying of it, after a comma.
    template <int dim>
    std::string remark_on_smoother(const Problem<dim> &problem)
    {
      const unsigned degree = smoother(problem).smoother_degree;
      return degree == Multigrid::Parameters().smoother_degree
               ? ""
               : fmt::format(", smoothing with polynomials of degree {}: a material is nearly incompressible", degree);
    }
  } // namespace

  template <int dim>
  Discretisation<dim>::Discretisation(const Problem<dim> &problem, const Parameters &parameters)
    : solver(problem.statement.method.solver), parameters(parameters)
  {
    const Method     &method = problem.statement.method;
    const std::string obstacle = obstacle_to_multigrid(problem);
    if (method.solver == Method::Solver::multigrid)
    {
      if (!obstacle.empty())
        throw InputError(method.solver_where, "geometric multigrid does not serve here: " + obstacle + "; take solver = \"auto\"",
                         MessageName("solver-does-not-fit"));
      explanation = "geometric multigrid, as asked" + remark_on_smoother(problem);
      hierarchy = std::make_shared<LevelHierarchy>();
      return;
    }
    if (method.solver != Method::Solver::automatic)
    {
      explanation = fmt::format("{}, as asked", name_of(method.solver));
      if (method.solver == Method::Solver::amg && problem.form->order() > 1)
        explanation = "a direct solver: algebraic multigrid knows nothing of beams and plates";
      return;
    }
    const double n_coarse = problem.space.n_unknowns();
    double       n_finest = unknowns_on_finest(problem);
    if (const auto &adapt = problem.statement.mesh.adapt)
      n_finest = std::max(n_finest, double(adapt->max_unknowns));
    const std::size_t direct_limit = dim == 2 ? parameters.direct_limit_2d : parameters.direct_limit_3d;
    const std::size_t coarse_limit = dim == 2 ? parameters.coarse_limit_2d : parameters.coarse_limit_3d;
    if (dim == 1 || problem.form->order() > 1 || n_finest <= direct_limit)
    {
      explanation = "a direct solver, the quickest at this size";
      solver = Method::Solver::direct;
    }
    else if (!obstacle.empty())
      no_multigrid = obstacle;
    else if (n_coarse > coarse_limit || (problem.statement.mesh.n_refinements() == 0 && !problem.statement.mesh.adapt))
      no_multigrid = fmt::format("the coarse mesh has {} unknowns", problem.space.n_unknowns());
    else
    {
      explanation = "geometric multigrid" + remark_on_smoother(problem);
      hierarchy = std::make_shared<LevelHierarchy>();
    }
    if (!no_multigrid.empty())
      explanation =
        fmt::format("a direct solver or multigrid with assembled matrices, by what a factorisation takes; no geometric multigrid without "
                    "matrices: {}",
                    no_multigrid);
  }

  template <int dim>
  Discretisation<dim>::Discretisation(const Problem<dim> &problem, const DiscretisationChoice &choice, const Parameters &parameters)
    : solver(choice.solver), no_multigrid(choice.no_multigrid), explanation(choice.explanation), parameters(parameters)
  {
    if (!problem.space.subdomain)
      throw std::logic_error("a choice is for parts of the mesh that it was made on");
  }

  template <int dim>
  std::unique_ptr<DiscreteProblem> Discretisation<dim>::on_level(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set)
  {
    const auto running = problem.time_by_part.run("operators");
    if (!hierarchy && problem.space.subdomain)
      return shared_on_level(problem, constraint_set);
    if (!hierarchy)
      return assembled_on_level(problem, constraint_set);
    auto load = add_level(*hierarchy, problem);
    return matrix_free_on_level(problem, ConstraintTrace(constraint_set, problem.space.dirichlet), std::move(load));
  }

  template <int dim>
  std::unique_ptr<DiscreteProblem>
  Discretisation<dim>::matrix_free_on_level(const Problem<dim> &problem, ConstraintTrace trace, Vector load) const
  {
    const auto running = problem.time_by_part.run("multigrid");
    return std::make_unique<MatrixFree>(hierarchy, std::move(trace), std::move(load), modes_at_unknowns(problem, problem.null_space),
                                        modes_at_unknowns(problem, problem.unsupported),
                                        MatrixFree::Parameters{.multigrid = smoother(problem)});
  }

  template <int dim>
  bool Discretisation<dim>::restate(const Problem<dim>                     &problem,
                                    const ConstraintSet<dim>               &constraint_set,
                                    const typename Problem<dim>::Unchanged &unchanged,
                                    std::unique_ptr<DiscreteProblem>       &discrete)
  {
    const auto running = problem.time_by_part.run("operators");
    const bool same_matrix = unchanged.matrix && unchanged.fixed;
    if (!hierarchy && problem.space.subdomain)
    {
      auto *const blocks = dynamic_cast<SharedAssembled *>(discrete.get());
      auto *const rows = dynamic_cast<SharedSparse *>(discrete.get());
      const bool  takes_data =
        same_matrix && ((blocks && blocks->set_data(problem, constraint_set)) || (rows && rows->set_data(problem, constraint_set)));
      if (!takes_data)
        discrete = shared_on_level(problem, constraint_set);
      return true;
    }
    if (!hierarchy)
    {
      if (!same_matrix || !static_cast<Assembled &>(*discrete).set_data(problem, constraint_set))
        discrete = assembled_on_level(problem, constraint_set);
      return true;
    }
    if (!same_matrix)
      return false;
    const ConstraintTrace trace(constraint_set, problem.space.dirichlet);
    Vector                load = load_on_finest(*hierarchy, problem);
    if (!static_cast<MatrixFree &>(*discrete).set_data(trace, load))
      discrete = matrix_free_on_level(problem, trace, std::move(load));
    return true;
  }

  template <int dim>
  std::unique_ptr<DiscreteProblem> Discretisation<dim>::assembled_on_level(const Problem<dim>       &problem,
                                                                           const ConstraintSet<dim> &constraint_set)
  {
    auto discrete = assemble(problem, constraint_set, {.solver = solver}, /*with_gram=*/false);
    if (problem.statement.method.solver == Method::Solver::amg && problem.form->order() <= 1)
      explanation = "amg, as asked: " + discrete->solver_reason();
    if (solver == Method::Solver::automatic)
      explanation = fmt::format("{}{}; no geometric multigrid without matrices: {}", discrete->solves_exactly() ? "a direct solver, " : "",
                                discrete->solver_reason(), no_multigrid);
    return discrete;
  }

  template <int dim>
  std::unique_ptr<DiscreteProblem> Discretisation<dim>::shared_on_level(const Problem<dim>       &problem,
                                                                        const ConstraintSet<dim> &constraint_set)
  {
    std::unique_ptr<DiscreteProblem> discrete;
    const auto                       take = [&](auto made)
    {
      const Method::Solver asked = problem.statement.method.solver;
      const std::string    before = asked == Method::Solver::automatic                       ? ""
                                    : asked == Method::Solver::amg && made->solves_exactly() ? "no algebraic multigrid for such forms: "
                                                                                             : name_of(asked) + ", as asked: ";
      if (!fell_back) // else it says why
        explanation = fmt::format("{}{}{}", before, made->solver_reason(),
                                  no_multigrid.empty() ? "" : "; no geometric multigrid without matrices: " + no_multigrid);
      discrete = std::move(made);
    };
    if (factorises_parts(problem))
      take(std::make_unique<SharedSparse>(problem, constraint_set, SharedSparse::Solver::factors));
    else if (!problem.symmetric())
      take(std::make_unique<SharedSparse>(problem, constraint_set, SharedSparse::Solver::iterations));
    else
      take(std::make_unique<SharedAssembled>(problem, constraint_set));
    return discrete;
  }

  template <int dim>
  bool Discretisation<dim>::factorises_parts(const Problem<dim> &problem) const
  {
    return solver == Method::Solver::direct || problem.form->order() != 1; // aggregation knows nothing of fourth-order problems
  }

  template <int dim>
  bool Discretisation<dim>::fall_back(const Problem<dim>     &problem,
                                      const DiscreteProblem  &failed,
                                      const MultiplierResult &outcome,
                                      Progress               &progress)
  {
    const auto &subdomain = problem.space.subdomain;
    if (outcome.converged || problem.statement.method.solver != Method::Solver::automatic || (subdomain && subdomain->n_alike > 1) ||
        (subdomain && VertexVolumes<dim>::any(problem)) ||
        (failed.symmetric() && !std::isfinite(outcome.equilibrium + outcome.complementarity)) || std::exchange(fell_back, true))
      return false;
    const double affordable = subdomain  ? dim == 2 ? parameters.affordable_for_parts_2d : parameters.affordable_for_parts_3d
                              : dim == 2 ? parameters.affordable_2d
                                         : parameters.affordable_3d;
    const bool   iterate = failed.solves_exactly(), serves = problem.form->order() <= 1 && dim > 1 && failed.symmetric();
    const double n_finest = subdomain ? double(problem.space.n_unknowns()) : unknowns_on_finest(problem);
    if (iterate ? !serves || failed.null_space().empty() : n_finest > affordable)
      return false;
    hierarchy.reset();
    solver = iterate ? Method::Solver::amg : Method::Solver::direct;
    explanation += fmt::format("; on level {}: {}; from there on {}", problem.space.level, outcome.reason,
                               iterate ? "multigrid with assembled matrices" : "a direct solver");
    progress.log("linear solver: " + explanation);
    return true;
  }

  template class Discretisation<1>;
  template class Discretisation<2>;
  template class Discretisation<3>;
} // namespace unilateral
