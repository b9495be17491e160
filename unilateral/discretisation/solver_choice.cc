#include "unilateral/discretisation/solver_choice.h"

#include "unilateral/discretisation/assembled.h"
#include "unilateral/discretisation/matrix_free.h"
#include "unilateral/discretisation/mesh_hierarchy.h"
#include "unilateral/discretisation/rigid_body_modes.h"
#include "unilateral/discretisation/shared_assembled.h"
#include "unilateral/discretisation/shared_sparse.h"
#include "unilateral/discretisation/vertex_volumes.h"
#include "unilateral/mesh/refinement_at_cuts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

    template <int dim>
    bool is_refined_in_places(const Problem<dim> &problem)
    {
      return !problem.statement.mesh.local.empty() || problem.statement.mesh.adapt;
    }

    /// How many cells each is about to become, of those that are @p chosen @p n_children; empty: all become as many.
    std::vector<double> cells_that_come(const std::vector<bool> &chosen, const double n_children)
    {
      std::vector<double> n;
      for (const bool refines : chosen)
        n.push_back(refines ? n_children : 1);
      return n;
    }

    /// No part is empty or has more than twice the mean.
    bool is_balanced(const Division &division, const unsigned n_parts)
    {
      std::vector<std::size_t> n_cells(n_parts, 0);
      for (const unsigned owner : division.owner)
        ++n_cells[owner];
      const auto [least, most] = std::minmax_element(n_cells.begin(), n_cells.end());
      return *least > 0 && *most * n_parts <= 2 * division.owner.size();
    }

    /// Unknowns of the finest level. Refinements of every cell: vertices, lines, quadrilaterals or triangles, and cells are counted, of
    /// which each makes so many of its own dimension and of those below. Local ones: about as many as they make of cells.
    template <int dim>
    double unknowns_on_finest(const Problem<dim> &problem)
    {
      const unsigned   refinements = std::max(problem.statement.mesh.refine, problem.space.level) - problem.space.level;
      constexpr double of_cube[4][4] = {{1}, {1, 2}, {1, 4, 4}, {1, 6, 12, 8}}, of_simplex[4][4] = {{1}, {1, 2}, {0, 3, 4}, {0, 1, 8, 8}};
      const auto      &made = problem.space.element.simplex() ? of_simplex : of_cube;
      const auto      &mesh = *problem.space.mesh.triangulation;
      std::array<double, 4> n{};
      n[0] = mesh.n_used_vertices();
      n[1] = mesh.n_active_lines();
      if (dim == 3)
        n[2] = mesh.n_active_faces();
      n[dim] = mesh.n_active_cells();
      if (problem.space.subdomain) // those at cuts count more than once
        problem.space.processes().sum(n.data(), n.size());
      for (unsigned level = 0; level < refinements; ++level)
        for (unsigned k = 0; k <= dim; ++k)
        {
          n[k] *= made[k][k];
          for (unsigned j = k + 1; j <= dim; ++j)
            n[k] += n[j] * made[j][k];
        }
      const auto &fe = *problem.space.fe;
      return problem.growth_in_places() * (n[0] * fe.n_dofs_per_vertex() + n[1] * fe.n_dofs_per_line() +
                                           (dim > 1 ? n[2] * fe.n_dofs_per_quad() : 0) + (dim > 2 ? n[3] * fe.n_dofs_per_hex() : 0));
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

  /// Why several processes cannot each have a part of the problem; empty: they can.
  template <int dim>
  std::string Discretisation<dim>::obstacle_to_sharing(const Problem<dim> &problem) const
  {
    if (hierarchy)
      return "";
    if (dim == 1)
      return "the mesh is one-dimensional";
    if (problem.space.element.family == ElementName::Family::discontinuous)
      return "the element is not continuous";
    if (is_refined_in_places(problem) && !problem.prescribed.periodic.empty() && !problem.space.element.simplex())
      return "cells that cuts add where the mesh is refined in places might be beside one of two periodic parts alone";
    if (problem.form->has_interior_face_terms())
      return "the form has terms on faces between cells, of which a process would know one side";
    if (factorises_parts(problem) && VertexVolumes<dim>::any(problem))
      return "a factorisation with volumes that are averaged at vertices solves it";
    const auto &bounds = problem.conditions;
    if (factorises_parts(problem) && problem.symmetric() && problem.form->order() == 1 && !bounds.empty() &&
        std::all_of(bounds.begin(), bounds.end(), [](const auto &bound) { return bound.part.has_value(); }))
      return "one factorisation serves for all contact sets, where those of parts would take one for each";
    if (const double limit = dim == 2 ? parameters.unknowns_to_share_2d : parameters.unknowns_to_share_3d;
        problem.statement.method.solver == Method::Solver::automatic && unknowns_on_finest(problem) < limit)
      return fmt::format("it has fewer than {:.0f} unknowns", limit);
    return "";
  }

  template <int dim>
  std::vector<TiedParts> tied_parts(const Problem<dim> &problem)
  {
    std::vector<TiedParts> tied;
    const auto            &conditions = problem.prescribed.conditions;
    for (dealii::types::boundary_id part = 0; part < conditions.size(); ++part)
      if (conditions[part].rigid)
        tied.push_back({part});
    for (const auto &pair : problem.prescribed.periodic)
      tied.push_back({pair.first, pair.second});
    return tied;
  }

  template <int dim>
  void Discretisation<dim>::say_if_not_shared(const Problem<dim> &problem, const Processes &processes, Progress &progress)
  {
    if (processes.alone() || problem.space.subdomain || std::exchange(told, true))
      return;
    if (const std::string obstacle = obstacle_to_sharing(problem); !obstacle.empty())
      progress.log("every process solves the whole problem: " + obstacle);
    else if (problem.statement.mesh.adapt)
      progress.log(
        fmt::format("every process solves the whole problem until a mesh has {} cells for each of them", cells_to_share(problem)));
    else
      progress.log(fmt::format("every process solves the whole problem: no mesh that could be divided has {} cells for each of them{}",
                               cells_to_share(problem),
                               tied_parts(problem).empty() ? "" : ", or one would have too many, those at rigid and periodic parts"));
  }

  template <int dim>
  std::size_t Discretisation<dim>::cells_to_share(const Problem<dim> &problem) const
  {
    return is_refined_in_places(problem) ? parameters.cells_to_share_in_places : parameters.cells_to_share;
  }

  /// Of a mesh that is refined everywhere.
  template <int dim>
  std::size_t Discretisation<dim>::cells_before_last_refinement(const Problem<dim> &problem) const
  {
    std::size_t n = problem.space.n_cells();
    for (unsigned level = problem.space.level + 1; level < problem.statement.mesh.refine; ++level)
      n <<= dim;
    return n;
  }

  template <int dim>
  void Discretisation<dim>::share_work(Problem<dim>              &problem,
                                       std::vector<Vector>       &functions,
                                       std::vector<bool>         &cells,
                                       const std::vector<double> &weights,
                                       const bool                 refined_next,
                                       const Processes           &processes,
                                       Progress                  &progress)
  {
    const unsigned n_alike = problem.space.subdomain ? problem.space.subdomain->n_alike : processes.size();
    if (n_alike == 1 || !obstacle_to_sharing(problem).empty())
      return;
    const std::size_t n_cells = problem.space.n_cells(), for_each = cells_to_share(problem);
    const bool        in_steps =
      hierarchy && !is_refined_in_places(problem) && cells_before_last_refinement(problem) >= for_each * processes.size();
    const auto steps = in_steps ? division_steps(processes.size(), parameters.parts_at_once) : std::vector<unsigned>{processes.size()};
    // Where nodes hang, the mesh may need one more refinement before it conforms at the cuts, so that is prepared early.
    const bool early = is_refined_in_places(problem) && !problem.space.element.simplex();
    const auto next = next_division(steps, processes.size(), n_alike, n_cells, early ? for_each / 2. : for_each);
    if (n_alike < processes.size())
      for (auto &function : functions) // equal up to rounding
        processes.block(n_alike).broadcast(function.begin(), function.size(), 0);
    if (next.n_parts == 1)
      return;
    if constexpr (dim > 1)
    {
      auto &whole = *problem.space.mesh.triangulation;
      if (!division)
        division = divide(whole, next.n_parts, weights, tied_parts(problem));
      if (!tied_parts(problem).empty() && !is_balanced(*division, next.n_parts))
      {
        division.reset(); // finer cells may be fewer at such parts
        return;
      }
      if (n_cells < for_each * processes.size() / next.n_alike || !conforms_at_cuts(whole, *division))
      {
        if (cells.empty())
          cells.assign(n_cells, true);
        refine_alike_at_cuts(whole, *division, cells);
        return;
      }
      const Processes group = processes.block(n_alike).every(next.n_alike);
      for (unsigned &owner : division->owner)
        owner += processes.rank() / n_alike * next.n_parts;
      problem.keep_own_part(processes.every(next.n_alike), std::move(*division), next.n_alike, functions, refined_next);
      division.reset();
      std::vector<bool> of_part;
      for (std::size_t k = 0; k < problem.space.subdomain->own_active_cells.size() && !cells.empty(); ++k)
        of_part.push_back(cells[problem.space.subdomain->own_active_cells[k]]);
      cells = std::move(of_part);
      if (hierarchy)
        add_own_part(*hierarchy, problem, group);
      if (next.n_alike == 1)
        progress.log(fmt::format("{} processes share the mesh of {} cells and all that are finer", processes.size(), n_cells));
      else
        progress.log(
          fmt::format("{} groups of {} processes share the mesh of {} cells", processes.size() / next.n_alike, next.n_alike, n_cells));
    }
  }

  template <int dim>
  bool Discretisation<dim>::shares_coarse_mesh(const Problem<dim> &problem, const Processes &processes) const
  {
    // With geometric multigrid a level that every process knows has to come before.
    if (processes.alone() || hierarchy || problem.space.subdomain || !obstacle_to_sharing(problem).empty() ||
        problem.space.mesh.triangulation->n_active_cells() < cells_to_share(problem) * processes.size())
      return false;
    if constexpr (dim > 1)
      if (const auto tied = tied_parts(problem); !tied.empty())
        return is_balanced(divide(*problem.space.mesh.triangulation, processes.size(), {}, tied), processes.size());
    return true;
  }

  template <int dim>
  void Discretisation<dim>::share_coarse_mesh(Problem<dim> &problem, const Processes &processes, Progress &progress)
  {
    std::vector<Vector> no_functions;
    std::vector<bool>   no_cells;
    if (shares_coarse_mesh(problem, processes))
      share_work(problem, no_functions, no_cells, {}, /*refined_next=*/false, processes, progress);
  }

  template <int dim>
  void Discretisation<dim>::refine(Problem<dim>                  &problem,
                                   std::vector<Vector>           &functions,
                                   const Processes               &processes,
                                   Progress                      &progress,
                                   const std::vector<bool> *const chosen,
                                   const std::vector<double>     &expected)
  {
    std::vector<bool> cells = chosen ? *chosen : problem.cells_of_next_refinement();
    share_work(problem, functions, cells, expected.empty() ? cells_that_come(cells, 1u << dim) : expected, /*refined_next=*/true, processes,
               progress);
    problem.refine(functions, /*smoothly=*/true, chosen || !cells.empty() ? &cells : nullptr);
  }

  template std::vector<TiedParts> tied_parts(const Problem<1> &);
  template std::vector<TiedParts> tied_parts(const Problem<2> &);
  template std::vector<TiedParts> tied_parts(const Problem<3> &);
  template class Discretisation<1>;
  template class Discretisation<2>;
  template class Discretisation<3>;
} // namespace unilateral
