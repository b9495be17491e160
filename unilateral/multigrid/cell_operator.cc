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
                             std::vector<PatchGroup>                                  patch_groups,
                             const std::function<void(std::size_t, std::uint32_t *)> &patch_dofs,
                             const std::vector<std::int32_t>                         &matrix_of_cell,
                             const std::vector<double>                               &all_matrices,
                             std::vector<DependentCell>                               dependent,
                             std::vector<DenseBlock>                                  more_blocks,
                             std::vector<std::uint32_t>                               fixed)
    : n(n_dofs), groups(std::move(patch_groups)), dependent_cells(std::move(dependent)), blocks(std::move(more_blocks)),
      fixed_dofs(std::move(fixed))
  {
    take_patches(patch_dofs);
    take_matrices(matrix_of_cell, all_matrices);
    for (const auto &cell : dependent_cells)
      blocks.push_back(cell.dependence.condense(cell.matrix.data()));
    compute_diagonal();
  }

  void CellOperator::take_patches(const std::function<void(std::size_t, std::uint32_t *)> &patch_dofs)
  {
    std::size_t n_indices = 0, next_patch = 0;
    for (unsigned g = 0; g < groups.size(); ++g)
    {
      const auto &[shape, n_patches] = groups[g];
      if (shape.n_patch_dofs > most_patch_dofs)
        throw std::logic_error("a patch has more unknowns than the kernels have room for");
      first_batch.push_back(all_batches.size());
      for (std::size_t done = 0; done < n_patches; done += n_lanes)
      {
        const unsigned n_here = std::min<std::size_t>(n_lanes, n_patches - done);
        all_batches.push_back({g, n_here, next_patch, cells_end, n_indices, false, 0});
        next_patch += n_here;
        cells_end += std::size_t(n_here) * shape.n_cells;
        n_indices += std::size_t(shape.n_patch_dofs) * n_lanes;
      }
    }
    indices.assign(n_indices, 0);
    std::vector<std::uint32_t> dofs;
    for (const Batch &batch : all_batches)
    {
      dofs.resize(shape_of(batch).n_patch_dofs);
      for (unsigned lane = 0; lane < batch.n_patches; ++lane)
      {
        patch_dofs(batch.first_patch + lane, dofs.data());
        for (unsigned i = 0; i < dofs.size(); ++i)
          indices[batch.indices + i * n_lanes + lane] = dofs[i];
      }
    }
  }

  void CellOperator::take_matrices(const std::vector<std::int32_t> &matrix_of_cell, const std::vector<double> &all_matrices)
  {
    const std::size_t                   n_local = n_cell_dofs(), triangle = n_local * (n_local + 1) / 2;
    std::map<std::int32_t, std::size_t> common_matrices; // id -> offset
    for (Batch &batch : all_batches)
    {
      const unsigned    n_cells = shape_of(batch).n_cells;
      const std::size_t begin = batch.first_cell, end = begin + std::size_t(batch.n_patches) * n_cells;
      const auto        first = matrix_of_cell[begin];
      batch.common = first >= 0 && batch.n_patches == n_lanes &&
                     std::all_of(matrix_of_cell.begin() + begin, matrix_of_cell.begin() + end, [&](const auto id) { return id == first; });
      if (batch.common)
      {
        const auto [entry, is_new] = common_matrices.try_emplace(first, matrices.size());
        if (is_new)
          matrices.insert(matrices.end(), all_matrices.begin() + first * n_local * n_local,
                          all_matrices.begin() + (first + 1) * n_local * n_local);
        batch.offset = entry->second;
        continue;
      }
      batch.offset = matrices.size();
      matrices.resize(batch.offset + n_cells * triangle * n_lanes, 0.);
      for (std::size_t cell = begin; cell < end; ++cell)
        if (matrix_of_cell[cell] >= 0)
        {
          const double *const matrix = all_matrices.data() + matrix_of_cell[cell] * n_local * n_local;
          const std::size_t   lane = (cell - begin) / n_cells, in_patch = (cell - begin) % n_cells;
          double             *entry = matrices.data() + batch.offset + in_patch * triangle * n_lanes + lane;
          for (unsigned i = 0; i < n_local; ++i)
            for (unsigned j = 0; j <= i; ++j, entry += n_lanes)
              *entry = matrix[i * n_local + j];
        }
    }
    matrices.shrink_to_fit();
  }

  CellOperator::~CellOperator() = default;

  void CellOperator::vmult(double *y, const double *x) const
  {
    using Lanes = Simd<double>::Lanes;
    constexpr unsigned width = Simd<double>::width;
    std::fill(y, y + n, 0.);
    const auto common_kernel = choose_kernel<double>(n_cell_dofs(), true), own_kernel = choose_kernel<double>(n_cell_dofs(), false);
    alignas(64) PatchValues<double> x_patch, y_patch;
    for (const Batch &batch : all_batches)
      for (unsigned first_lane = 0; first_lane < batch.n_patches; first_lane += width)
      {
        const PatchShape          &shape = shape_of(batch);
        const unsigned             n_patch = shape.n_patch_dofs;
        const std::uint32_t *const batch_indices = indices.data() + batch.indices + first_lane;
        for (unsigned i = 0; i < n_patch; ++i)
        {
          x_patch[i] = Simd<double>::gather(x, batch_indices + i * n_lanes);
          y_patch[i] = Lanes{};
        }
        (batch.common ? common_kernel : own_kernel)(shape, matrices.data() + batch.offset + (batch.common ? 0 : first_lane), y_patch,
                                                    x_patch);
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
    const unsigned n_local = n_cell_dofs();
    for (const Batch &batch : all_batches)
    {
      const PatchShape &shape = shape_of(batch);
      for (unsigned lane = 0; lane < batch.n_patches; ++lane)
        for (unsigned cell = 0; cell < shape.n_cells; ++cell)
          for (unsigned i = 0; i < n_local; ++i)
            a_ii[dof(batch, lane, shape.cell_dofs[cell * n_local + i])] +=
              batch.common ? matrices[batch.offset + i * (n_local + 1)] : matrices[triangle_entry({batch, lane, cell}, i, i)];
    }
    for (const auto &block : blocks)
      for (std::size_t i = 0; i < block.dofs.size(); ++i)
        a_ii[block.dofs[i]] += block.matrix[i * (block.dofs.size() + 1)];
    for (const auto dof : fixed_dofs)
      a_ii[dof] = 1;
  }

  CellOperator::Place CellOperator::place_of(const std::size_t cell) const
  {
    unsigned group = groups.size() - 1;
    while (group > 0 && (first_batch[group] == all_batches.size() || cell < all_batches[first_batch[group]].first_cell))
      --group;
    const unsigned    n_cells = groups[group].shape.n_cells;
    const std::size_t patch = (cell - all_batches[first_batch[group]].first_cell) / n_cells;
    const Batch      &batch = all_batches[first_batch[group] + patch / n_lanes];
    return {batch, unsigned(patch % n_lanes), unsigned((cell - batch.first_cell) % n_cells)};
  }

  void CellOperator::cell_dofs(const std::size_t cell, std::uint32_t *dofs) const
  {
    const auto [batch, lane, in_patch] = place_of(cell);
    const PatchShape          &shape = shape_of(batch);
    const std::uint16_t *const numbers = shape.cell_dofs.data() + in_patch * shape.n_cell_dofs;
    for (unsigned i = 0; i < shape.n_cell_dofs; ++i)
      dofs[i] = dof(batch, lane, numbers[i]);
  }

  std::size_t CellOperator::triangle_entry(const Place &place, const unsigned i, const unsigned j) const
  {
    const std::size_t n_local = n_cell_dofs(), triangle = n_local * (n_local + 1) / 2;
    return place.batch.offset + (place.in_patch * triangle + i * (i + 1) / 2 + j) * n_lanes + place.lane;
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
    const unsigned n_local = n_cell_dofs();
    DenseBlock     block{std::vector<std::uint32_t>(n_local), std::vector<double>(M, M + n_local * n_local)};
    cell_dofs(cell, block.dofs.data());
    return block;
  }

  void CellOperator::cell_matrix(const std::size_t cell, double *const matrix) const
  {
    const unsigned n_local = n_cell_dofs();
    if (const DependentCell *const special = dependent(cell))
    {
      std::copy(special->matrix.begin(), special->matrix.end(), matrix);
      return;
    }
    const Place place = place_of(cell);
    if (place.batch.common)
      std::copy_n(matrices.begin() + place.batch.offset, n_local * n_local, matrix);
    else
      for (unsigned i = 0; i < n_local; ++i)
        for (unsigned j = 0; j <= i; ++j)
          matrix[i * n_local + j] = matrix[j * n_local + i] = matrices[triangle_entry(place, i, j)];
  }

  std::vector<std::size_t> CellOperator::representative_cells(const std::size_t most) const
  {
    std::vector<std::size_t> cells;
    std::set<std::size_t>    seen;
    for (const Batch &batch : all_batches)
      if (!batch.common)
        for (std::size_t k = 0; k < std::size_t(batch.n_patches) * shape_of(batch).n_cells; ++k)
          cells.push_back(batch.first_cell + k);
      else if (seen.insert(batch.offset).second)
        cells.push_back(batch.first_cell);
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
    const unsigned        n_local = n_cell_dofs();
    std::vector<Bytes>    of_patch;
    for (const Batch &batch : all_batches)
    {
      const PatchShape          &shape = shape_of(batch);
      const unsigned             n_patch = shape.n_patch_dofs;
      const std::uint32_t *const batch_indices = indices.data() + batch.indices;
      of_patch.resize(n_patch);
      for (unsigned i = 0; i < n_patch; ++i)
      {
        for (unsigned l = 0; l < n_lanes; ++l)
          of_patch[i][l] = flags[batch_indices[i * n_lanes + l]];
      }
      const std::size_t    begin = batch.first_cell, end = begin + std::size_t(batch.n_patches) * shape.n_cells;
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
    return indices.capacity() * sizeof(indices[0]) + all_batches.capacity() * sizeof(Batch) +
           (matrices.capacity() + a_ii.capacity()) * sizeof(double);
  }
} // namespace unilateral
