#include "unilateral/cell_operator.h"

#include "unilateral/simd.h"

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
                             std::vector<DenseBlock>                                  more_blocks,
                             std::vector<std::uint32_t>                               fixed)
    : n(n_dofs), n_patches(n_patches), shape(std::move(patch_shape)), blocks(std::move(more_blocks)), fixed_dofs(std::move(fixed))
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
    matrices_in_float.assign(matrices.begin(), matrices.end());
  }

  CellOperator::~CellOperator() = default;

  namespace
  {
    constexpr unsigned most_patch_dofs = CellOperator::most_patch_dofs;

    /// y_c += A_K x_c on the cells of 16 (float) or 8 (double) patches at once. N: unknowns of a cell, 0: given at run time.
    template <typename Number, unsigned N>
    void apply_to_patches(const CellOperator::PatchShape &shape,
                          const Number                   *matrix,
                          const std::uint32_t            *indices,
                          const unsigned                  n_lanes,
                          Number                         *y,
                          const Number                   *x)
    {
      using Lanes = typename Simd<Number>::Lanes;
      constexpr unsigned width = Simd<Number>::width;
      const unsigned     n = N > 0 ? N : shape.n_cell_dofs, n_patch = shape.n_patch_dofs;
      alignas(64) Lanes  x_patch[most_patch_dofs], y_patch[most_patch_dofs];
      Lanes              x_cell[N > 0 ? N : most_patch_dofs];
      for (unsigned first_lane = 0; first_lane < n_lanes; first_lane += width)
      {
        for (unsigned i = 0; i < n_patch; ++i)
        {
          x_patch[i] = Simd<Number>::gather(x, indices + i * n_lanes + first_lane);
          y_patch[i] = Lanes{};
        }
        const std::uint16_t *dofs = shape.cell_dofs.data();
        for (unsigned cell = 0; cell < shape.n_cells; ++cell, dofs += n)
        {
          for (unsigned j = 0; j < n; ++j)
            x_cell[j] = x_patch[dofs[j]];
          unsigned i = 0;
          for (; i + 4 <= n; i += 4)
          {
            const Number *row = matrix + std::size_t(i) * n;
            Lanes         sum0{}, sum1{}, sum2{}, sum3{};
#pragma GCC unroll 8
            for (unsigned j = 0; j < n; ++j)
            {
              sum0 += row[j] * x_cell[j];
              sum1 += row[n + j] * x_cell[j];
              sum2 += row[2 * n + j] * x_cell[j];
              sum3 += row[3 * n + j] * x_cell[j];
            }
            y_patch[dofs[i]] += sum0;
            y_patch[dofs[i + 1]] += sum1;
            y_patch[dofs[i + 2]] += sum2;
            y_patch[dofs[i + 3]] += sum3;
          }
          for (; i < n; ++i)
          {
            const Number *row = matrix + std::size_t(i) * n;
            Lanes         sum{};
            for (unsigned j = 0; j < n; ++j)
              sum += row[j] * x_cell[j];
            y_patch[dofs[i]] += sum;
          }
        }
        // Patches share unknowns: no two lanes may be added at the same time.
        for (unsigned i = 0; i < n_patch; ++i)
        {
          const std::uint32_t *const index = indices + i * n_lanes + first_lane;
          const Number *const        values = reinterpret_cast<const Number *>(&y_patch[i]);
          for (unsigned l = 0; l < width; ++l)
            y[index[l]] += values[l];
        }
      }
    }

    /// The same with a matrix of its own in each lane, its lower triangle row by row.
    template <typename Number, unsigned N>
    void apply_own_to_patches(const CellOperator::PatchShape &shape,
                              const Number                   *triangles,
                              const std::uint32_t            *indices,
                              const unsigned                  n_lanes,
                              Number                         *y,
                              const Number                   *x)
    {
      using Lanes = typename Simd<Number>::Lanes;
      constexpr unsigned width = Simd<Number>::width;
      const unsigned     n = N > 0 ? N : shape.n_cell_dofs, n_patch = shape.n_patch_dofs;
      alignas(64) Lanes  x_patch[most_patch_dofs], y_patch[most_patch_dofs];
      Lanes              x_cell[N > 0 ? N : most_patch_dofs], y_cell[N > 0 ? N : most_patch_dofs];
      for (unsigned first_lane = 0; first_lane < n_lanes; first_lane += width)
      {
        for (unsigned i = 0; i < n_patch; ++i)
        {
          x_patch[i] = Simd<Number>::gather(x, indices + i * n_lanes + first_lane);
          y_patch[i] = Lanes{};
        }
        const std::uint16_t *dofs = shape.cell_dofs.data();
        const Number        *entry = triangles + first_lane;
        for (unsigned cell = 0; cell < shape.n_cells; ++cell, dofs += n)
        {
          for (unsigned j = 0; j < n; ++j)
          {
            x_cell[j] = x_patch[dofs[j]];
            y_cell[j] = Lanes{};
          }
          for (unsigned i = 0; i < n; ++i)
          {
            Lanes sum{};
            for (unsigned j = 0; j < i; ++j, entry += n_lanes)
            {
              const Lanes a = Simd<Number>::load(entry);
              sum += a * x_cell[j];
              y_cell[j] += a * x_cell[i];
            }
            y_cell[i] += sum + Simd<Number>::load(entry) * x_cell[i];
            entry += n_lanes;
          }
          for (unsigned j = 0; j < n; ++j)
            y_patch[dofs[j]] += y_cell[j];
        }
        for (unsigned i = 0; i < n_patch; ++i)
        {
          const std::uint32_t *const index = indices + i * n_lanes + first_lane;
          const Number *const        values = reinterpret_cast<const Number *>(&y_patch[i]);
          for (unsigned l = 0; l < width; ++l)
            y[index[l]] += values[l];
        }
      }
    }

    template <typename Number>
    using Kernel = void (*)(const CellOperator::PatchShape &, const Number *, const std::uint32_t *, unsigned, Number *, const Number *);

    template <typename Number, unsigned N>
    Kernel<Number> kernel(const bool common)
    {
      return common ? Kernel<Number>(apply_to_patches<Number, N>) : Kernel<Number>(apply_own_to_patches<Number, N>);
    }

    /// Unrolled for the cells that are most common.
    template <typename Number>
    Kernel<Number> choose_kernel(const unsigned n, const bool common)
    {
      switch (n)
      {
      case 4:
        return kernel<Number, 4>(common);
      case 8:
        return kernel<Number, 8>(common);
      case 9:
        return kernel<Number, 9>(common);
      case 24:
        return kernel<Number, 24>(common);
      case 27:
        return kernel<Number, 27>(common);
      default:
        return kernel<Number, 0>(common);
      }
    }
  } // namespace

  template <typename Number>
  void CellOperator::apply(Number *y, const Number *x) const
  {
    std::fill(y, y + n, Number(0));
    const Number *all_matrices;
    if constexpr (std::is_same_v<Number, double>)
      all_matrices = matrices.data();
    else
      all_matrices = matrices_in_float.data();
    const auto common_kernel = choose_kernel<Number>(shape.n_cell_dofs, true), own_kernel = choose_kernel<Number>(shape.n_cell_dofs, false);
    for (std::size_t batch = 0; batch < matrices_of_batch.size(); ++batch)
    {
      const auto &[common, offset] = matrices_of_batch[batch];
      (common ? common_kernel : own_kernel)(shape, all_matrices + offset, indices.data() + batch * shape.n_patch_dofs * n_lanes, n_lanes, y,
                                            x);
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

  void CellOperator::vmult(double *y, const double *x) const
  {
    apply(y, x);
  }

  void CellOperator::vmult(float *y, const float *x) const
  {
    apply(y, x);
  }

  std::vector<double> CellOperator::diagonal() const
  {
    std::vector<double> diagonal(n, 0.);
    const unsigned      n_local = shape.n_cell_dofs;
    for (std::size_t cell = 0; cell < n_cells(); ++cell)
    {
      const auto &[common, offset] = matrices_of_batch[cell / shape.n_cells / n_lanes];
      for (unsigned i = 0; i < n_local; ++i)
        diagonal[dof(cell / shape.n_cells, shape.cell_dofs[cell % shape.n_cells * n_local + i])] +=
          common ? matrices[offset + i * (n_local + 1)] : matrices[triangle_entry(cell, offset, i, i)];
    }
    for (const auto &block : blocks)
      for (std::size_t i = 0; i < block.dofs.size(); ++i)
        diagonal[block.dofs[i]] += block.matrix[i * (block.dofs.size() + 1)];
    for (const auto dof : fixed_dofs)
      diagonal[dof] = 1;
    return diagonal;
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

  void CellOperator::cell_matrix(const std::size_t cell, double *const matrix) const
  {
    const unsigned n_local = shape.n_cell_dofs;
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

  std::size_t CellOperator::memory() const
  {
    return indices.capacity() * sizeof(indices[0]) + matrices_of_batch.capacity() * sizeof(BatchMatrices) +
           matrices.capacity() * (sizeof(double) + sizeof(float));
  }
} // namespace unilateral
