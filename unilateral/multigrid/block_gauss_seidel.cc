#include "unilateral/multigrid/block_gauss_seidel.h"

#include "unilateral/base/sort_unique.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

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
    sweep_forward_from_zero(matrix_of_blocks(), block_size, r, x, rest);
  }

  void BlockGaussSeidel::backward_sweep(const float *const r, float *const x) const
  {
    sweep_backward(matrix_of_blocks(), block_size, r, x);
  }

  MatrixOfBlocks BlockGaussSeidel::matrix_of_blocks() const
  {
    return {diagonal.size(), row_start.data(), diagonal.data(), columns.data(), blocks.data(), inverse_diagonal.data()};
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
