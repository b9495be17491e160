// The smoother of assembled matrices of which each of several processes has a part.
#pragma once

#include "unilateral/base/shared_unknowns.h"
#include "unilateral/multigrid/block_gauss_seidel.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace unilateral
{
  /// T is the sum of T_p = A_p + B_p'D B_p over the processes p, A_p from their cells and B_p from their points. At nodes on cuts, of
  /// which S are the unknowns and I the others, vectors are equal on all processes that have them.
  ///
  ///     first:     x_I = first sweep of Gauss-Seidel,        x_S = omega D_S^-1 (r - T x)_S
  ///     backward:  x_S = x_S + omega D_S^-1 (r - T x)_S,     x_I = backward sweep
  ///
  /// D_S are the diagonal blocks of T and omega = 1.55 over the largest eigenvalue of D_S^-1 T_SS, at most one. Nodes inside parts are not
  /// coupled across cuts, so that all processes sweep at the same time, and the two together are symmetric. One message to each neighbour
  /// each time. A process alone has no S: these are the sweeps of BlockGaussSeidel.
  class SharedGaussSeidel
  {
  public:
    /// Keeps references to A, B and @p shared. A and B: the own part.
    SharedGaussSeidel(const SymmetricBlockMatrix &A, const SparseRows &B, const SharedUnknowns &shared);

    /// For D = diag(@p d), d >= 0; zero of points that another process owns.
    void set_diagonal(const Vector &d);

    double scale() const { return inside.scale(); }

    /// @p rest: what this process has of it; the sum over all is r - T x.
    void first_sweep(const float *r, float *x, float *rest) const;
    /// @p scratch: n numbers.
    void backward_sweep(const float *r, float *x, float *scratch) const;

  private:
    struct BlockOfRow ///< of T_p, block k of L, or its transpose
    {
      std::uint32_t column;
      bool          transposed;
      std::size_t   k;
    };

    static std::vector<std::uint32_t> nodes_on_cuts(const SharedUnknowns &shared, unsigned block_size);

    void set_up_cuts();
    void update_omega();
    /// visit(block column by column, transposed, column) for each block in the row of a node on a cut that is not on the diagonal.
    template <typename Visit>
    void for_each_block(std::size_t cut_node, const Visit &visit) const;
    void residual_on_cuts(const float *r, const float *x) const; ///< on_cuts = what this process has of (r - T x)_S
    void correct_on_cuts(float *x) const;                        ///< x_S += omega D_S^-1 of the sum of what processes have in on_cuts
    void subtract_columns(const float *x, float *rest) const;    ///< rest -= T_p x_S

    const SymmetricBlockMatrix      &A;
    const SharedUnknowns            &shared;
    const unsigned                   b;
    const std::vector<std::uint32_t> cut_nodes;
    BlockGaussSeidel                 inside;
    std::vector<std::size_t>         row_start = {0}; ///< of the blocks of each node on a cut
    std::vector<BlockOfRow>          row_blocks;
    std::vector<float>               inverse_on_cuts; ///< D_S^-1
    float                            omega = 1;
    mutable std::vector<float>       on_cuts, changed_r; ///< by unknown
  };
} // namespace unilateral
