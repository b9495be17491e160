// B' D B on the finest level: what a linearised inequality adds to A, and what of it is too stiff for coarse functions.
#pragma once

#include "unilateral/multigrid/level_hierarchy.h"
#include "unilateral/multigrid/node_penalty.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace unilateral
{
  /// The sum of a diagonal, of blocks that couple the components at a node, and of blocks that couple the unknowns of a cell. An unknown is
  /// met by the diagonal or by one node, not by both.
  class TangentPenalty
  {
  public:
    struct CellBlock
    {
      std::uint32_t       cell;
      std::vector<double> matrix; ///< n_cell_dofs^2 numbers, of a dependent cell on its own unknowns
    };

    /// @p truncation: an unknown is truncated where d_i exceeds this multiple of a_ii.
    TangentPenalty(std::shared_ptr<const LevelHierarchy> hierarchy, double truncation);

    void set(const std::vector<double> &diagonal, const std::vector<DenseBlock> &node_blocks, std::vector<CellBlock> cell_blocks);

    void add(double *y, const double *x, double factor) const; ///< y += factor B' D B x

    bool truncates(const std::uint32_t dof) const { return on_diagonal[dof] > truncation * hierarchy->finest().diagonal()[dof]; }

    double                            diagonal(const std::uint32_t dof) const { return on_diagonal[dof]; }
    const std::vector<std::uint32_t> &unknowns() const { return penalised; } ///< where the diagonal is not zero
    const std::vector<CellBlock>     &cells() const { return cell_blocks; }  ///< in ascending order

    bool empty() const { return !any; }                          ///< on all processes
    bool couples_unknowns_of_cells() const { return any_cells; } ///< on any process

    NodePenalty nodes;

  private:
    std::shared_ptr<const LevelHierarchy> hierarchy;
    double                                truncation;
    std::vector<double>                   on_diagonal;
    std::vector<std::uint32_t>            penalised;
    std::vector<CellBlock>                cell_blocks;
    bool                                  any = false, any_cells = false;
  };
} // namespace unilateral
