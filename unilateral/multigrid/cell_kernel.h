// y_c += A_K x_c on the cells of several patches at once, a lane of a SIMD register for each.
#pragma once

#include "unilateral/multigrid/patch_shape.h"
#include "unilateral/multigrid/simd.h"

namespace unilateral
{
  /// What a patch has of x and of y = A x.
  template <typename Number>
  using PatchValues = typename Simd<Number>::Lanes[most_patch_dofs];

  /// All cells of the patches have the same @p matrix. N: unknowns of a cell, 0: given at run time.
  template <typename Number, unsigned N>
  void multiply_common(const PatchShape                   &shape,
                       const Number                       *matrix,
                       typename Simd<Number>::Lanes       *y_patch,
                       const typename Simd<Number>::Lanes *x_patch)
  {
    using Lanes = typename Simd<Number>::Lanes;
    const unsigned       n = N > 0 ? N : shape.n_cell_dofs;
    Lanes                x_cell[N > 0 ? N : most_patch_dofs];
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
  }

  /// Each lane has matrices of its own: their lower triangles row by row, the same entry of all patches of a batch side by side.
  template <typename Number, unsigned N>
  void multiply_own(const PatchShape                   &shape,
                    const Number                       *triangles,
                    typename Simd<Number>::Lanes       *y_patch,
                    const typename Simd<Number>::Lanes *x_patch)
  {
    using Lanes = typename Simd<Number>::Lanes;
    const unsigned       n = N > 0 ? N : shape.n_cell_dofs;
    Lanes                x_cell[N > 0 ? N : most_patch_dofs], y_cell[N > 0 ? N : most_patch_dofs];
    const std::uint16_t *dofs = shape.cell_dofs.data();
    const Number        *entry = triangles;
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
        for (unsigned j = 0; j < i; ++j, entry += CellOperator::n_lanes)
        {
          const Lanes a = Simd<Number>::load(entry);
          sum += a * x_cell[j];
          y_cell[j] += a * x_cell[i];
        }
        y_cell[i] += sum + Simd<Number>::load(entry) * x_cell[i];
        entry += CellOperator::n_lanes;
      }
      for (unsigned j = 0; j < n; ++j)
        y_patch[dofs[j]] += y_cell[j];
    }
  }

  template <typename Number>
  using CellKernel = void (*)(const PatchShape &, const Number *, typename Simd<Number>::Lanes *, const typename Simd<Number>::Lanes *);

  /// Unrolled for the cells that are most common.
  template <typename Number>
  CellKernel<Number> choose_kernel(const unsigned n, const bool common)
  {
    switch (n)
    {
    case 3:
      return common ? multiply_common<Number, 3> : multiply_own<Number, 3>;
    case 4:
      return common ? multiply_common<Number, 4> : multiply_own<Number, 4>;
    case 6:
      return common ? multiply_common<Number, 6> : multiply_own<Number, 6>;
    case 8:
      return common ? multiply_common<Number, 8> : multiply_own<Number, 8>;
    case 9:
      return common ? multiply_common<Number, 9> : multiply_own<Number, 9>;
    case 12:
      return common ? multiply_common<Number, 12> : multiply_own<Number, 12>;
    case 24:
      return common ? multiply_common<Number, 24> : multiply_own<Number, 24>;
    case 27:
      return common ? multiply_common<Number, 27> : multiply_own<Number, 27>;
    default:
      return common ? multiply_common<Number, 0> : multiply_own<Number, 0>;
    }
  }
} // namespace unilateral
