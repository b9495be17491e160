// A level of the V-cycle: what A has become there, and the vectors.
#pragma once

#include "unilateral/base/shared_unknowns.h"
#include "unilateral/multigrid/patch_sweep.h"

#include <cstdint>
#include <vector>

namespace unilateral
{
  struct MultigridLevel
  {
    /// @p shared: by unknown.
    MultigridLevel(const CellOperator &stiffness, const PatchSweep &sweep, const SharedUnknowns &shared);

    /// The diagonal on the cuts before the own cells change it, and what the cells of others change.
    std::vector<double> diagonal_on_cuts(const SharedUnknowns &shared) const;
    void                add_diagonal_of_others(const SharedUnknowns &shared, const std::vector<double> &base);

    /// A coarse function of which truncation leaves less than this part of its energy is left out: in single precision its row would be
    /// noise.
    static constexpr double negligible_energy = 1e-3;

    /// Whether coarse corrections reach a position.
    void receive(std::uint32_t place, float value);

    /// As if there were no penalty.
    void reset(std::uint32_t dof);

    void add_block(const std::vector<std::uint32_t> &dofs, const double *matrix);

    /// Prepares `terms` for a product with x: blocks, and what other processes add on the cuts.
    void add_terms(const float *x);

    const CellOperator *stiffness;
    const PatchSweep   *sweep;
    double              stiffness_eigenvalue; ///< largest of diag(A)^-1 A
    std::vector<char>   is_fixed;             ///< by Dirichlet data

    std::vector<double>        diagonal; ///< of what A has become, without truncation on the finest level
    std::vector<std::uint32_t> touched;  ///< unknowns that are not as A alone has them (some more than once)

    /// For each cell what it adds in place of the level's own A_K, because of what is truncated or penalised below it: unchanged, vanished
    /// (its matrix is zero now) or an entry of `changed_matrices`. Empty: all unchanged.
    static constexpr std::int32_t unchanged = -1, vanished = -2;
    std::vector<std::int32_t>     change;
    std::vector<double>           changed_matrices;

    /// What is to be added to A x, as small matrices: the same as differences to A_K, and blocks outside the cells.
    std::vector<std::uint32_t> block_start = {0}, block_positions;
    std::vector<float>         block_matrices;

    /// What own cells on the cut add to A x there: others need it.
    SharedUnknowns             shared; ///< by position
    std::vector<std::uint32_t> cut_positions;
    std::vector<float>         cut_matrices;
    LevelVector                on_cuts;

    PatchSweep::Additions additions;
    double                largest_eigenvalue = 1;
    LevelVector           penalty;          ///< on the diagonal
    LevelVector           inverse_diagonal; ///< 0 where nothing is to be solved for
    LevelVector           receives;         ///< 1 where coarse corrections go, else 0
    LevelVector           sends;            ///< the same, 0 where another process restricts the residual
    LevelVector           x, b, step, terms;

  private:
    void prepare_exchange(const SharedUnknowns &shared_unknowns);
  };
} // namespace unilateral
