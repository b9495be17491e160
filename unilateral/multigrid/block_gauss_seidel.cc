#include "unilateral/multigrid/block_gauss_seidel.h"

#include "unilateral/base/sort_unique.h"

#include <Eigen/LU>

#include <algorithm>

namespace unilateral
{
  BlockGaussSeidel::BlockGaussSeidel(const SymmetricBlockMatrix       &A,
                                     const SparseRows                 &B,
                                     const std::vector<std::uint32_t> &left_out,
                                     const std::optional<double>       scale)
    : A(A), B(B)
  {
    const unsigned b = A.block_size();
    largest_diagonal = scale.value_or(0);
    for (std::size_t j = 0; j < A.m() && !scale; ++j)
      largest_diagonal = std::max(largest_diagonal, A.diagonal_entry(j));
    is_left_out.resize(left_out.empty() ? 0 : A.n_nodes(), false);
    for (const std::uint32_t node : left_out)
      is_left_out[node] = true;
    blocks.resize(A.n_lower_blocks() * b * b + 4);
    inverse_diagonal.resize(A.m() * b);
    diagonal_blocks.resize(A.m() * b);
    for (std::uint32_t node = 0; node < A.n_nodes(); ++node)
    {
      copy_rows_of(node);
      invert_diagonal_block(node);
    }
    for (const auto column : B.columns)
      seen_by_points.push_back(column / b);
    sort_unique(seen_by_points);
  }

  void BlockGaussSeidel::set_diagonal(const Vector &d)
  {
    for (const std::uint32_t node : seen_by_points)
      copy_rows_of(node);
    const unsigned b = A.block_size();
    for (std::size_t i = 0; i < B.size(); ++i)
      if (d(i) != 0)
        for (std::size_t k = B.row_start[i]; k < B.row_start[i + 1]; ++k)
        {
          const std::uint32_t row = B.columns[k], node = row / b;
          std::uint32_t       node_of_block = node;
          float              *block = nullptr;
          for (std::size_t l = B.row_start[i]; l < B.row_start[i + 1]; ++l)
          {
            const std::uint32_t column = B.columns[l];
            const double        value = d(i) * B.values[k] * B.values[l] / largest_diagonal;
            if (column / b == node)
              diagonal_blocks[std::size_t(node) * b * b + column % b * b + row % b] += value;
            else if (column / b < node)
            {
              if (column / b != node_of_block)
              {
                node_of_block = column / b;
                block = blocks.data() + A.lower_block(node, node_of_block) * b * b;
              }
              block[column % b * b + row % b] += float(value);
            }
          }
        }
    for (const std::uint32_t node : seen_by_points)
      invert_diagonal_block(node);
  }

  void BlockGaussSeidel::first_sweep(const float *const r, float *const x, float *const rest) const
  {
    sweep_forward_from_zero(lower_blocks(), A.block_size(), r, x, rest);
  }

  void BlockGaussSeidel::backward_sweep(const float *const r, float *const x, float *const scratch) const
  {
    sweep_backward(lower_blocks(), A.block_size(), r, x, scratch);
  }

  LowerBlocks<float> BlockGaussSeidel::lower_blocks() const
  {
    const LowerBlocks<double> of_A = A.lower_blocks();
    return {of_A.n_nodes, of_A.row_start, of_A.columns, blocks.data(), inverse_diagonal.data()};
  }

  void BlockGaussSeidel::copy_rows_of(const std::uint32_t node)
  {
    const LowerBlocks<double> of_A = A.lower_blocks();
    const std::size_t         size = std::size_t(A.block_size()) * A.block_size();
    for (std::size_t k = of_A.row_start[node] * size; k < of_A.row_start[node + 1] * size; ++k)
      blocks[k] = float(of_A.blocks[k] / largest_diagonal);
    for (std::size_t k = node * size; k < (node + 1) * size; ++k)
      diagonal_blocks[k] = of_A.diagonal[k] / largest_diagonal;
  }

  void BlockGaussSeidel::invert_diagonal_block(const std::uint32_t node)
  {
    const unsigned              b = A.block_size();
    Eigen::Map<Eigen::MatrixXf> inverse(inverse_diagonal.data() + std::size_t(node) * b * b, b, b);
    if (!is_left_out.empty() && is_left_out[node])
      inverse.setZero();
    else
      inverse = Eigen::Map<const Eigen::MatrixXd>(diagonal_block(node), b, b).inverse().cast<float>();
  }
} // namespace unilateral
