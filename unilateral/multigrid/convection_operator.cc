#include "unilateral/multigrid/convection_operator.h"

#include <utility>

namespace unilateral
{
  ConvectionOperator::ConvectionOperator(const std::size_t                 n_dofs,
                                         const unsigned                    n_cell_dofs,
                                         std::vector<std::uint32_t>        dofs_of_cells,
                                         std::vector<std::int32_t>         matrix_of_cell,
                                         std::vector<double>               matrices,
                                         const std::vector<std::uint32_t> &fixed_dofs)
    : n(n_cell_dofs), dofs(std::move(dofs_of_cells)), matrix_of_cell(std::move(matrix_of_cell)), matrices(std::move(matrices))
  {
    std::vector<bool> is_fixed(n_dofs);
    for (const auto dof : fixed_dofs)
      is_fixed[dof] = true;
    for (auto &dof : dofs)
      if (is_fixed[dof])
        dof = fixed;
  }

  void ConvectionOperator::vmult_add(double *const y, const double *const x) const
  {
    std::vector<double> local(n);
    for (std::size_t cell = 0; cell < matrix_of_cell.size(); ++cell)
    {
      if (matrix_of_cell[cell] < 0)
        continue;
      const std::uint32_t *const of_cell = dofs.data() + cell * n;
      const double              *row = matrices.data() + std::size_t(matrix_of_cell[cell]) * n * n;
      for (unsigned j = 0; j < n; ++j)
        local[j] = of_cell[j] == fixed ? 0. : x[of_cell[j]];
      for (unsigned i = 0; i < n; ++i, row += n)
      {
        if (of_cell[i] == fixed)
          continue;
        double sum = 0;
        for (unsigned j = 0; j < n; ++j)
          sum += row[j] * local[j];
        y[of_cell[i]] += sum;
      }
    }
  }
} // namespace unilateral
