#include "unilateral/multigrid/node_penalty.h"
#include "unilateral/algebra/dense_solvers.h"

#include <algorithm>
#include <cmath>

namespace unilateral
{
  namespace
  {
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    /// y += factor G G' x at the components of a node.
    template <typename Number, typename Output>
    void
    add_product(const NodePenalty::Node &node, const std::uint32_t *const places, const Number *const x, const Number factor, Output &&y)
    {
      const unsigned size = node.dofs.size();
      for (unsigned direction = 0; direction < size; ++direction)
      {
        Number along = 0;
        for (unsigned i = 0; i < size; ++i)
          along += Number(node.factor[i * size + direction]) * x[places[i]];
        along *= factor;
        for (unsigned i = 0; i < size; ++i)
          y(i) += Number(node.factor[i * size + direction]) * along;
      }
    }
  } // namespace

  void
  NodePenalty::set(const std::vector<DenseBlock> &blocks, const CellOperator &op, const SharedUnknowns &shared, const double truncation)
  {
    const auto &diagonal = op.diagonal();
    nodes.clear();
    first_entry.clear();
    if (blocks.empty())
    {
      node_of_dof.clear();
      return;
    }
    node_of_dof.assign(diagonal.size(), -1);
    std::uint32_t entry = 0;
    for (const auto &block : blocks)
    {
      const unsigned k = block.dofs.size();
      Matrix         P = Eigen::Map<const Matrix>(block.matrix.data(), k, k), with_stiffness = P, free = Matrix::Identity(k, k);
      double         stiffness = 0;
      for (unsigned i = 0; i < k; ++i)
      {
        with_stiffness(i, i) += diagonal[block.dofs[i]];
        stiffness += diagonal[block.dofs[i]] / k;
        node_of_dof[block.dofs[i]] = nodes.size();
      }
      const Eigen::SelfAdjointEigenSolver<Matrix> directions(P);
      for (unsigned i = 0; i < k; ++i)
        if (directions.eigenvalues()(i) > truncation * stiffness)
          free -= directions.eigenvectors().col(i) * directions.eigenvectors().col(i).transpose();
      const Matrix soft = free * P * free, inverse = with_stiffness.inverse(),
                   G = directions.eigenvectors() * directions.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
      first_entry.push_back(entry);
      entry += k;
      nodes.push_back({block.dofs,
                       block.matrix,
                       {G.data(), G.data() + k * k},
                       {free.data(), free.data() + k * k},
                       {soft.data(), soft.data() + k * k},
                       {inverse.data(), inverse.data() + k * k},
                       shared.owns(block.dofs[0])});
    }
    residual.assign(entry, 0);
  }

  std::uint32_t NodePenalty::entry_of(const std::uint32_t node, const std::uint32_t dof) const
  {
    return first_entry[node] + (std::find(nodes[node].dofs.begin(), nodes[node].dofs.end(), dof) - nodes[node].dofs.begin());
  }

  void NodePenalty::prepare_smoother(const CellOperator               &op,
                                     const std::vector<std::uint32_t> &cells,
                                     const std::vector<std::uint32_t> &positions)
  {
    position.clear();
    for (const auto &node : nodes)
      for (const auto dof : node.dofs)
        position.push_back(positions[dof]);
    fixed.assign(position.size(), false);
    for (const auto dof : op.fixed())
      if (const auto number = of_dof(dof); number >= 0)
        fixed[entry_of(number, dof)] = true;
    rows.clear();
    const unsigned             n = op.n_cell_dofs();
    std::vector<std::uint32_t> dofs(n);
    std::vector<double>        matrix(n * n);
    for (const auto cell : cells)
    {
      auto &of_cell = rows.emplace_back();
      of_cell.cell = cell;
      op.cell_dofs(cell, dofs.data());
      if (op.dependent(cell)) // among the terms
        std::fill(matrix.begin(), matrix.end(), 0.);
      else
        op.cell_matrix(cell, matrix.data());
      for (unsigned i = 0; i < n; ++i)
      {
        of_cell.positions.push_back(positions[dofs[i]]);
        const auto number = of_dof(dofs[i]);
        if (number < 0 || fixed[entry_of(number, dofs[i])])
          continue;
        of_cell.entry.push_back(entry_of(number, dofs[i]));
        of_cell.number.push_back(i);
        of_cell.matrix.insert(of_cell.matrix.end(), matrix.begin() + i * n, matrix.begin() + (i + 1) * n);
      }
    }
  }

