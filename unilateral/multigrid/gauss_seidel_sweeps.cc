#include "unilateral/multigrid/gauss_seidel_sweeps.h"

#include <cstring>

namespace unilateral
{
  namespace
  {
    typedef float Float4 __attribute__((vector_size(16)));

    Float4 load4(const float *const x)
    {
      Float4 lanes;
      std::memcpy(&lanes, x, sizeof(lanes));
      return lanes;
    }

    /// A sum of blocks times vectors.
    template <unsigned b>
    struct Sum
    {
      float y[b] = {};

      void add(const float *const block, const float *const x)
      {
        for (unsigned j = 0; j < b; ++j)
          for (unsigned i = 0; i < b; ++i)
            y[i] += block[j * b + i] * x[j];
      }
      void store(float *const to) const
      {
        for (unsigned i = 0; i < b; ++i)
          to[i] = y[i];
      }
    };

    /// Columns are read as vectors of four, whose last number is of the next column and goes nowhere. Each has a sum of its own: they do
    /// not wait for each other.
    template <>
    struct Sum<3>
    {
      Float4 y[3] = {};

      void add(const float *const block, const float *const x)
      {
        for (unsigned j = 0; j < 3; ++j)
          y[j] += load4(block + 3 * j) * x[j];
      }
      void store(float *const to) const
      {
        const Float4 sum = y[0] + y[1] + y[2];
        std::memcpy(to, &sum, 3 * sizeof(float));
      }
    };

    /// The last two numbers of the second vector go nowhere.
    template <>
    struct Sum<6>
    {
      Float4 first[2] = {}, last[2] = {};

      void add(const float *const block, const float *const x)
      {
        for (unsigned j = 0; j < 6; ++j)
        {
          first[j % 2] += load4(block + 6 * j) * x[j];
          last[j % 2] += load4(block + 6 * j + 4) * x[j];
        }
      }
      void store(float *const to) const
      {
        const Float4 sum = first[0] + first[1], rest = last[0] + last[1];
        std::memcpy(to, &sum, 4 * sizeof(float));
        std::memcpy(to + 4, &rest, 2 * sizeof(float));
      }
    };

    template <unsigned b>
    void add_blocks(const MatrixOfBlocks &matrix, const std::size_t begin, const std::size_t end, const float *const x, Sum<b> &sum)
    {
      for (std::size_t k = begin; k < end; ++k)
        sum.add(matrix.blocks + k * b * b, x + std::size_t(matrix.columns[k]) * b);
    }

    /// x = D^-1 (r - sum)
    template <unsigned b>
    void solve_at_node(const MatrixOfBlocks &matrix, const std::size_t node, const float *const r, const Sum<b> &sum, float *const x)
    {
      float rest[b];
      sum.store(rest);
      for (unsigned i = 0; i < b; ++i)
        rest[i] = r[node * b + i] - rest[i];
      const float *const inverse = matrix.inverse_diagonal + node * b * b;
      float              y[b] = {};
      for (unsigned j = 0; j < b; ++j)
        for (unsigned i = 0; i < b; ++i)
          y[i] += inverse[j * b + i] * rest[j];
      std::memcpy(x + node * b, y, sizeof(y));
    }

    template <unsigned b>
    void sweep_forward_from_zero(const MatrixOfBlocks &matrix, const float *const r, float *const x, float *const rest)
    {
      for (std::size_t node = 0; node < matrix.n_nodes; ++node)
      {
        Sum<b> sum;
        add_blocks(matrix, matrix.row_start[node], matrix.diagonal[node], x, sum);
        solve_at_node(matrix, node, r, sum, x);
      }
      for (std::size_t node = 0; node < matrix.n_nodes; ++node)
      {
        Sum<b> sum;
        add_blocks(matrix, matrix.diagonal[node] + 1, matrix.row_start[node + 1], x, sum);
        sum.store(rest + node * b);
        for (unsigned i = 0; i < b; ++i)
          rest[node * b + i] *= -1;
      }
    }

    template <unsigned b>
    void sweep_backward(const MatrixOfBlocks &matrix, const float *const r, float *const x)
    {
      for (std::size_t node = matrix.n_nodes; node-- > 0;)
      {
        Sum<b> sum;
        add_blocks(matrix, matrix.row_start[node], matrix.diagonal[node], x, sum);
        add_blocks(matrix, matrix.diagonal[node] + 1, matrix.row_start[node + 1], x, sum);
        solve_at_node(matrix, node, r, sum, x);
      }
    }
  } // namespace

  void sweep_forward_from_zero(const MatrixOfBlocks &matrix, const unsigned b, const float *const r, float *const x, float *const rest)
  {
    switch (b)
    {
    case 1:
      return sweep_forward_from_zero<1>(matrix, r, x, rest);
    case 2:
      return sweep_forward_from_zero<2>(matrix, r, x, rest);
    case 3:
      return sweep_forward_from_zero<3>(matrix, r, x, rest);
    default:
      return sweep_forward_from_zero<6>(matrix, r, x, rest);
    }
  }

  void sweep_backward(const MatrixOfBlocks &matrix, const unsigned b, const float *const r, float *const x)
  {
    switch (b)
    {
    case 1:
      return sweep_backward<1>(matrix, r, x);
    case 2:
      return sweep_backward<2>(matrix, r, x);
    case 3:
      return sweep_backward<3>(matrix, r, x);
    default:
      return sweep_backward<6>(matrix, r, x);
    }
  }
} // namespace unilateral
