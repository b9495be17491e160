#include "unilateral/multigrid/shared_gauss_seidel.h"

#include "unilateral/base/sort_unique.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <utility>

namespace unilateral
{
  namespace
  {
    constexpr unsigned steps_for_eigenvalue = 8;

    /// Below 2 with some room, as the power method finds less than the largest eigenvalue. Nodes on cuts get one step of Jacobi's method
    /// only: with 4/3, the best value for short waves alone, conjugate gradients took up to a third more steps.
    constexpr double damping = 1.55;

    double largest_diagonal_entry(const SymmetricBlockMatrix &A, const SharedUnknowns &shared)
    {
      double largest = 0;
      for (std::size_t j = 0; j < A.m(); ++j)
        largest = std::max(largest, A.diagonal_entry(j));
      return shared.processes().max(largest);
    }
  } // namespace

  SharedGaussSeidel::SharedGaussSeidel(const SymmetricBlockMatrix &A, const SparseRows &B, const SharedUnknowns &shared)
    : A(A), shared(shared), b(A.block_size()), cut_nodes(nodes_on_cuts(shared, b)),
      inside(A, B, cut_nodes, largest_diagonal_entry(A, shared))
  {
    if (shared.processes().alone())
      return;
    on_cuts.resize(A.m());
    changed_r.resize(A.m());
    for (const std::uint32_t node : cut_nodes)
    {
      A.for_each_block_in_row(node,
                              [&](const std::uint32_t column, const std::size_t k, const bool transposed) {
                                row_blocks.push_back({column, transposed, k});
                              });
      row_start.push_back(row_blocks.size());
    }
    inverse_on_cuts.resize(cut_nodes.size() * b * b);
    set_up_cuts();
  }

  std::vector<std::uint32_t> SharedGaussSeidel::nodes_on_cuts(const SharedUnknowns &shared, const unsigned block_size)
  {
    std::vector<std::uint32_t> nodes;
    for (const std::uint32_t dof : shared.all())
      nodes.push_back(dof / block_size);
    sort_unique(nodes);
    return nodes;
  }

  void SharedGaussSeidel::set_diagonal(const Vector &d)
  {
    inside.set_diagonal(d);
    if (!shared.processes().alone())
      set_up_cuts();
  }

  void SharedGaussSeidel::set_up_cuts()
  {
    std::vector<double>          column(A.m(), 0.);
    std::vector<Eigen::MatrixXd> blocks(cut_nodes.size(), Eigen::MatrixXd(b, b));
    for (unsigned j = 0; j < b; ++j)
    {
      for (const std::uint32_t node : cut_nodes)
        for (unsigned i = 0; i < b; ++i)
          column[std::size_t(node) * b + i] = inside.diagonal_block(node)[j * b + i];
      shared.add(column.data());
      for (std::size_t c = 0; c < cut_nodes.size(); ++c)
        for (unsigned i = 0; i < b; ++i)
          blocks[c](i, j) = column[std::size_t(cut_nodes[c]) * b + i];
    }
    for (std::size_t c = 0; c < cut_nodes.size(); ++c)
      Eigen::Map<Eigen::MatrixXf>(inverse_on_cuts.data() + c * b * b, b, b) = blocks[c].inverse().cast<float>();
    update_omega();
  }

  /// By a few steps of the power method: T_SS has few neighbours in a row, and a surface has no long waves that would count.
  void SharedGaussSeidel::update_omega()
  {
    const Processes   &processes = shared.processes();
    std::vector<float> x(A.m(), 0.F);
    const auto         norm = [&]
    {
      double square = 0;
      for (const std::uint32_t dof : shared.all())
        if (shared.owns(dof))
          square += double(x[dof]) * x[dof];
      return std::sqrt(processes.sum(square));
    };
    for (std::size_t k = 0; k < shared.all().size(); ++k)
      x[shared.all()[k]] = float(1 + (k * 2654435761U >> 16) % 7) * (k % 2 == 0 ? 1.F : -1.F);
    shared.add(x.data());
    omega = 1;
    double eigenvalue = 1;
    for (unsigned step = 0; step < steps_for_eigenvalue; ++step)
    {
      const double before = norm();
      if (!(before > 0))
        break;
      std::fill(changed_r.begin(), changed_r.end(), 0.F);
      for (const std::uint32_t dof : shared.all())
        x[dof] = float(x[dof] / before);
      subtract_columns(x.data(), changed_r.data());
      for (const std::uint32_t dof : shared.all())
      {
        on_cuts[dof] = -changed_r[dof];
        x[dof] = 0;
      }
      correct_on_cuts(x.data());
      eigenvalue = norm();
    }
    omega = float(std::min(1., damping / eigenvalue));
  }

