#include "unilateral/multigrid/coarse_operators.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <utility>

namespace unilateral
{
  namespace
  {
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    using ConstMatrixMap = Eigen::Map<const Matrix>;

    constexpr std::int32_t unchanged = MultigridLevel::unchanged, vanished = MultigridLevel::vanished;
  } // namespace

  CoarseOperators::CoarseOperators(std::shared_ptr<const LevelHierarchy> level_hierarchy)
    : hierarchy(std::move(level_hierarchy)), flags(hierarchy->finest().n_dofs(), is_left), cell_flags(hierarchy->finest().n_cells())
  {
  }

  void CoarseOperators::compute(const TangentPenalty &penalty, std::vector<MultigridLevel> &levels)
  {
    for (std::size_t l = 0; l + 1 < levels.size(); ++l)
    {
      levels[l].change.clear();
      levels[l].changed_matrices.clear();
    }
    if (penalty.empty())
      return;
    look_at_cells(penalty);
    for (unsigned l = levels.size() - 1; l > 0; --l)
      coarsen(penalty, levels, l);
  }

  std::vector<std::uint32_t> CoarseOperators::cells_at_nodes() const
  {
    std::vector<std::uint32_t> cells;
    for (std::size_t cell = 0; cell < cell_flags.size(); ++cell)
      if (cell_flags[cell] & is_at_node)
        cells.push_back(cell);
    return cells;
  }

  void CoarseOperators::look_at_cells(const TangentPenalty &penalty)
  {
    const auto &op = hierarchy->finest();
    const auto &shared = hierarchy->levels.back().shared;
    for (const auto dof : flagged)
      flags[dof] = is_left;
    flagged = penalty.unknowns();
    for (const auto dof : penalty.unknowns())
      flags[dof] = is_penalised | (penalty.truncates(dof) ? 0 : is_left);
    for (const auto &node : penalty.nodes.all())
      for (const auto dof : node.dofs)
      {
        flags[dof] |= is_at_node;
        flagged.push_back(dof);
      }
    hand_on_flags();
    // What several processes have is taken to the coarser level by its owner.
    for (const auto dof : shared.all())
      if (!shared.owns(dof))
        flags[dof] |= is_taken;
    op.collect_flags(flags.data(), cell_flags.data());
    for (const auto &block : penalty.cells())
      cell_flags[block.cell] |= is_penalised | is_left;
  }

  void CoarseOperators::hand_on_flags()
  {
    std::vector<std::uint32_t> dofs(hierarchy->finest().n_cell_dofs());
    for (const auto &cell : hierarchy->finest().all_dependent())
    {
      hierarchy->finest().cell_dofs(cell.cell, dofs.data());
      const auto &[masters, C] = cell.dependence;
      for (std::size_t i = 0; i < dofs.size(); ++i)
      {
        if (std::find(masters.begin(), masters.end(), dofs[i]) != masters.end())
          continue;
        unsigned char all = 0;
        for (std::size_t j = 0; j < masters.size(); ++j)
          if (C[i * masters.size() + j] != 0)
            all |= flags[masters[j]] & (is_penalised | is_left);
        if (all != 0) // else it is fixed
          flags[dofs[i]] = all | is_taken;
      }
    }
  }

