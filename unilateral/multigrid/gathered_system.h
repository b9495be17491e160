// A small system of which each of several processes has a part, brought together on all of them.
#pragma once

#include "unilateral/algebra/sparse_rows.h"
#include "unilateral/algebra/vector.h"
#include "unilateral/base/shared_unknowns.h"

#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_pattern.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace unilateral
{
  /// A is the sum of A_p over the processes p, B has the rows B_p one below the other. Unknowns are numbered by their owners, those of the
  /// process of rank 0 first; in each part as there. Every process gets the same numbers.
  class GatheredSystem
  {
  public:
    /// @p A, @p B: the own part. Throws std::runtime_error where the whole is too large for one message.
    GatheredSystem(const dealii::SparseMatrix<double> &A, const SparseRows &B, const SharedUnknowns &shared);

    const dealii::SparseMatrix<double> &matrix() const { return A; }
    SparseRows                          rows() const { return B.rows(); }
    std::size_t                         size() const { return n_unknowns; }

    void release_matrix(); ///< when it has been copied

    /// The whole of a function that has equal values at shared unknowns, and the own part of one.
    void take_whole(const Vector &own, Vector &whole) const;
    void take_own(const Vector &whole, Vector &own) const;

    /// What belongs to the points, in the order of the rows.
    Vector at_points(const Vector &own) const;

  private:
    const SharedUnknowns        &shared;
    std::size_t                  n_unknowns = 0;
    std::vector<std::uint32_t>   number; ///< of each unknown of the own part
    dealii::SparsityPattern      pattern;
    dealii::SparseMatrix<double> A;
    OwnSparseRows                B;
  };
} // namespace unilateral
