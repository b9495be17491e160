#include "unilateral/algebra/lower_blocks.h"

#include <cstring>

namespace unilateral
{
  namespace
  {
    template <unsigned b>
    void multiply(const LowerBlocks<double> &matrix, const double *const x, double *const y)
    {
      for (std::size_t node = 0; node < matrix.n_nodes; ++node)
      {
        double xi[b], sum[b] = {};
        std::memcpy(xi, x + node * b, sizeof(xi));
        const double *const diagonal = matrix.diagonal + node * b * b;
        for (unsigned j = 0; j < b; ++j)
          for (unsigned i = 0; i < b; ++i)
            sum[i] += diagonal[j * b + i] * xi[j];
        for (std::size_t k = matrix.row_start[node]; k < matrix.row_start[node + 1]; ++k)
        {
          const double *const block = matrix.blocks + k * b * b;
          const std::size_t   column = std::size_t(matrix.columns[k]) * b;
          const double *const xj = x + column;
          double *const       yj = y + column;
          for (unsigned j = 0; j < b; ++j)
          {
            double of_column = yj[j];
            for (unsigned i = 0; i < b; ++i)
            {
              sum[i] += block[j * b + i] * xj[j];
              of_column += block[j * b + i] * xi[i];
            }
            yj[j] = of_column;
          }
        }
        std::memcpy(y + node * b, sum, sizeof(sum)); // rows behind this one add to it
      }
    }
  } // namespace

  void multiply(const LowerBlocks<double> &matrix, const unsigned b, const double *const x, double *const y)
  {
    with_block_size(b, [&](const auto size) { multiply<size()>(matrix, x, y); });
  }
} // namespace unilateral
