#include "unilateral/multigrid/block_gauss_seidel.h"

#include "unilateral/base/sort_unique.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    typedef float Float4 __attribute__((vector_size(16)));

    Float4 load4(const float *const x)
    {
      Float4 lanes;
      std::memcpy(&lanes, x, sizeof(lanes));
      return lanes;
    }

    /// The sum of blocks times vectors, for blocks of b x b. Those of 3 x 3 are read as vectors of four, whose last number is of the next
    /// column and goes nowhere.
    template <unsigned b>
    struct Sum
    {
      float y[b] = {};

      void subtract(const float *const block, const float *const x)
      {
        for (unsigned j = 0; j < b; ++j)
          for (unsigned i = 0; i < b; ++i)
            y[i] -= block[j * b + i] * x[j];
      }
      void store(float *const to) const
      {
        for (unsigned i = 0; i < b; ++i)
          to[i] = y[i];
      }
      static Sum of(const float *const x)
      {
        Sum sum;
        for (unsigned i = 0; i < b; ++i)
          sum.y[i] = x[i];
        return sum;
      }
    };

    template <>
    struct Sum<3>
    {
      Float4 y = {0, 0, 0, 0};

      void subtract(const float *const block, const float *const x)
      {
        y -= load4(block) * x[0];
        y -= load4(block + 3) * x[1];
        y -= load4(block + 6) * x[2];
      }
      void store(float *const to) const
      {
        for (unsigned i = 0; i < 3; ++i)
          to[i] = y[i];
      }
      static Sum of(const float *const x) { return {Float4{x[0], x[1], x[2], 0}}; }
    };

    template <>
    struct Sum<6>
    {
      Float4 first = {0, 0, 0, 0}, last = {0, 0, 0, 0}; ///< the last two numbers go nowhere

      void subtract(const float *const block, const float *const x)
      {
        for (unsigned j = 0; j < 6; ++j)
        {
          first -= load4(block + 6 * j) * x[j];
          last -= load4(block + 6 * j + 4) * x[j];
        }
      }
      void store(float *const to) const
      {
        std::memcpy(to, &first, 4 * sizeof(float));
        std::memcpy(to + 4, &last, 2 * sizeof(float));
      }
      static Sum of(const float *const x) { return {load4(x), Float4{x[4], x[5], 0, 0}}; }
    };

    /// to = block * sum
    template <unsigned b>
    void store_product(const float *const block, const Sum<b> &sum, float *const to)
    {
      float x[b];
      sum.store(x);
      for (unsigned i = 0; i < b; ++i)
      {
        float y = 0;
        for (unsigned j = 0; j < b; ++j)
          y += block[j * b + i] * x[j];
        to[i] = y;
      }
    }
  } // namespace

  BlockGaussSeidel::BlockGaussSeidel(const SparseMatrix<double> &A, const SparseRows &B, const unsigned block_size)
    : A(A), B(B), block_size(block_size)
  {
    const std::uint32_t n_nodes = A.m() / block_size;
    largest_diagonal = 0;
    for (std::size_t j = 0; j < A.m(); ++j)
      largest_diagonal = std::max(largest_diagonal, A.diag_element(j));

    std::vector<std::uint32_t> of_row;
    row_start.reserve(n_nodes + 1);
    diagonal.reserve(n_nodes);
    columns.reserve(A.n_nonzero_elements() / (block_size * block_size));
    row_start.push_back(0);
    for (std::uint32_t node = 0; node < n_nodes; ++node)
    {
      of_row.clear();
      for (std::size_t row = std::size_t(node) * block_size; row < std::size_t(node + 1) * block_size; ++row)
        for (auto entry = A.begin(row); entry != A.end(row); ++entry)
          if (const std::uint32_t column = entry->column() / block_size; of_row.empty() || of_row.back() != column)
            of_row.push_back(column);
      sort_unique(of_row);
      diagonal.push_back(columns.size() + (std::lower_bound(of_row.begin(), of_row.end(), node) - of_row.begin()));
      columns.insert(columns.end(), of_row.begin(), of_row.end());
      row_start.push_back(columns.size());
    }
    const unsigned size = block_size * block_size;
    blocks.resize(columns.size() * size + 4);
    inverse_diagonal.resize(std::size_t(n_nodes) * size);
    diagonal_blocks.resize(std::size_t(n_nodes) * size);
    for (std::uint32_t node = 0; node < n_nodes; ++node)
    {
      copy_rows_of(node);
      invert_diagonal_block(node);
    }
    for (const auto column : B.columns)
      seen_by_points.push_back(column / block_size);
    sort_unique(seen_by_points);
  }

  void BlockGaussSeidel::set_diagonal(const Vector &d)
  {
    for (const std::uint32_t node : seen_by_points)
      copy_rows_of(node);
    const unsigned b = block_size;
    for (std::size_t i = 0; i < B.size(); ++i)
      if (d(i) != 0)
        for (std::size_t k = B.row_start[i]; k < B.row_start[i + 1]; ++k)
        {
          const std::uint32_t row = B.columns[k];
          std::uint32_t       node = row / b;
          float              *block = blocks.data() + diagonal[node] * b * b;
          for (std::size_t l = B.row_start[i]; l < B.row_start[i + 1]; ++l)
          {
            const std::uint32_t column = B.columns[l];
            const double        value = d(i) * B.values[k] * B.values[l] / largest_diagonal;
            if (column / b != node)
            {
              node = column / b;
              block = blocks.data() + entry(row / b, node) * b * b;
            }
            if (node == row / b)
              diagonal_blocks[std::size_t(node) * b * b + column % b * b + row % b] += value;
            block[column % b * b + row % b] += float(value);
          }
        }
    for (const std::uint32_t node : seen_by_points)
      invert_diagonal_block(node);
  }

  void BlockGaussSeidel::first_sweep(const float *const r, float *const x, float *const rest) const
  {
    switch (block_size)
    {
    case 1:
      return first_sweep<1>(r, x, rest);
    case 2:
      return first_sweep<2>(r, x, rest);
    case 3:
      return first_sweep<3>(r, x, rest);
    default:
      return first_sweep<6>(r, x, rest);
    }
  }

  void BlockGaussSeidel::backward_sweep(const float *const r, float *const x) const
  {
    switch (block_size)
    {
    case 1:
      return backward_sweep<1>(r, x);
    case 2:
      return backward_sweep<2>(r, x);
    case 3:
      return backward_sweep<3>(r, x);
    default:
      return backward_sweep<6>(r, x);
    }
  }

  template <unsigned b>
  void BlockGaussSeidel::first_sweep(const float *const r, float *const x, float *const rest) const
  {
    const std::size_t n_nodes = diagonal.size();
    for (std::size_t node = 0; node < n_nodes; ++node)
    {
      auto sum = Sum<b>::of(r + node * b);
      for (std::size_t k = row_start[node]; k < diagonal[node]; ++k)
        sum.subtract(blocks.data() + k * b * b, x + std::size_t(columns[k]) * b);
      store_product<b>(inverse_diagonal.data() + node * b * b, sum, x + node * b);
    }
    for (std::size_t node = 0; node < n_nodes; ++node) // (L + D) x = r, so that r - T x = -U x
    {
      Sum<b> sum;
      for (std::size_t k = diagonal[node] + 1; k < row_start[node + 1]; ++k)
        sum.subtract(blocks.data() + k * b * b, x + std::size_t(columns[k]) * b);
      sum.store(rest + node * b);
    }
  }

  template <unsigned b>
  void BlockGaussSeidel::backward_sweep(const float *const r, float *const x) const
  {
    for (std::size_t node = diagonal.size(); node-- > 0;)
    {
      auto sum = Sum<b>::of(r + node * b);
      for (std::size_t k = row_start[node]; k < diagonal[node]; ++k)
        sum.subtract(blocks.data() + k * b * b, x + std::size_t(columns[k]) * b);
      for (std::size_t k = diagonal[node] + 1; k < row_start[node + 1]; ++k)
        sum.subtract(blocks.data() + k * b * b, x + std::size_t(columns[k]) * b);
      store_product<b>(inverse_diagonal.data() + node * b * b, sum, x + node * b);
    }
  }

  void BlockGaussSeidel::copy_rows_of(const std::uint32_t node)
  {
    const unsigned b = block_size;
    std::fill(blocks.begin() + row_start[node] * b * b, blocks.begin() + row_start[node + 1] * b * b, 0.F);
    std::fill_n(diagonal_blocks.begin() + std::size_t(node) * b * b, b * b, 0.);
    for (unsigned i = 0; i < b; ++i)
    {
      std::size_t k = row_start[node];
      for (auto at = A.begin(node * std::size_t(b) + i); at != A.end(node * std::size_t(b) + i); ++at)
      {
        const std::uint32_t column = at->column() / b;
        // Ascending but for the first entry of a row, the diagonal.
        k = column == node ? diagonal[node] : columns[k] == column ? k : entry(node, column);
        blocks[k * b * b + at->column() % b * b + i] = float(at->value() / largest_diagonal);
        if (column == node)
          diagonal_blocks[std::size_t(node) * b * b + at->column() % b * b + i] = at->value() / largest_diagonal;
      }
    }
  }

  void BlockGaussSeidel::invert_diagonal_block(const std::uint32_t node)
  {
    const unsigned  b = block_size;
    Eigen::MatrixXd block(b, b);
    for (unsigned j = 0; j < b; ++j)
      for (unsigned i = 0; i < b; ++i)
        block(i, j) = diagonal_blocks[std::size_t(node) * b * b + j * b + i];
    const Eigen::MatrixXd inverse = block.inverse();
    for (unsigned j = 0; j < b; ++j)
      for (unsigned i = 0; i < b; ++i)
        inverse_diagonal[std::size_t(node) * b * b + j * b + i] = float(inverse(i, j));
  }

  std::size_t BlockGaussSeidel::entry(const std::uint32_t row, const std::uint32_t column) const
  {
    return std::lower_bound(columns.begin() + row_start[row], columns.begin() + row_start[row + 1], column) - columns.begin();
  }
} // namespace unilateral
