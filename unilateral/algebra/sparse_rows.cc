#include "unilateral/algebra/sparse_rows.h"

namespace unilateral
{
  void add_penalty(dealii::SparseMatrix<double> &T, const SparseRows &B, const Vector &d)
  {
    for (std::size_t i = 0; i < B.size(); ++i)
      if (d(i) != 0)
        for (std::size_t k = B.row_start[i]; k < B.row_start[i + 1]; ++k)
          for (std::size_t l = B.row_start[i]; l < B.row_start[i + 1]; ++l)
            T.add(B.columns[k], B.columns[l], d(i) * B.values[k] * B.values[l]);
  }
} // namespace unilateral
