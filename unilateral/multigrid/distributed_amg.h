// Algebraic multigrid for a system of which each of several processes has a part, and no process the whole.
#pragma once

#include "unilateral/algebra/sparse_rows.h"
#include "unilateral/algebra/vector.h"
#include "unilateral/base/shared_unknowns.h"

#include <deal.II/lac/sparse_matrix.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace unilateral
{
  /// One V-cycle of Trilinos ML, smoothed aggregation, for T = A + B'DB: A and B'DB are sums over the processes. Every unknown is a row of
  /// the process that owns it.
  class DistributedAmg
  {
  public:
    /// @p A, @p B: the own part, to be kept as long as this. @p block_size unknowns in sequence are those of a node, with one owner.
    /// @p near_null_space: of A; none: the constant. Collective.
    DistributedAmg(const dealii::SparseMatrix<double> &A,
                   const SparseRows                   &B,
                   const SharedUnknowns               &shared,
                   unsigned                            block_size,
                   std::vector<Vector>                 near_null_space);
    ~DistributedAmg();

    std::uint64_t size() const; ///< of T

    /// For D = diag(@p d), zero for points that another process owns. Collective.
    void set_diagonal(const Vector &d);

    /// Both have equal values at shared unknowns. Collective.
    void vmult(Vector &x, const Vector &r) const;

  private:
    struct Trilinos;

    const dealii::SparseMatrix<double> &A;
    const SparseRows                    B;
    const SharedUnknowns               &shared;
    const unsigned                      block_size;
    const std::vector<Vector>           near_null_space;
    std::vector<std::uint64_t>          number; ///< of each unknown, in T
    std::unique_ptr<Trilinos>           trilinos;
  };
} // namespace unilateral
