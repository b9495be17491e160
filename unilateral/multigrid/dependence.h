// Unknowns that depend on others, and what that makes of a matrix.
#pragma once

#include <cstdint>
#include <vector>

namespace unilateral
{
  /// A square matrix that belongs to a few unknowns.
  struct DenseBlock
  {
    std::vector<std::uint32_t> dofs;
    std::vector<double>        matrix; ///< row by row
  };

  /// Some unknowns in terms of others that are free: u = C u_masters.
  struct Dependence
  {
    std::vector<std::uint32_t> masters;
    std::vector<double>        C; ///< unknowns x masters, row by row

    DenseBlock condense(const double *M) const; ///< C'MC for a matrix on the unknowns
  };
} // namespace unilateral
