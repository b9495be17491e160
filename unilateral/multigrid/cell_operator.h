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
  /// (distorted cells, variable coefficients) the lower triangle of each, the same entry of the 16 side by side. Meshes that are refined in
  /// places have groups of patches with different k.
  ///
  /// Unknowns that Dirichlet data fix couple with nothing: x is expected to vanish there, y does.
  class CellOperator
  {
  public:
    using PatchShape = unilateral::PatchShape;
    static constexpr unsigned most_patch_dofs = unilateral::most_patch_dofs;

    /// So many patches of one shape.
    struct PatchGroup
    {
      PatchShape  shape;
      std::size_t n_patches;
    };

    /// @p patch_dofs(p, dofs) writes the n_patch_dofs unknowns of patch p, counted through all groups. @p matrix_of_cell: an entry of
    /// @p matrices for each cell, patch after patch; negative: none. @p matrices: n_cell_dofs^2 numbers each, row by row, symmetric.
    /// @p dependent_cells: of those without a matrix, in ascending order.
    CellOperator(std::size_t                                              n_dofs,
                 std::vector<PatchGroup>                                  groups,
                 const std::function<void(std::size_t, std::uint32_t *)> &patch_dofs,
                 const std::vector<std::int32_t>                         &matrix_of_cell,
                 const std::vector<double>                               &matrices,
                 std::vector<DependentCell>                               dependent_cells,
                 std::vector<DenseBlock>                                  blocks,
                 std::vector<std::uint32_t>                               fixed_dofs);
    ~CellOperator();

    std::size_t n_dofs() const { return n; }
    std::size_t n_cells() const { return cells_end; }
    unsigned    n_cell_dofs() const { return groups.front().shape.n_cell_dofs; }

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

    /// 16 patches of one group, or what is left of them.
    static constexpr unsigned n_lanes = 16;
    struct Batch
    {
      unsigned    group, n_patches;
      std::size_t first_patch, first_cell;
      std::size_t indices; ///< where its unknowns begin: [unknown of the patch][lane]
      bool        common;  ///< all cells have one matrix
      std::size_t offset;  ///< of the matrix, or of the lower triangles [cell of the patch][entry][lane]
    };
    const std::vector<PatchGroup> &patch_groups() const { return groups; }
    const std::vector<Batch>      &batches() const { return all_batches; }
    const std::vector<double>     &all_matrices() const { return matrices; }
    const PatchShape              &shape_of(const Batch &batch) const { return groups[batch.group].shape; }

    /// Unknown @p i of a patch.
    std::uint32_t dof(const Batch &batch, const unsigned lane, const unsigned i) const
    {
      return indices[batch.indices + i * n_lanes + lane];
    }

  private:
    void take_patches(const std::function<void(std::size_t, std::uint32_t *)> &patch_dofs);
    void take_matrices(const std::vector<std::int32_t> &matrix_of_cell, const std::vector<double> &all_matrices);
    void compute_diagonal();

    struct Place
    {
      const Batch &batch;
      unsigned     lane, in_patch;
    };
    Place place_of(std::size_t cell) const;

    /// Where the lower triangle of a cell has row i, column j.
    std::size_t triangle_entry(const Place &place, unsigned i, unsigned j) const;

    std::size_t                n, cells_end = 0;
    std::vector<PatchGroup>    groups;
    std::vector<std::size_t>   first_batch; ///< of each group
    std::vector<std::uint32_t> indices;
    std::vector<Batch>         all_batches;
    std::vector<double>        matrices; ///< common ones in full, and triangles
    std::vector<double>        a_ii;     ///< the diagonal
    std::vector<DependentCell> dependent_cells;
    std::vector<DenseBlock>    blocks;
    std::vector<std::uint32_t> fixed_dofs;
  };
} // namespace unilateral
