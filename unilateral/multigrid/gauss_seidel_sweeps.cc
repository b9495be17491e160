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

    /// L x at a node.
    template <unsigned b>
    Sum<b> row_product(const LowerBlocks<float> &matrix, const std::size_t node, const float *const x)
    {
      Sum<b> sum;
      for (std::size_t k = matrix.row_start[node]; k < matrix.row_start[node + 1]; ++k)
        sum.add(matrix.blocks + k * b * b, x + std::size_t(matrix.columns[k]) * b);
      return sum;
    }

    /// y += factor L'x of x at this node alone. Right behind row_product(): the blocks are at hand still.
    template <unsigned b>
    void add_column(const LowerBlocks<float> &matrix, const std::size_t node, const float factor, const float *const x, float *const y)
    {
      float xi[b];
      for (unsigned i = 0; i < b; ++i)
        xi[i] = factor * x[node * b + i];
      for (std::size_t k = matrix.row_start[node]; k < matrix.row_start[node + 1]; ++k)
      {
        const float *const block = matrix.blocks + k * b * b;
        float *const       yj = y + std::size_t(matrix.columns[k]) * b;
        for (unsigned j = 0; j < b; ++j)
        {
          float of_column = 0;
          for (unsigned i = 0; i < b; ++i)
            of_column += block[j * b + i] * xi[i];
          yj[j] += of_column;
        }
      }
    }

    /// x = D^-1 r at a node.
    template <unsigned b>
    void solve_at_node(const LowerBlocks<float> &matrix, const std::size_t node, const float (&r)[b], float *const x)
    {
      const float *const inverse = matrix.diagonal + node * b * b;
      float              y[b] = {};
      for (unsigned j = 0; j < b; ++j)
        for (unsigned i = 0; i < b; ++i)
          y[i] += inverse[j * b + i] * r[j];
      std::memcpy(x + node * b, y, sizeof(y));
    }

    template <unsigned b>
    void sweep_forward_from_zero(const LowerBlocks<float> &matrix, const float *const r, float *const x, float *const rest)
    {
      for (std::size_t node = 0; node < matrix.n_nodes; ++node)
      {
        float at_node[b];
        row_product<b>(matrix, node, x).store(at_node);
        for (unsigned i = 0; i < b; ++i)
        {
          at_node[i] = r[node * b + i] - at_node[i];
          rest[node * b + i] = 0; // nodes behind this one add to it
        }
        solve_at_node<b>(matrix, node, at_node, x);
        add_column<b>(matrix, node, -1, x, rest);
      }
    }

    template <unsigned b>
    void sweep_backward(const LowerBlocks<float> &matrix, const float *const r, float *const x, float *const behind)
    {
      std::memset(behind, 0, matrix.n_nodes * b * sizeof(float)); // L'x of the nodes that have been passed
      for (std::size_t node = matrix.n_nodes; node-- > 0;)
      {
        float at_node[b];
        row_product<b>(matrix, node, x).store(at_node);
        for (unsigned i = 0; i < b; ++i)
          at_node[i] = r[node * b + i] - behind[node * b + i] - at_node[i];
        solve_at_node<b>(matrix, node, at_node, x);
        add_column<b>(matrix, node, 1, x, behind);
      }
    }
  } // namespace

  void sweep_forward_from_zero(const LowerBlocks<float> &matrix, const unsigned b, const float *const r, float *const x, float *const rest)
  {
    with_block_size(b, [&](const auto size) { sweep_forward_from_zero<size()>(matrix, r, x, rest); });
  }

  void sweep_backward(const LowerBlocks<float> &matrix, const unsigned b, const float *const r, float *const x, float *const scratch)
  {
    with_block_size(b, [&](const auto size) { sweep_backward<size()>(matrix, r, x, scratch); });
  }
} // namespace unilateral