  void CoarseOperators::coarsen(const TangentPenalty &penalty, std::vector<MultigridLevel> &levels, const unsigned l)
  {
    const auto    &fine = levels[l];
    auto          &coarse = levels[l - 1];
    const bool     finest = l + 1 == levels.size();
    const unsigned n = fine.stiffness->n_cell_dofs();
    if (const auto *const cut = hierarchy->cut_at(l))
    {
      gather_changes(levels, *cut);
      collect_differences(coarse, hierarchy->levels[l - 1].shared);
      return;
    }

    coarse.change.assign(coarse.stiffness->n_cells(), unchanged);
    std::vector<std::uint32_t> dofs(n);
    Matrix                     child_matrix(n, n), sum(n, n);
    for (std::size_t parent = 0; parent < coarse.change.size(); ++parent)
    {
      bool any_changed = false, any_left = false;
      const auto [first, end] = hierarchy->children(l, parent);
      for (std::size_t cell = first; cell < end; ++cell)
      {
        any_changed |= finest ? (cell_flags[cell] & (is_penalised | is_at_node)) != 0 : fine.change[cell] != unchanged;
        any_left |= finest ? (cell_flags[cell] & is_left) != 0 : fine.change[cell] != vanished;
      }
      if (!any_changed)
        continue;
      if (!any_left)
      {
        coarse.change[parent] = vanished;
        continue;
      }
      sum.setZero();
      for (std::size_t cell = first; cell < end; ++cell)
      {
        if (finest)
        {
          fine.stiffness->cell_dofs(cell, dofs.data());
          fine.stiffness->cell_matrix(cell, child_matrix.data());
          const auto block = std::lower_bound(penalty.cells().begin(), penalty.cells().end(), cell,
                                              [](const auto &of, const std::size_t number) { return of.cell < number; });
          if (block != penalty.cells().end() && block->cell == cell)
            child_matrix += ConstMatrixMap(block->matrix.data(), n, n);
          if (const DependentCell *const dependent = fine.stiffness->dependent(cell))
            truncate(penalty, dependent->dependence, dofs, child_matrix.data());
          else
            truncate(penalty, dofs, child_matrix.data());
        }
        else if (fine.change[cell] == vanished)
          continue;
        else if (fine.change[cell] >= 0)
          child_matrix = ConstMatrixMap(fine.changed_matrices.data() + std::size_t(fine.change[cell]) * n * n, n, n);
        else
          fine.stiffness->cell_matrix(cell, child_matrix.data());
        if (end - first == 1)
        {
          sum = child_matrix;
          continue;
        }
        const ConstMatrixMap P(hierarchy->to_child[cell - first].data(), n, n);
        sum.noalias() += P.transpose() * (child_matrix * P);
      }
      coarse.change[parent] = coarse.changed_matrices.size() / (n * n);
      coarse.changed_matrices.insert(coarse.changed_matrices.end(), sum.data(), sum.data() + n * n);
    }

    collect_differences(coarse, hierarchy->levels[l - 1].shared);
  }

  void CoarseOperators::truncate(const TangentPenalty &penalty, const std::vector<std::uint32_t> &dofs, double *const cell_matrix)
  {
    const unsigned     n = dofs.size();
    Eigen::Map<Matrix> matrix(cell_matrix, n, n);
    for (unsigned i = 0; i < n; ++i)
      if (penalty.truncates(dofs[i]))
      {
        matrix.row(i).setZero();
        matrix.col(i).setZero();
      }
      else if ((flags[dofs[i]] & (is_penalised | is_taken)) == is_penalised)
      {
        flags[dofs[i]] |= is_taken;
        matrix(i, i) += penalty.diagonal(dofs[i]);
      }
      else if (flags[dofs[i]] & is_at_node && dofs[i] == penalty.nodes.all()[penalty.nodes.of_dof(dofs[i])].dofs[0])
      {
        // Once for each node: its components follow each other.
        const auto           &node = penalty.nodes.all()[penalty.nodes.of_dof(dofs[i])];
        const unsigned        k = node.dofs.size();
        std::vector<unsigned> at(k);
        for (unsigned a = 0; a < k; ++a)
          at[a] = std::find(dofs.begin(), dofs.end(), node.dofs[a]) - dofs.begin();
        const ConstMatrixMap free(node.free.data(), k, k), soft(node.soft.data(), k, k);
        const Matrix         rows = free * matrix(at, Eigen::all);
        matrix(at, Eigen::all) = rows;
        const Matrix columns = matrix(Eigen::all, at) * free;
        matrix(Eigen::all, at) = columns;
        if (!(flags[dofs[i]] & is_taken))
        {
          flags[dofs[i]] |= is_taken;
          matrix(at, at) += soft;
        }
      }
  }

