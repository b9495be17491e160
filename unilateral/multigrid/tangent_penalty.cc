#include "unilateral/multigrid/tangent_penalty.h"

#include <algorithm>
#include <utility>

namespace unilateral
{
  TangentPenalty::TangentPenalty(std::shared_ptr<const LevelHierarchy> level_hierarchy, const double truncation)
    : hierarchy(std::move(level_hierarchy)), truncation(truncation), on_diagonal(hierarchy->finest().n_dofs(), 0.)
  {
  }

  void TangentPenalty::set(const std::vector<double> &diagonal, const std::vector<DenseBlock> &node_blocks, std::vector<CellBlock> blocks)
  {
    for (const auto dof : penalised)
      on_diagonal[dof] = 0;
    penalised.clear();
    for (std::size_t dof = 0; dof < diagonal.size(); ++dof)
      if (diagonal[dof] != 0)
      {
        on_diagonal[dof] = diagonal[dof];
        penalised.push_back(dof);
      }
    nodes.set(node_blocks, hierarchy->finest(), hierarchy->levels.back().shared, truncation);
    cell_blocks = std::move(blocks);
    std::sort(cell_blocks.begin(), cell_blocks.end(), [](const auto &a, const auto &b) { return a.cell < b.cell; });
    any = hierarchy->processes().any(!cell_blocks.empty() || !nodes.empty() || !penalised.empty());
    any_cells = hierarchy->processes().any(!cell_blocks.empty());
  }

  void TangentPenalty::add(double *const y, const double *const x, const double factor) const
  {
    if (!any)
      return;
    for (const auto dof : penalised)
      y[dof] += factor * on_diagonal[dof] * x[dof];
    nodes.add(y, x, factor);
    if (!any_cells)
      return;
    // What others add to unknowns on cuts must arrive once.
    const auto                &shared = hierarchy->levels.back().shared;
    const bool                 several = !shared.processes().alone();
    std::vector<double>        sum(several ? on_diagonal.size() : 0, 0.);
    double *const              target = several ? sum.data() : y;
    const auto                &op = hierarchy->finest();
    std::vector<std::uint32_t> dofs(op.n_cell_dofs());
    const auto                 add = [&](const std::vector<std::uint32_t> &dofs, const double *matrix)
    {
      for (const auto row : dofs)
        for (const auto column : dofs)
          target[row] += factor * *matrix++ * x[column];
    };
    for (const auto &penalty : cell_blocks)
      if (op.dependent(penalty.cell))
      {
        const DenseBlock block = op.contribution(penalty.cell, penalty.matrix.data());
        add(block.dofs, block.matrix.data());
      }
      else
      {
        op.cell_dofs(penalty.cell, dofs.data());
        add(dofs, penalty.matrix.data());
      }
    shared.add(sum.data());
    for (std::size_t i = 0; i < sum.size(); ++i)
      y[i] += sum[i];
  }
} // namespace unilateral
