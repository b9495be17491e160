// The coarse operators of truncated multigrid: Galerkin products, cell by cell.
#pragma once

#include "unilateral/multigrid/multigrid_level.h"
#include "unilateral/multigrid/tangent_penalty.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace unilateral
{
  /// A_H = sum over cells of P_c' A_c P_c, without the rows and columns of unknowns that the penalty truncates on the finest level, and
  /// with what it adds elsewhere. Where nothing below a cell is truncated or penalised that is the cell's own A_K; the others are kept in
  /// MultigridLevel::change.
  class CoarseOperators
  {
  public:
    explicit CoarseOperators(std::shared_ptr<const LevelHierarchy> hierarchy);

    /// For all levels but the finest, which must be as if there were no penalty.
    void compute(const TangentPenalty &penalty, std::vector<MultigridLevel> &levels);

    /// Of the finest level those that have an unknown of a node of the penalty.
    std::vector<std::uint32_t> cells_at_nodes() const;

  private:
    /// What is known of an unknown or of all unknowns of a cell of the finest level, as bits.
    static constexpr unsigned char is_penalised = 1, is_left = 2, is_at_node = 4, is_taken = 8; ///< left: not truncated

    void look_at_cells(const TangentPenalty &penalty);

    /// To unknowns that depend on others: what is known of those.
    void hand_on_flags();

    void coarsen(const TangentPenalty &penalty, std::vector<MultigridLevel> &levels, unsigned level);

    /// @p matrix of a cell of the finest level without what is truncated and with the penalty on its unknowns, each once.
    void truncate(const TangentPenalty &penalty, const std::vector<std::uint32_t> &dofs, double *matrix);

    /// The same for one whose unknowns depend on others: it loses what truncation takes from these, in proportion.
    void truncate(const TangentPenalty &penalty, const Dependence &dependence, const std::vector<std::uint32_t> &dofs, double *matrix);

    /// Of the cells of a whole, from all processes that have a part of it.
    void gather_changes(std::vector<MultigridLevel> &levels, const LevelHierarchy::Cut &cut) const;
    void collect_differences(MultigridLevel &coarse, const SharedUnknowns &shared) const;

    std::shared_ptr<const LevelHierarchy> hierarchy;
    std::vector<unsigned char>            flags, cell_flags; ///< of the finest level
    std::vector<std::uint32_t>            flagged;           ///< unknowns that are not just left
  };
} // namespace unilateral
