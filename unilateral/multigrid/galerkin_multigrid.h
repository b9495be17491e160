// Multigrid for assembled matrices: coarser spaces are given by their prolongations, coarser matrices are Galerkin products.
#pragma once

#include "unilateral/algebra/sparse_rows.h"
#include "unilateral/algebra/symmetric_block_matrix.h"
#include "unilateral/base/shared_unknowns.h"
#include "unilateral/multigrid/aggregation.h"

#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_pattern.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace unilateral
{
  class GatheredSystem;
  class LinearSolver;
  class SharedGaussSeidel;
  class SparseCholesky;

  /// A symmetric preconditioner of T = A + B'DB, A symmetric positive (semi)definite, on spaces V_h = V_0 > V_1 > ... > V_L: linear
  /// functions within V_h, those on the mesh before, and so on. P_l is the prolongation to V_l:
  ///
  ///     T_(l+1) = P_l' T_l P_l = A_(l+1) + B_(l+1)' D B_(l+1),    A_(l+1) = P_l' A_l P_l,    B_(l+1) = B_l P_l
  ///
  ///     V-cycle on level l for T_l x = r:
  ///       x = first sweep of Gauss-Seidel by nodes
  ///       x = x + P_l y,  y from a V-cycle on level l+1 for T_(l+1) y = P_l'(r - T_l x)
  ///       x = backward sweep
  ///
  /// Where a factorisation of T_L takes too much, further spaces come from smoothed aggregation (aggregation.h) until T_L is small. There
  /// "nodes" are aggregates. Where that leads nowhere one V-cycle of Trilinos ML takes the place of T_L^-1; without coarser spaces it is
  /// one for T itself, between the sweeps.
  ///
  /// Where each of several processes has a part of V_0, ..., V_L, which they share as SharedUnknowns says, A_l, B_l and P_l are of the own
  /// cells and points, the sums over all processes those above. Where T_L is large, smoothed aggregation goes on
  /// from there, as far as it leads. Then T_L is brought together on every process, and each has the whole of what follows, a factorisation
  /// or further spaces.
  ///
  /// All A_l are computed once. Another D changes the rows that points see; T_L^-1, being part of a preconditioner, is made anew only where
  /// many points have changed since it was made. Contact is thus carried to all levels as it is, without truncation.
  class GalerkinMultigrid
  {
  public:
    struct Parameters
    {
      unsigned            block_size = 1;  ///< unknowns at one node, in the spaces that are given: 1, 2 or 3
      std::vector<Vector> near_null_space; ///< of the last space that is given; none: the constant
      /// T_L is factorised where that takes no more operations for an entry of A,
      double operations_per_entry = 2000;
      /// and made anew where more than this part of the points that touch has changed.
      double changed_part = 0.3;
      /// T itself, too, where there is no coarser space.
      bool may_factorise_finest = false;
      /// Up to so many unknowns the last space that is given is brought together on every process where each has a part.
      std::size_t                 largest_gathered = 20000;
      std::vector<SharedUnknowns> shared; ///< for each space that is given, V_h first; none: this process has the whole
    };

    /// Keeps a reference to B. A comes in blocks of parameters.block_size; matrix() is it from then on.
    GalerkinMultigrid(SymmetricBlockMatrix A, const SparseRows &B, std::vector<OwnSparseRows> prolongations, Parameters parameters);
    ~GalerkinMultigrid();

    /// For D = diag(@p d), d >= 0; zero for points that another process owns.
    void set_diagonal(const Vector &d);

    void vmult(Vector &x, const Vector &r) const;

    /// "multigrid with assembled matrices on 3 levels, of which the coarsest, 1200 unknowns, is factorised".
    std::string description() const;

    const SymmetricBlockMatrix &matrix() const { return levels[0]->in_blocks; }

    std::size_t n_levels() const { return levels.size(); }
    bool        factorises() const { return on_whole ? on_whole->factorises() : cholesky != nullptr; } ///< T_L
    std::size_t n_setups() const { return on_whole ? on_whole->n_setups() : setups; }                  ///< of T_L^-1 since construction

  private:
    struct Level
    {
      dealii::SparsityPattern            pattern;
      dealii::SparseMatrix<double>       A;          ///< of the coarsest level, of others until the next coarser one is made
      SymmetricBlockMatrix               in_blocks;  ///< A of the finest level, and of others than the coarsest
      OwnSparseRows                      B;          ///< none of the finest level
      OwnSparseRows                      P;          ///< from the next coarser one, where that was given
      BlockProlongation                  aggregates; ///< else
      unsigned                           block_size = 1;
      SharedUnknowns                     shared;
      std::unique_ptr<SharedGaussSeidel> smoother;   ///< none of the coarsest where there are several, or where T itself is factorised
      mutable std::vector<float>         r, x, rest; ///< of the sweeps
    };

    void                 add_level(OwnSparseRows P);
    bool                 add_aggregated_level(AggregationParameters &aggregation); ///< false: it would not be much smaller
    void                 make_smoother(std::size_t l);
    static std::uint64_t n_unknowns(const Level &coarsest); ///< on all processes
    void                 gather_coarsest();
    void                 choose_coarse_solver();
    void                 make_coarse_amg();
    bool                 coarse_solver_serves(const Vector &d) const;
    void                 set_up_coarse_solver(const Vector &d);
    SparseRows           rows(std::size_t l) const { return l == 0 ? B : levels[l]->B.rows(); }

    void v_cycle(std::size_t l) const;
    static void restrict(const Level &level, std::vector<float> &coarser);                       ///< coarser = P' rest
    static void prolongate(const std::vector<float> &coarser, float factor, const Level &level); ///< x += factor P coarser
    void        solve_on_coarsest() const;

    const SparseRows                    B;
    const Parameters                    parameters;
    const std::size_t                   n_entries;         ///< of A
    std::vector<Vector>                 modes_of_coarsest; ///< near null space of the last space
    std::vector<std::unique_ptr<Level>> levels;
    std::unique_ptr<GatheredSystem>     gathered; ///< T_L of several processes,
    std::unique_ptr<GalerkinMultigrid>  on_whole; ///< and what takes the place of its inverse
    std::unique_ptr<SparseCholesky>     cholesky;
    std::unique_ptr<LinearSolver>       amg; ///< where that is none, or T_L not positive definite by its pivots
    Vector                              d_of_coarse_solver;
    bool                                is_factorised = false; ///< T_L, now
    std::size_t                         setups = 0;
    mutable Vector                      coarse_r, coarse_x, whole_r, whole_x;
  };
} // namespace unilateral
