// A level of the V-cycle in single precision: products with A fused with what is done to the unknowns that they complete.
#pragma once

#include "unilateral/multigrid/cell_operator.h"
#include "unilateral/multigrid/simd.h"
#include "unilateral/multigrid/sparse_transfer.h"

#include <deal.II/base/aligned_vector.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace unilateral
{
  /// Numbers for the unknowns of a level at their positions() in a PatchSweep; the entries between them stay zero.
  using LevelVector = dealii::AlignedVector<float>;

  /// Passes over the patches of a CellOperator, 16 at a time, one in each lane of a SIMD register.
  ///
  /// Unknowns are renumbered: a batch of 16 patches has first those inside its patches, 16 next to each other for each place in the patch,
  /// which are loaded and stored as they lie; then those on the hulls of patches that no later batch touches, which are gathered and
  /// scattered. So when a batch has been done, A x is complete for all that has a number of this batch or of one before, no later batch
  /// reads x there, and the smoother can move them while they are in the cache. What other processes add to A x has to be there before
  /// the pass begins, among the terms beside the A_K of cells.
  class PatchSweep
  {
  public:
    /// @p coarser: the next coarser level, if any; @p to_child: as in LevelHierarchy.
    PatchSweep(const CellOperator &op, const PatchSweep *coarser, const std::vector<std::vector<double>> &to_child);

    /// With a transfer that is not the same on all patches.
    PatchSweep(const CellOperator &op, const PatchSweep &coarser, const SparseTransfer &transfer);

    bool has_sparse_transfer() const { return !in_places.row_start.empty(); }
    /// Of has_sparse_transfer(): unknown @p dof in terms of coarse ones, (position, weight).
    std::vector<std::pair<std::uint32_t, float>> coarse_row(std::uint32_t dof) const;

    std::size_t                       size() const { return n; } ///< entries of a LevelVector
    const std::vector<std::uint32_t> &positions() const { return position; }

    /// What lies beside the A_K of cells, for some batches only.
    struct Additions
    {
      const float                   *penalty = nullptr; ///< diagonal, added to A; none: 0
      std::vector<unsigned char>     batches;           ///< of each batch: bits of the following; empty: none
      static constexpr unsigned char has_penalty = 1, has_terms = 2;
    };
    std::size_t n_batches() const { return begin_of_batch.size() - 1; }
    std::size_t batch_of(const std::size_t position) const { return batch_of_lanes[position / n_lanes]; } ///< the one that completes it

    struct Smoothing
    {
      float       *x;
      const float *previous_step; ///< none: 0
      float       *step;          ///< none: not wanted
      const float *b, *inverse_diagonal;
      float        keep, gain;
    };
    /// step = keep previous_step + gain D^-1 (b - A x - terms); x += step. @p terms: what blocks outside the cells add to A x where
    /// Additions::has_terms is set, zero elsewhere; it is zero afterwards.
    void smooth(const Smoothing &smoothing, const Additions &additions, float *terms) const;

    /// coarse_b += P' R (b - A x - terms), R = diag(@p receives). @p scratch: as long as x.
    void restrict_residual(float           *coarse_b,
                           const float     *b,
                           const float     *x,
                           const float     *receives,
                           const Additions &additions,
                           float           *terms,
                           float           *scratch) const;

    /// x += R P coarse_x.
    void prolongate(float *x, const float *coarse_x, const float *receives) const;

    std::size_t memory() const; ///< bytes

  private:
    static constexpr unsigned n_lanes = CellOperator::n_lanes;

    using Lanes = Simd<float>::Lanes;

    /// Of the patches of a group: unknowns inside come first.
    struct Numbering
    {
      PatchShape shape;
      unsigned   n_inside, n_hull;
    };
    std::vector<std::uint32_t> number_inside_first(const std::vector<unsigned char> &shared, unsigned group);
    void                       number_unknowns();
    void                       take_rows(const PatchSweep &coarser, const SparseTransfer &transfer);
    void                       connect(const PatchSweep &coarser, const std::vector<std::vector<double>> &to_child);
    const Numbering           &numbering_of(std::size_t batch) const { return groups[op->batches()[batch].group]; }
    const std::uint32_t       *hull_of(std::size_t batch) const { return hull.data() + std::size_t(first_of_hull[batch]) * n_lanes; }
    void                       load_patch(Lanes *patch, const float *x, std::size_t batch) const;
    void                       multiply(Lanes *y_patch, const Lanes *x_patch, std::size_t batch) const;

    /// @p visit(i, A x + terms) for the 16 positions from i on, batch by batch when they are complete; x may change there.
    template <typename Visit>
    void for_each_product(const float *x, const Additions &additions, float *terms, const Visit &visit) const;

    const CellOperator        *op;
    std::vector<float>         matrices; ///< those of op
    std::size_t                n = 0;
    std::vector<Numbering>     groups;
    std::vector<std::uint32_t> position;       ///< of each unknown of op
    std::vector<std::uint32_t> begin_of_batch; ///< and the end
    std::vector<std::uint32_t> batch_of_lanes; ///< for every 16 positions
    std::vector<std::uint32_t> first_of_hull;  ///< of each batch, where its unknowns on hulls begin
    std::vector<std::uint32_t> hull;           ///< positions, entry [(first_of_hull + i) * n_lanes + lane]
    std::vector<std::uint16_t> owned;          ///< entry [first_of_hull + i]: bits of lanes that complete their unknown

    /// Transfer: the unknowns of a patch in terms of those of its parents, where there is one group.
    unsigned                   n_coarse = 0; ///< of the parents of a patch
    std::vector<std::uint32_t> coarse;       ///< positions, entry [(batch * n_coarse + i) * n_lanes + lane]
    std::vector<std::uint32_t> row_start;
    std::vector<std::uint16_t> columns;
    std::vector<float>         weights;

    /// Or by rows: the unknowns that are coarse ones, and the others with their rows. Coarse unknowns by positions.
    std::vector<std::uint32_t> kept, kept_coarse, others; ///< positions, ascending
    SparseTransfer             in_places;                 ///< of the others; without row_start where there is none
  };
} // namespace unilateral
