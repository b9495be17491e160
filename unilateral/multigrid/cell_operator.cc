#include "unilateral/multigrid/cell_operator.h"

#include "unilateral/multigrid/cell_kernel.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace unilateral
{
  CellOperator::CellOperator(const std::size_t                                        n_dofs,
                             const std::size_t                                        n_patches,
                             PatchShape                                               patch_shape,
                             const std::function<void(std::size_t, std::uint32_t *)> &patch_dofs,
                             const std::vector<std::int32_t>                         &matrix_of_cell,
                             const std::vector<double>                               &all_matrices,
                             std::vector<DependentCell>                               dependent,
                             std::vector<DenseBlock>                                  more_blocks,
                             std::vector<std::uint32_t>                               fixed)
    : n(n_dofs), n_patches(n_patches), shape(std::move(patch_shape)), dependent_cells(std::move(dependent)), blocks(std::move(more_blocks)),
      fixed_dofs(std::move(fixed))
  {
    if (shape.n_patch_dofs > most_patch_dofs)
      throw std::logic_error("a patch has more unknowns than the kernels have room for");
    const std::size_t n_batches = (n_patches + n_lanes - 1) / n_lanes, n_local = shape.n_cell_dofs;
    indices.assign(n_batches * shape.n_patch_dofs * n_lanes, 0);
    std::vector<std::uint32_t> dofs(shape.n_patch_dofs);
    for (std::size_t p = 0; p < n_patches; ++p)
    {
      patch_dofs(p, dofs.data());
      for (unsigned i = 0; i < shape.n_patch_dofs; ++i)
        indices[(p / n_lanes * shape.n_patch_dofs + i) * n_lanes + p % n_lanes] = dofs[i];
    }
    std::map<std::int32_t, std::size_t> common_matrices; // id -> offset
    for (std::size_t batch = 0; batch < n_batches; ++batch)
    {
      const std::size_t begin = batch * n_lanes * shape.n_cells, end = std::min((batch + 1) * n_lanes, n_patches) * shape.n_cells;
      const auto        first = matrix_of_cell[begin];
      const bool        common =
        first >= 0 && (batch + 1) * n_lanes <= n_patches &&
        std::all_of(matrix_of_cell.begin() + begin, matrix_of_cell.begin() + end, [&](const auto id) { return id == first; });
      if (common)
      {
        const auto [entry, is_new] = common_matrices.try_emplace(first, matrices.size());
        if (is_new)
          matrices.insert(matrices.end(), all_matrices.begin() + first * n_local * n_local,
                          all_matrices.begin() + (first + 1) * n_local * n_local);
        matrices_of_batch.push_back({true, entry->second});
        continue;
      }
      const std::size_t offset = matrices.size(), triangle = n_local * (n_local + 1) / 2;
      matrices.resize(offset + shape.n_cells * triangle * n_lanes, 0.);
      matrices_of_batch.push_back({false, offset});
      for (std::size_t cell = begin; cell < end; ++cell)
        if (matrix_of_cell[cell] >= 0)
        {
          const double *const matrix = all_matrices.data() + matrix_of_cell[cell] * n_local * n_local;
          const std::size_t   lane = (cell - begin) / shape.n_cells, in_patch = (cell - begin) % shape.n_cells;
          double             *entry = matrices.data() + offset + in_patch * triangle * n_lanes + lane;
          for (unsigned i = 0; i < n_local; ++i)
            for (unsigned j = 0; j <= i; ++j, entry += n_lanes)
              *entry = matrix[i * n_local + j];
        }
    }
    matrices.shrink_to_fit();
    for (const auto &cell : dependent_cells)
      blocks.push_back(cell.dependence.condense(cell.matrix.data()));
    compute_diagonal();
  }

  CellOperator::~CellOperator() = default;

  void CellOperator::vmult(double *y, const double *x) const
  {
    using Lanes = Simd<double>::Lanes;
    constexpr unsigned width = Simd<double>::width;
    std::fill(y, y + n, 0.);
    const unsigned n_patch = shape.n_patch_dofs;
    const auto common_kernel = choose_kernel<double>(shape.n_cell_dofs, true), own_kernel = choose_kernel<double>(shape.n_cell_dofs, false);
    alignas(64) PatchValues<double> x_patch, y_patch;
    for (std::size_t batch = 0; batch < matrices_of_batch.size(); ++batch)
      for (unsigned first_lane = 0; first_lane < n_lanes; first_lane += width)
      {
        const std::uint32_t *const batch_indices = indices.data() + batch * n_patch * n_lanes + first_lane;
        for (unsigned i = 0; i < n_patch; ++i)
        {
          x_patch[i] = Simd<double>::gather(x, batch_indices + i * n_lanes);
          y_patch[i] = Lanes{};
        }
        const auto &[common, offset] = matrices_of_batch[batch];
        (common ? common_kernel : own_kernel)(shape, matrices.data() + offset + (common ? 0 : first_lane), y_patch, x_patch);
        // Patches share unknowns: no two lanes may be added at the same time.
        for (unsigned i = 0; i < n_patch; ++i)
          for (unsigned l = 0; l < width; ++l)
            y[batch_indices[i * n_lanes + l]] += y_patch[i][l];
      }
    for (const auto &block : blocks)
      for (std::size_t i = 0, k = 0; i < block.dofs.size(); ++i)
      {
        double sum = 0;
        for (const auto dof : block.dofs)
          sum += block.matrix[k++] * x[dof];
        y[block.dofs[i]] += sum;
      }
    for (const auto dof : fixed_dofs)
      y[dof] = 0;
  }

  void CellOperator::complete_diagonal(const SharedUnknowns &shared)
  {
    shared.add(a_ii.data());
    for (const auto dof : fixed_dofs)
      a_ii[dof] = 1;
  }

  void CellOperator::compute_diagonal()
  {
    a_ii.assign(n, 0.);
    const unsigned n_local = shape.n_cell_dofs;
    for (std::size_t cell = 0; cell < n_cells(); ++cell)
    {
      const auto &[common, offset] = matrices_of_batch[cell / shape.n_cells / n_lanes];
      for (unsigned i = 0; i < n_local; ++i)
        a_ii[dof(cell / shape.n_cells, shape.cell_dofs[cell % shape.n_cells * n_local + i])] +=
          common ? matrices[offset + i * (n_local + 1)] : matrices[triangle_entry(cell, offset, i, i)];
    }
    for (const auto &block : blocks)
      for (std::size_t i = 0; i < block.dofs.size(); ++i)
        a_ii[block.dofs[i]] += block.matrix[i * (block.dofs.size() + 1)];
    for (const auto dof : fixed_dofs)
      a_ii[dof] = 1;
  }

  void CellOperator::cell_dofs(const std::size_t cell, std::uint32_t *dofs) const
  {
    const std::uint16_t *const in_patch = shape.cell_dofs.data() + cell % shape.n_cells * shape.n_cell_dofs;
    for (unsigned i = 0; i < shape.n_cell_dofs; ++i)
      dofs[i] = dof(cell / shape.n_cells, in_patch[i]);
  }

  std::size_t CellOperator::triangle_entry(const std::size_t cell, const std::size_t offset, const unsigned i, const unsigned j) const
  {
    const std::size_t n_local = shape.n_cell_dofs, triangle = n_local * (n_local + 1) / 2;
    return offset + (cell % shape.n_cells * triangle + i * (i + 1) / 2 + j) * n_lanes + cell / shape.n_cells % n_lanes;
  }

  const DependentCell *CellOperator::dependent(const std::size_t cell) const
  {
    const auto found = std::lower_bound(dependent_cells.begin(), dependent_cells.end(), cell,
                                        [](const DependentCell &a, const std::size_t b) { return a.cell < b; });
    return found != dependent_cells.end() && found->cell == cell ? &*found : nullptr;
  }

  DenseBlock CellOperator::contribution(const std::size_t cell, const double *const M) const
  {
    if (const DependentCell *const special = dependent(cell))
      return special->dependence.condense(M);
    const unsigned n_local = shape.n_cell_dofs;
    DenseBlock     block{std::vector<std::uint32_t>(n_local), std::vector<double>(M, M + n_local * n_local)};
    cell_dofs(cell, block.dofs.data());
    return block;
  }

  void CellOperator::cell_matrix(const std::size_t cell, double *const matrix) const
  {
    const unsigned n_local = shape.n_cell_dofs;
    if (const DependentCell *const special = dependent(cell))
    {
      std::copy(special->matrix.begin(), special->matrix.end(), matrix);
      return;
    }
    const auto &[common, offset] = matrices_of_batch[cell / shape.n_cells / n_lanes];
    if (common)
      std::copy_n(matrices.begin() + offset, n_local * n_local, matrix);
    else
      for (unsigned i = 0; i < n_local; ++i)
        for (unsigned j = 0; j <= i; ++j)
          matrix[i * n_local + j] = matrix[j * n_local + i] = matrices[triangle_entry(cell, offset, i, j)];
  }

  std::vector<std::size_t> CellOperator::representative_cells(const std::size_t most) const
  {
    std::vector<std::size_t> cells;
    std::set<std::size_t>    seen;
    for (std::size_t batch = 0; batch < matrices_of_batch.size(); ++batch)
    {
      const std::size_t begin = batch * n_lanes * shape.n_cells, end = std::min((batch + 1) * n_lanes, n_patches) * shape.n_cells;
      const auto &[common, offset] = matrices_of_batch[batch];
      if (!common)
        for (std::size_t cell = begin; cell < end; ++cell)
          cells.push_back(cell);
      else if (seen.insert(offset).second)
        cells.push_back(begin);
    }
    if (cells.size() > most)
    {
      const std::size_t stride = cells.size() / most + 1;
      for (std::size_t k = 0; k * stride < cells.size(); ++k)
        cells[k] = cells[k * stride];
      cells.resize((cells.size() - 1) / stride + 1);
    }
    return cells;
  }

  void CellOperator::collect_flags(const unsigned char *const flags, unsigned char *const cell_flags) const
  {
    typedef unsigned char Bytes __attribute__((vector_size(n_lanes), may_alias));
    const unsigned        n_patch = shape.n_patch_dofs, n_local = shape.n_cell_dofs;
    std::vector<Bytes>    of_patch(n_patch);
    for (std::size_t batch = 0; batch < matrices_of_batch.size(); ++batch)
    {
      const std::uint32_t *const batch_indices = indices.data() + batch * n_patch * n_lanes;
      for (unsigned i = 0; i < n_patch; ++i)
      {
        for (unsigned l = 0; l < n_lanes; ++l)
          of_patch[i][l] = flags[batch_indices[i * n_lanes + l]];
      }
      const std::size_t    begin = batch * n_lanes * shape.n_cells, end = std::min((batch + 1) * n_lanes, n_patches) * shape.n_cells;
      const std::uint16_t *dofs = shape.cell_dofs.data();
      for (unsigned cell = 0; cell < shape.n_cells; ++cell, dofs += n_local)
      {
        Bytes of_cell{};
        for (unsigned i = 0; i < n_local; ++i)
          of_cell |= of_patch[dofs[i]];
        for (std::size_t l = 0, k = begin + cell; k < end; ++l, k += shape.n_cells)
          cell_flags[k] = of_cell[l];
      }
    }
  }

  std::size_t CellOperator::memory() const
  {
    return indices.capacity() * sizeof(indices[0]) + matrices_of_batch.capacity() * sizeof(BatchMatrices) +
           (matrices.capacity() + a_ii.capacity()) * sizeof(double);
  }
} // namespace unilateral