  void NodePenalty::connect(const LevelHierarchy &hierarchy, const std::vector<std::uint32_t> &coarse_positions)
  {
    coarse_rows.assign(residual.size(), {});
    if (const PatchSweep &sweep = *hierarchy.levels.back().sweep; sweep.has_sparse_transfer())
    {
      for (std::size_t k = 0; k < nodes.size(); ++k)
        for (unsigned i = 0; i < nodes[k].dofs.size(); ++i)
          for (const auto &[at, weight] : sweep.coarse_row(nodes[k].dofs[i]))
          {
            auto &row = coarse_rows[first_entry[k] + i];
            row.positions.push_back(at);
            row.values.push_back(weight);
          }
      return;
    }
    const CellOperator        &coarse = *hierarchy.levels[hierarchy.levels.size() - 2].stiffness;
    const unsigned             n = coarse.n_cell_dofs(), n_children = hierarchy.n_children;
    std::vector<std::uint32_t> parent_dofs(n);
    for (const auto &of_cell : rows)
    {
      coarse.cell_dofs(of_cell.cell / n_children, parent_dofs.data());
      const auto &P = hierarchy.to_child[of_cell.cell % n_children];
      for (std::size_t k = 0; k < of_cell.entry.size(); ++k)
        if (auto &row = coarse_rows[of_cell.entry[k]]; row.positions.empty())
          for (unsigned j = 0; j < n; ++j)
            if (const double value = P[of_cell.number[k] * n + j]; std::abs(value) > 1e-12)
            {
              row.positions.push_back(coarse_positions[parent_dofs[j]]);
              row.values.push_back(value);
            }
    }
  }

  void NodePenalty::add(double *const y, const double *const x, const double factor) const
  {
    for (const auto &node : nodes)
      add_product(node, node.dofs.data(), x, factor, [&](const unsigned i) -> double & { return y[node.dofs[i]]; });
  }

  void NodePenalty::keep_residual(const float *const b, const float *const x, const float *const terms)
  {
    for (std::size_t k = 0; k < position.size(); ++k)
      residual[k] = x ? terms[position[k]] : 0;
    if (x)
    {
      for (const auto &of_cell : rows)
      {
        const float *row = of_cell.matrix.data();
        for (const auto entry : of_cell.entry)
          for (const auto place : of_cell.positions)
            residual[entry] += *row++ * x[place];
      }
      for (std::size_t k = 0; k < nodes.size(); ++k)
        add_product(nodes[k], position.data() + first_entry[k], x, 1.f,
                    [&](const unsigned i) -> float & { return residual[first_entry[k] + i]; });
    }
    for (std::size_t k = 0; k < position.size(); ++k)
      residual[k] = fixed[k] ? 0 : b[position[k]] - residual[k];
  }

  void NodePenalty::smooth(float *const x, float *const step, const float gain) const
  {
    for (std::size_t k = 0; k < nodes.size(); ++k)
      for (unsigned i = 0, size = nodes[k].dofs.size(); i < size; ++i)
      {
        float sum = 0;
        for (unsigned j = 0; j < size; ++j)
          sum += nodes[k].inverse[i * size + j] * residual[first_entry[k] + j];
        x[position[first_entry[k] + i]] += gain * sum;
        if (step)
          step[position[first_entry[k] + i]] += gain * sum;
      }
  }

  void NodePenalty::restrict_residual(float *const coarse_b) const
  {
    for (std::size_t k = 0; k < nodes.size(); ++k)
      for (unsigned i = 0, size = nodes[k].dofs.size(); nodes[k].owned && i < size; ++i)
      {
        float r = 0;
        for (unsigned j = 0; j < size; ++j)
          r += nodes[k].free[i * size + j] * residual[first_entry[k] + j];
        const auto &row = coarse_rows[first_entry[k] + i];
        for (std::size_t j = 0; j < row.positions.size(); ++j)
          coarse_b[row.positions[j]] += row.values[j] * r;
      }
  }

  void NodePenalty::prolongate(float *const x, const float *const coarse_x) const
  {
    for (std::size_t k = 0; k < nodes.size(); ++k)
      for (unsigned j = 0, size = nodes[k].dofs.size(); j < size; ++j)
      {
        const auto &row = coarse_rows[first_entry[k] + j];
        float       c = 0;
        for (std::size_t m = 0; m < row.positions.size(); ++m)
          c += row.values[m] * coarse_x[row.positions[m]];
        for (unsigned i = 0; i < size; ++i)
          x[position[first_entry[k] + i]] += nodes[k].free[i * size + j] * c;
      }
  }
} // namespace unilateral
