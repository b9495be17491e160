// Smoothed aggregation for a sparse matrix of which each of several processes has a part: Trilinos ML.
#pragma once

#include "unilateral/algebra/numbers_of_all.h"
#include "unilateral/algebra/vector.h"

#include <deal.II/lac/sparse_matrix.h>

#include <memory>

namespace unilateral
{
  /// A preconditioner for GMRES. The matrix is the sum of what the processes have; each takes the rows of the unknowns that it owns. All
  /// operations are collective.
  class DistributedAmg
  {
  public:
    /// @p higher_order: element degree > 1.
    DistributedAmg(const SharedUnknowns &shared, std::size_t n_dofs, bool higher_order);
    ~DistributedAmg();

    /// @p own: what this process has of the matrix.
    void set_matrix(const dealii::SparseMatrix<double> &own);

    /// z = P^-1 r, for vectors that have equal values on all processes with an unknown.
    void vmult(Vector &z, const Vector &r) const;

  private:
    struct Trilinos; ///< hides its headers

    NumbersOfAll              numbers;
    bool                      higher_order;
    std::unique_ptr<Trilinos> trilinos;
  };
} // namespace unilateral
