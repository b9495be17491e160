// An operator on a row of cells with random matrices, and the same sum over the cells written out.
#pragma once

#include "unilateral/multigrid/cell_operator.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <random>
#include <vector>

namespace unilateral
{
  /// A chain of cells of n unknowns, two to a patch, that share one with the next. 35 patches: the first 16 have one matrix in common, the
  /// next 16 several, three are left over. In two cells the last unknown lies between its neighbour and one of the first cells.
  struct ChainOfCells
  {
    using Numbers = std::vector<double>;
    static constexpr unsigned n_patches = 35, n_cells = 2 * n_patches;

    explicit ChainOfCells(const unsigned n) : n(n), n_dofs(n_cells * (n - 1) + 1), number(n_dofs)
    {
      std::iota(number.begin(), number.end(), 0);
      std::shuffle(number.begin(), number.end(), generator);
      const Numbers kinds[3] = {symmetric_matrix(), symmetric_matrix(), symmetric_matrix()};
      Numbers       all;
      for (const auto &kind : kinds)
        all.insert(all.end(), kind.begin(), kind.end());

      std::vector<std::int32_t>  id(n_cells);
      std::vector<DependentCell> dependent;
      for (unsigned cell = 0; cell < n_cells; ++cell)
      {
        dofs.emplace_back(number.begin() + cell * (n - 1), number.begin() + cell * (n - 1) + n);
        id[cell] = cell < 32 ? 1 : cell % 3;
        matrix.push_back(kinds[id[cell]]);
        if (cell != 40 && cell != 67)
          continue;
        id[cell] = -1;
        matrix[cell] = symmetric_matrix();
        DependentCell special{cell, {dofs[cell], Numbers(n * n, 0.)}, matrix[cell]};
        special.dependence.masters[n - 1] = number[2];
        for (unsigned i = 0; i < n; ++i)
          special.dependence.C[i * n + i] = i + 1 < n ? 1 : 0.25;
        special.dependence.C[n * n - 2] = 0.75;
        dependent.push_back(special);
      }
      PatchShape shape{n, 2 * n - 1, 2, {}};
      for (unsigned k = 0; k < 2 * n; ++k)
        shape.cell_dofs.push_back(k < n ? k : k - 1);
      const auto patch_dofs = [&](const std::size_t p, std::uint32_t *to) { std::copy_n(number.begin() + p * 2 * (n - 1), 2 * n - 1, to); };
      fixed = {number[1], number[n_dofs / 2]};
      block = {{number[0], number[5], number[n_dofs - 1]}, {2, 1, 0, 1, 3, 4, 0, 4, 5}};
      op = std::make_unique<CellOperator>(n_dofs, std::vector<CellOperator::PatchGroup>{{shape, n_patches}}, patch_dofs, id, all, dependent,
                                          std::vector<DenseBlock>{block}, fixed);
    }

    Numbers symmetric_matrix()
    {
      Numbers M(n * n);
      for (unsigned i = 0; i < n; ++i)
        for (unsigned j = 0; j <= i; ++j)
          M[i * n + j] = M[j * n + i] = uniform(generator);
      return M;
    }

    /// A x, term by term.
    Numbers product(const Numbers &x) const
    {
      Numbers y(n_dofs, 0.);
      for (unsigned cell = 0; cell < n_cells; ++cell)
        for (unsigned i = 0; i < n; ++i)
        {
          const bool hangs_i = is_special(cell) && i == n - 1;
          double     sum = 0;
          for (unsigned j = 0; j < n; ++j)
            sum += matrix[cell][i * n + j] *
                   (is_special(cell) && j == n - 1 ? 0.75 * x[dofs[cell][n - 2]] + 0.25 * x[number[2]] : x[dofs[cell][j]]);
          y[dofs[cell][hangs_i ? n - 2 : i]] += hangs_i ? 0.75 * sum : sum;
          y[number[2]] += hangs_i ? 0.25 * sum : 0;
        }
      for (unsigned k = 0; k < 9; ++k)
        y[block.dofs[k / 3]] += block.matrix[k] * x[block.dofs[k % 3]];
      for (const auto dof : fixed)
        y[dof] = 0;
      return y;
    }

    static bool is_special(const unsigned cell) { return cell == 40 || cell == 67; }

    unsigned                                n, n_dofs;
    std::mt19937                            generator{7};
    std::uniform_real_distribution<double>  uniform{-1, 1};
    std::vector<std::uint32_t>              number, fixed;
    std::vector<std::vector<std::uint32_t>> dofs;
    std::vector<Numbers>                    matrix;
    DenseBlock                              block;
    std::unique_ptr<CellOperator>           op;
  };
} // namespace unilateral