  template <typename Visit>
  void SharedGaussSeidel::for_each_block(const std::size_t cut_node, const Visit &visit) const
  {
    for (std::size_t k = row_start[cut_node]; k < row_start[cut_node + 1]; ++k)
      visit(inside.lower_block(row_blocks[k].k), row_blocks[k].transposed, std::size_t(row_blocks[k].column) * b);
  }

  void SharedGaussSeidel::correct_on_cuts(float *const x) const
  {
    shared.add(on_cuts.data());
    for (std::size_t c = 0; c < cut_nodes.size(); ++c)
    {
      const float *const inverse = inverse_on_cuts.data() + c * b * b, *const r = on_cuts.data() + std::size_t(cut_nodes[c]) * b;
      for (unsigned j = 0; j < b; ++j)
        for (unsigned i = 0; i < b; ++i)
          x[std::size_t(cut_nodes[c]) * b + i] += omega * inverse[j * b + i] * r[j];
    }
  }

  void SharedGaussSeidel::subtract_columns(const float *const x, float *const rest) const
  {
    for (std::size_t c = 0; c < cut_nodes.size(); ++c)
    {
      const std::size_t   first = std::size_t(cut_nodes[c]) * b;
      const float *const  at_node = x + first;
      const double *const diagonal = inside.diagonal_block(cut_nodes[c]);
      for (unsigned j = 0; j < b; ++j)
        for (unsigned i = 0; i < b; ++i)
          rest[first + i] -= float(diagonal[j * b + i]) * at_node[j];
      // Row block (c, column) is symmetric to (column, c).
      for_each_block(c,
                     [&](const float *const block, const bool transposed, const std::size_t column)
                     {
                       for (unsigned j = 0; j < b; ++j)
                         for (unsigned i = 0; i < b; ++i)
                           rest[column + i] -= block[transposed ? j * b + i : i * b + j] * at_node[j];
                     });
    }
  }

  void SharedGaussSeidel::first_sweep(const float *const r, float *const x, float *const rest) const
  {
    inside.first_sweep(r, x, rest);
    if (shared.processes().alone())
      return;
    residual_on_cuts(r, x);
    for (const std::uint32_t dof : shared.all())
      rest[dof] = on_cuts[dof];
    correct_on_cuts(x);
    subtract_columns(x, rest);
  }

  void SharedGaussSeidel::backward_sweep(const float *const r, float *const x, float *const scratch) const
  {
    if (shared.processes().alone())
      return inside.backward_sweep(r, x, scratch);
    residual_on_cuts(r, x);
    correct_on_cuts(x);

    // The others sweep with what these nodes contribute on the right-hand side.
    std::copy(r, r + A.m(), changed_r.begin());
    subtract_columns(x, changed_r.data());
    for (const std::uint32_t dof : shared.all())
      on_cuts[dof] = std::exchange(x[dof], 0.F);
    inside.backward_sweep(changed_r.data(), x, scratch);
    for (const std::uint32_t dof : shared.all())
      x[dof] = on_cuts[dof];
  }

  void SharedGaussSeidel::residual_on_cuts(const float *const r, const float *const x) const
  {
    for (std::size_t c = 0; c < cut_nodes.size(); ++c)
    {
      const std::size_t   first = std::size_t(cut_nodes[c]) * b;
      float *const        rest = on_cuts.data() + first;
      const double *const diagonal = inside.diagonal_block(cut_nodes[c]);
      for (unsigned i = 0; i < b; ++i)
      {
        rest[i] = shared.owns(first + i) ? r[first + i] : 0.F;
        for (unsigned j = 0; j < b; ++j)
          rest[i] -= float(diagonal[j * b + i]) * x[first + j];
      }
      for_each_block(c,
                     [&](const float *const block, const bool transposed, const std::size_t column)
                     {
                       for (unsigned j = 0; j < b; ++j)
                         for (unsigned i = 0; i < b; ++i)
                           rest[i] -= block[transposed ? i * b + j : j * b + i] * x[column + j];
                     });
    }
  }
} // namespace unilateral
