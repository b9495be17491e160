// y = A x, cell by cell: small dense matrices, SIMD across cells.
#pragma once

#include "unilateral/base/shared_unknowns.h"
#include "unilateral/multigrid/dependence.h"
#include "unilateral/multigrid/patch_shape.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace unilateral
{
  /// A cell of which some unknowns depend on others: those at hanging nodes, or a component on a plane of symmetry that slopes.
  struct DependentCell
  {
    std::uint32_t       cell;
    Dependence          dependence; ///< of its unknowns; masters may belong to neighbours
    std::vector<double> matrix;     ///< A_K on the unknowns of the cell, n_cell_dofs^2 numbers
  };

  /// A = sum over cells of P_K' A_K P_K, P_K picking the unknowns of cell K, plus some further blocks.
  ///
  /// Neighbouring cells come in patches, the 2^(dim k) descendants of one cell, whose unknowns are gathered and scattered once; 16 patches
  /// are worked on together, a lane of a SIMD register for each. Where all their cells have one and the same A_K it is stored once; else
  /// (distorted cells, variable coefficients) the lower triangle of each, the same entry of the 16 side by side.
  ///
  /// Unknowns that Dirichlet data fix couple with nothing: x is expected to vanish there, y does.
  class CellOperator
  {
  public:
    using PatchShape = unilateral::PatchShape;
    static constexpr unsigned most_patch_dofs = unilateral::most_patch_dofs;

    /// @p patch_dofs(p, dofs) writes the n_patch_dofs unknowns of patch p. @p matrix_of_cell: an entry of @p matrices for each cell,
    /// patch after patch; negative: none. @p matrices: n_cell_dofs^2 numbers each, row by row, symmetric. @p dependent_cells: of those
    /// without a matrix, in ascending order.
    CellOperator(std::size_t                                              n_dofs,
                 std::size_t                                              n_patches,
                 PatchShape                                               shape,
                 const std::function<void(std::size_t, std::uint32_t *)> &patch_dofs,
                 const std::vector<std::int32_t>                         &matrix_of_cell,
                 const std::vector<double>                               &matrices,
                 std::vector<DependentCell>                               dependent_cells,
                 std::vector<DenseBlock>                                  blocks,
                 std::vector<std::uint32_t>                               fixed_dofs);
    ~CellOperator();

    std::size_t n_dofs() const { return n; }
    std::size_t n_cells() const { return n_patches * shape.n_cells; }
    unsigned    n_cell_dofs() const { return shape.n_cell_dofs; }

    void vmult(double *y, const double *x) const; ///< y = A x

    /// Adds to the diagonal what the cells of other processes have there.
    void complete_diagonal(const SharedUnknowns &shared);

    /// The diagonal of A; 1 where unknowns are fixed.
    const std::vector<double> &diagonal() const { return a_ii; }

    /// The unknowns of a cell, n_cell_dofs() of them.
    void cell_dofs(std::size_t cell, std::uint32_t *dofs) const;

    /// A_K, n_cell_dofs^2 numbers, that of a dependent cell on its own unknowns.
    void cell_matrix(std::size_t cell, double *matrix) const;

    /// What a cell adds to A if its matrix is @p M: that, or C'MC for a dependent one.
    DenseBlock contribution(std::size_t cell, const double *M) const;

    /// nullptr: the cell's unknowns are its own.
    const DependentCell              *dependent(std::size_t cell) const;
    const std::vector<DependentCell> &all_dependent() const { return dependent_cells; }

    /// Which cells to look at to have seen all different matrices, or, of very many, a sample.
    std::vector<std::size_t> representative_cells(std::size_t most) const;

    /// For each cell: the bits of all its unknowns.
    void collect_flags(const unsigned char *flags, unsigned char *cell_flags) const;

    const std::vector<std::uint32_t> &fixed() const { return fixed_dofs; }
    /// Those of dependent cells, condensed, and what lies outside the cells.
    const std::vector<DenseBlock> &further_blocks() const { return blocks; }

    std::size_t memory() const; ///< bytes

    /// How the matrices lie in memory: 16 patches make a batch.
    static constexpr unsigned n_lanes = 16;
    /// Where a batch finds its matrices: a common one, or the lower triangles [cell of the patch][entry][lane].
    struct BatchMatrices
    {
      bool        common;
      std::size_t offset;
    };
    const PatchShape                 &patch_shape() const { return shape; }
    std::size_t                       number_of_patches() const { return n_patches; }
    const std::vector<BatchMatrices> &batches() const { return matrices_of_batch; }
    const std::vector<double>        &all_matrices() const { return matrices; }

    /// Unknown @p i of a patch.
    std::uint32_t dof(const std::size_t patch, const unsigned i) const
    {
      return indices[(patch / n_lanes * shape.n_patch_dofs + i) * n_lanes + patch % n_lanes];
    }

  private:
    void compute_diagonal();

    /// Where the lower triangle of a cell has row i, column j.
    std::size_t triangle_entry(std::size_t cell, std::size_t offset, unsigned i, unsigned j) const;

    std::size_t                n, n_patches;
    PatchShape                 shape;
    std::vector<std::uint32_t> indices; ///< [batch][unknown of the patch][lane]
    std::vector<BatchMatrices> matrices_of_batch;
    std::vector<double>        matrices; ///< common ones in full, and triangles
    std::vector<double>        a_ii;     ///< the diagonal
    std::vector<DependentCell> dependent_cells;
    std::vector<DenseBlock>    blocks;
    std::vector<std::uint32_t> fixed_dofs;
  };
} // namespace unilateral
