// Contact at every unknown by itself.
#pragma once

#include "unilateral/algebra/sparse_rows.h"

#include <cstddef>

namespace unilateral
{
  /// B = I of n unknowns.
  inline OwnSparseRows rows_at_unknowns(const std::size_t n)
  {
    OwnSparseRows B;
    B.n_columns = n;
    for (std::size_t i = 0; i < n; ++i)
    {
      B.columns.push_back(i);
      B.values.push_back(1.);
      B.row_start.push_back(i + 1);
    }
    return B;
  }
} // namespace unilateral
