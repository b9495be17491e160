// What of A is not symmetric, cell by cell.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace unilateral
{
  /// C = sum over cells of P_K' C_K P_K with full matrices C_K, of which cells may share one. Unknowns that Dirichlet data fix couple with
  /// nothing: x is expected to vanish there, and nothing is added to y.
  class ConvectionOperator
  {
  public:
    /// @p n_dofs unknowns. @p dofs: n_cell_dofs for each cell. @p matrix_of_cell: an entry of @p matrices, n_cell_dofs^2 numbers each, row
    /// by row; negative: none.
    ConvectionOperator(std::size_t                       n_dofs,
                       unsigned                          n_cell_dofs,
                       std::vector<std::uint32_t>        dofs,
                       std::vector<std::int32_t>         matrix_of_cell,
                       std::vector<double>               matrices,
                       const std::vector<std::uint32_t> &fixed);

    void vmult_add(double *y, const double *x) const; ///< y += C x

  private:
    static constexpr std::uint32_t fixed = -1;

    unsigned                   n;
    std::vector<std::uint32_t> dofs; ///< `fixed` where nothing couples
    std::vector<std::int32_t>  matrix_of_cell;
    std::vector<double>        matrices;
  };
} // namespace unilateral
