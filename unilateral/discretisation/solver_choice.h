// Which implementation of DiscreteProblem a run uses, and what its levels share.
#pragma once

#include "unilateral/base/division_steps.h"
#include "unilateral/base/progress.h"
#include "unilateral/constraints/constraint_trace.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/inequality/discrete_problem.h"
#include "unilateral/inequality/method_of_multipliers.h"
#include "unilateral/multigrid/level_hierarchy.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  /// What a Discretisation with assembled matrices decides on the coarse mesh.
  struct DiscretisationChoice
  {
    Method::Solver solver = Method::Solver::automatic;
    std::string    no_multigrid, explanation;

    template <typename Archive>
    void archive(Archive &bytes)
    {
      bytes(solver);
      bytes(no_multigrid);
      bytes(explanation);
    }
  };

  /// What the next mesh is to be where the error says it.
  struct RefinementByError
  {
    const std::vector<bool> *cells = nullptr; ///< the active cells to refine
    std::vector<double>      expected;        ///< how many cells each active one will have become on the last mesh; empty: unknown
    double                   n_unknowns = 0;  ///< of the next mesh, about
  };

  /// The parts of the boundary whose nodes are tied to each other: rigid ones, and pairs of periodic ones.
  template <int dim>
  std::vector<TiedParts> tied_parts(const Problem<dim> &problem);

  /// How many cells each active cell will have become after all local refinements, by which a mesh without tied parts is divided. Empty:
  /// all become as many. The balance is worth more than the cells that are added beside cuts where nodes hang.
  template <int dim>
  std::vector<double> cells_to_come(const Problem<dim> &problem);

  /// Makes a DiscreteProblem for each level of a run in turn.
  template <int dim>
  class Discretisation
  {
  public:
    struct Parameters
    {
      /// `auto` takes geometric multigrid when the finest level has more unknowns than a factorisation does as quickly,
      std::size_t direct_limit_2d = 20000, direct_limit_3d = 5000;
      /// and the coarse mesh, which is factorised for each active set, not more than these.
      std::size_t coarse_limit_2d = 100000, coarse_limit_3d = 20000;
      /// Where iterative solvers fail, a factorisation takes over that is affordable up to here, on the finest level.
      std::size_t affordable_2d = 300000, affordable_3d = 60000;
      /// Several processes divide the first mesh with so many cells for each part; what is coarser all of them have. A mesh that is refined
      /// in places is divided later, when it shows where its cells will be.
      std::size_t cells_to_share = 1000, cells_to_share_in_places = 2000;
      /// With geometric multigrid on meshes that are refined everywhere a mesh is divided in at most so many parts at a time. That bounds
      /// the levels that several processes have alike.
      unsigned parts_at_once = 16;
      /// Assembled matrices, on the finest level, from so many unknowns on: below, one factorisation is as quick. `amg` always.
      double unknowns_to_share_2d = 100000, unknowns_to_share_3d = 60000;
      /// With `mesh.adapt` most time goes to estimates and bounds of the error, which are shared as soon as the mesh is.
      double unknowns_to_share_adapted = 20000;
      /// A factorisation that serves for all contact sets, as with contact on the boundary alone, is one process's up to so many unknowns.
      /// From there on the factors are shared for their memory, although those of parts, one for each contact set, take two to four times
      /// as long (measured with 60 000 unknowns in space and 110 000 in the plane, two processes).
      double factorised_by_one_2d = 2e6, factorised_by_one_3d = 2e5;
      /// The largest part over the mean of all from which on cells are exchanged; once a part has been refined that costs multigrid its
      /// coarser spaces, and has to save more.
      double imbalance = 1.2, imbalance_once_refined = 1.35;
      /// Where iterations on parts fail, the factors of a matrix with so many unknowns fit into the memory of a few processes; whether they
      /// do is checked before they are made.
      double affordable_for_parts_2d = 5e6, affordable_for_parts_3d = 4e5;
    };

    /// @p problem: on its coarse mesh. Throws InputError when the case asks for multigrid where it cannot serve.
    explicit Discretisation(const Problem<dim> &problem, const Parameters &parameters = Parameters());

    /// On a part of the coarse mesh; @p choice: on the whole.
    Discretisation(const Problem<dim> &problem, const DiscretisationChoice &choice, const Parameters &parameters = Parameters());
    DiscretisationChoice choice() const { return {solver, no_multigrid, explanation}; }

    std::unique_ptr<DiscreteProblem> on_level(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set);

    /// Other data on the level of @p problem, after Problem::restate() has told what is @p unchanged: @p discrete, which comes from
    /// on_level(), takes them over, or another one takes its place. False where the levels have to be built anew, from the coarse mesh on.
    bool restate(const Problem<dim>                     &problem,
                 const ConstraintSet<dim>               &constraint_set,
                 const typename Problem<dim>::Unchanged &unchanged,
                 std::unique_ptr<DiscreteProblem>       &discrete);

    /// After @p outcome of @p failed on the level of @p problem, once, where the case leaves the choice: true when levels from here on,
    /// this one anew, have a direct solver, because an iterative one did not converge and a factorisation is affordable; or an iterative
    /// one, because a contact set leaves modes of a body so nearly free that factors have no digits for them, which conjugate gradients,
    /// starting from zero, leave alone.
    bool fall_back(const Problem<dim> &problem, const DiscreteProblem &failed, const MultiplierResult &outcome, Progress &progress);

    /// The coarse mesh is to be divided among @p processes, or, where it has been read in parts, to stay so: it is large enough, nothing
    /// coarser has to be solved, and no nodes that are tied to each other are in different parts. Collective if it is divided.
    bool shares_coarse_mesh(const Problem<dim> &problem, const Processes &processes) const;

    /// Before the first level divides it then.
    void share_coarse_mesh(Problem<dim> &problem, const Processes &processes, Progress &progress);

    /// The next level: refines the mesh of @p problem and carries @p functions over to it, smoothly. Of several processes each is left with
    /// a part of the problem and of the functions once the mesh is fine enough, if the case allows it, and with another part where the
    /// parts have come, or would come, to differ; which is said.
    /// The mesh is divided by what cells are expected to become. Without @p by_error: all cells are refined, or those of the next local
    /// refinement.
    void refine(Problem<dim>            &problem,
                std::vector<Vector>     &functions,
                const Processes         &processes,
                Progress                &progress,
                const RefinementByError *by_error = nullptr);

    /// To be called on the last level: says once, in one line, why each of several processes solves the whole, where it does.
    void say_if_not_shared(const Problem<dim> &problem, const Processes &processes, Progress &progress);

    /// One sentence: which solver, and why; of the last level so far.
    const std::string &reason() const { return explanation; }

  private:
    std::unique_ptr<DiscreteProblem> assembled_on_level(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set);
    std::unique_ptr<DiscreteProblem> shared_on_level(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set);
    bool                             factorises_parts(const Problem<dim> &problem) const;
    std::unique_ptr<DiscreteProblem> matrix_free_on_level(const Problem<dim> &problem, ConstraintTrace trace, Vector load) const;

    /// @p n_finest: unknowns, about, on the last mesh that is known to come.
    std::string obstacle_to_sharing(const Problem<dim> &problem, double n_finest) const;
    bool        limits_unknowns(const Problem<dim> &problem) const;
    double      unknowns_to_share(const Problem<dim> &problem) const;
    std::size_t cells_to_share(const Problem<dim> &problem) const;
    std::size_t cells_before_last_refinement(const Problem<dim> &problem) const;

    /// @p cells: to be refined next, of the whole mesh and then of the own part; empty: all. Where the mesh does not conform at the cuts,
    /// or is not large enough yet, it takes more cells, after which the next one does. @p weights: of active cells; empty: all alike.
    void share_work(Problem<dim>              &problem,
                    std::vector<Vector>       &functions,
                    std::vector<bool>         &cells,
                    const std::vector<double> &weights,
                    double                     n_finest,
                    bool                       refined_next,
                    const Processes           &processes,
                    Progress                  &progress);
    void balance_parts(Problem<dim>              &problem,
                       std::vector<Vector>       &functions,
                       std::vector<bool>         &cells,
                       const std::vector<double> &weights,
                       Progress                  &progress) const;

    std::shared_ptr<LevelHierarchy> hierarchy;                          ///< none: assembled matrices
    Method::Solver                  solver = Method::Solver::automatic; ///< of those
    std::string                     no_multigrid;                       ///< why `auto` does not take it, where it looks for another solver
    std::string                     explanation;
    Parameters                      parameters;
    std::optional<Division>         division;     ///< of the mesh at hand, once it is large enough
    bool                            told = false; ///< that work is not shared
    bool                            fell_back = false;
  };
} // namespace unilateral
