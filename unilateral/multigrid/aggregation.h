// Smoothed aggregation: a coarser space from the matrix alone and the functions that have nearly no energy.
#pragma once

#include "unilateral/algebra/sparse_rows.h"
#include "unilateral/algebra/vector.h"
#include "unilateral/base/shared_unknowns.h"

#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_pattern.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace unilateral
{
  /// Disjoint sets of nodes. A node is block_size unknowns in sequence.
  struct Aggregates
  {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    std::vector<std::uint32_t> of_node; ///< none where all unknowns are fixed: rows of A that are zero outside the diagonal
    std::uint32_t              size = 0;
  };

  /// Aggregates of nodes that are strongly connected, of all neighbours of a node where that is possible: nodes i and j are where
  /// |A_ij|^2 > threshold^2 |A_ii| |A_jj|, Frobenius' norms of blocks.
  Aggregates aggregates(const dealii::SparseMatrix<double> &A, unsigned block_size, double threshold);

  /// v = P w in single precision, in blocks: row block i, of node i, has a block for each aggregate that it depends on.
  struct BlockProlongation
  {
    unsigned                   n_rows = 1, n_columns = 1; ///< of a block
    std::size_t                n_aggregates = 0;
    std::vector<std::size_t>   row_start = {0}; ///< of the blocks of a node
    std::vector<std::uint32_t> columns;         ///< aggregates, ascending in a row
    std::vector<float>         blocks;          ///< row by row

    std::size_t n_nodes() const { return row_start.size() - 1; }
    std::size_t n_fine() const { return n_nodes() * n_rows; }
    std::size_t n_coarse() const { return n_aggregates * n_columns; }

    void restrict(const float *fine, float *coarse) const;                 ///< coarse = P' fine
    void prolongate(const float *coarse, float factor, float *fine) const; ///< fine += factor P coarse
  };

  /// V_H = P w and what has nearly no energy in it.
  struct AggregatedSpace
  {
    BlockProlongation   P;
    std::vector<Vector> near_null_space; ///< in terms of w
    SharedUnknowns      shared;          ///< of w
  };

  struct AggregationParameters
  {
    double threshold = 0.02; ///< of strong connections
  };

  /// P = (I - 4/3 lambda^-1 D^-1 A) Q, lambda the largest eigenvalue of D^-1 A, D the diagonal blocks of A, and Q the restrictions of
  /// @p near_null_space to each aggregate, made orthonormal: N = P N_H but for what is next to fixed unknowns. Reference: P. Vanek,
  /// J. Mandel, M. Brezina, Computing 56 (1996). The unknowns at an aggregate are as many as functions in the near null space; those that
  /// an aggregate is too small for have empty columns.
  ///
  /// Where each of several processes has a part of A (@p shared; A is the sum), nodes inside a part form aggregates of their own, and so do
  /// the nodes on cuts that the same processes have, by their owner. The former's rows of A are complete and are smoothed as above, those
  /// of nodes on cuts are rows of Q. So every process has all of P that its nodes need, and P'AP is a sum over the processes again.
  /// Collective.
  AggregatedSpace aggregated_space(const dealii::SparseMatrix<double> &A,
                                   unsigned                            block_size,
                                   const std::vector<Vector>          &near_null_space,
                                   const AggregationParameters        &parameters,
                                   const SharedUnknowns               &shared = {});

  /// P'AP, with ones on the diagonal where a column of P is empty.
  void galerkin_product(const dealii::SparseMatrix<double> &A,
                        const BlockProlongation            &P,
                        dealii::SparsityPattern            &pattern,
                        dealii::SparseMatrix<double>       &product);

  /// BP
  OwnSparseRows product(const SparseRows &B, const BlockProlongation &P);
} // namespace unilateral