  void CoarseOperators::truncate(const TangentPenalty             &penalty,
                                 const Dependence                 &dependence,
                                 const std::vector<std::uint32_t> &dofs,
                                 double *const                     matrix)
  {
    const auto &[masters, C] = dependence;
    const std::size_t m = masters.size(), n = dofs.size();
    for (std::size_t i = 0; i < n; ++i)
    {
      double all = 0, left = 0;
      for (std::size_t j = 0; j < m; ++j)
      {
        const double weight = std::abs(C[i * m + j]);
        all += weight;
        left += penalty.truncates(masters[j]) ? 0 : weight;
      }
      for (std::size_t j = 0; j < n && left < all; ++j)
      {
        matrix[i * n + j] *= left / all;
        matrix[j * n + i] *= left / all;
      }
      if ((flags[dofs[i]] & (is_penalised | is_taken)) == is_penalised && !penalty.truncates(dofs[i]))
      {
        flags[dofs[i]] |= is_taken;
        matrix[i * (n + 1)] += penalty.diagonal(dofs[i]);
      }
    }
  }

  void CoarseOperators::gather_changes(std::vector<MultigridLevel> &levels, const LevelHierarchy::Cut &cut) const
  {
    const auto    &part = levels[cut.level];
    auto          &whole = levels[cut.level - 1];
    const unsigned n = part.stiffness->n_cell_dofs();
    struct Changed
    {
      std::uint32_t cell;
      bool          vanishes;
    };
    std::vector<Changed> own;
    std::vector<double>  own_matrices;
    for (std::size_t cell = 0; cell < part.change.size(); ++cell)
      if (const auto change = part.change[cell]; change != unchanged)
      {
        own.push_back({cut.cells[cell], change == vanished});
        if (change >= 0)
          own_matrices.insert(own_matrices.end(), part.changed_matrices.begin() + std::size_t(change) * n * n,
                              part.changed_matrices.begin() + std::size_t(change + 1) * n * n);
      }
    whole.changed_matrices = cut.group.gather(own_matrices);
    whole.change.assign(whole.stiffness->n_cells(), unchanged);
    std::int32_t n_matrices = 0;
    for (const auto &[cell, vanishes] : cut.group.gather(own))
      whole.change[cell] = vanishes ? vanished : n_matrices++;
  }

  void CoarseOperators::collect_differences(MultigridLevel &coarse, const SharedUnknowns &shared) const
  {
    const unsigned             n = coarse.stiffness->n_cell_dofs();
    std::vector<std::uint32_t> dofs(n);
    Matrix                     difference(n, n);
    const auto                 base = coarse.diagonal_on_cuts(shared);
    const auto                 find_difference = [&](const std::size_t cell)
    {
      coarse.stiffness->cell_matrix(cell, difference.data());
      difference = -difference;
      if (coarse.change[cell] >= 0)
        difference += ConstMatrixMap(coarse.changed_matrices.data() + std::size_t(coarse.change[cell]) * n * n, n, n);
    };
    const auto add_to_diagonal = [&](const std::vector<std::uint32_t> &dofs, const double *const matrix)
    {
      for (std::size_t i = 0; i < dofs.size(); ++i)
        coarse.diagonal[dofs[i]] += matrix[i * (dofs.size() + 1)];
      coarse.touched.insert(coarse.touched.end(), dofs.begin(), dofs.end());
    };
    for (std::size_t cell = 0; cell < coarse.change.size(); ++cell)
      if (coarse.change[cell] != unchanged)
      {
        find_difference(cell);
        if (coarse.stiffness->dependent(cell))
        {
          const DenseBlock block = coarse.stiffness->contribution(cell, difference.data());
          add_to_diagonal(block.dofs, block.matrix.data());
          coarse.add_block(block.dofs, block.matrix.data());
          continue;
        }
        coarse.stiffness->cell_dofs(cell, dofs.data());
        add_to_diagonal(dofs, difference.data());
      }
    coarse.add_diagonal_of_others(shared, base);
    // A vanished cell whose unknowns all have vanished needs no difference: nothing is solved for there.
    const auto &a_ii = coarse.stiffness->diagonal();
    for (std::size_t cell = 0; cell < coarse.change.size(); ++cell)
      if (const auto change = coarse.change[cell]; change != unchanged && !coarse.stiffness->dependent(cell))
      {
        coarse.stiffness->cell_dofs(cell, dofs.data());
        if (change == vanished &&
            std::all_of(dofs.begin(), dofs.end(),
                        [&](const auto dof) { return coarse.diagonal[dof] <= MultigridLevel::negligible_energy * a_ii[dof]; }))
          continue;
        find_difference(cell);
        coarse.add_block(dofs, difference.data());
      }
  }
} // namespace unilateral
