#include "unilateral/multigrid.h"

#include "unilateral/scaled_eigenvalue.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace unilateral
{
  namespace
  {
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    using ConstMatrixMap = Eigen::Map<const Matrix>;

    constexpr std::int32_t unchanged = MultigridLevel::unchanged, vanished = MultigridLevel::vanished;

    /// A coarse function of which truncation leaves less than this part of its energy is left out: in single precision its row would be
    /// noise.
    constexpr double negligible_energy = 1e-3;

    double largest_magnitude(const double *const r, const std::size_t n)
    {
      // Several side by side: a single one would wait for each comparison.
      constexpr std::size_t width = 16;
      double                largest[width] = {};
      const std::size_t     n_whole = n / width * width;
      for (std::size_t i = 0; i < n_whole; i += width)
        for (std::size_t l = 0; l < width; ++l)
          largest[l] = std::max(largest[l], std::abs(r[i + l]));
      for (std::size_t i = n_whole; i < n; ++i)
        largest[0] = std::max(largest[0], std::abs(r[i]));
      return *std::max_element(largest, largest + width);
    }
  } // namespace

  Multigrid::Parameters Multigrid::Parameters::for_volume_to_shape_stiffness(const double ratio)
  {
    constexpr double ratio_for_degree_2 = 9; // nu = 0.45
    Parameters       parameters;
    parameters.smoother_degree = std::clamp<long>(std::lround(2 * std::sqrt(ratio / ratio_for_degree_2)), 2, 10);
    if (parameters.smoother_degree > 2)
      parameters.smoothing_range = 1.25 * parameters.smoother_degree * parameters.smoother_degree;
    return parameters;
  }

  Multigrid::Multigrid(std::shared_ptr<const LevelHierarchy> level_hierarchy, const Parameters &parameters)
    : hierarchy(std::move(level_hierarchy)), parameters(parameters)
  {
    for (const auto &level : hierarchy->levels)
      levels.emplace_back(*level.stiffness, *level.sweep, level.shared);
    levels.back().penalty.resize(levels.back().sweep->size(), 0.f);
    dof_penalty.assign(hierarchy->finest().n_dofs(), 0);
    flags.assign(hierarchy->finest().n_dofs(), is_left);
    cell_flags.resize(hierarchy->finest().n_cells());
  }

  void
  Multigrid::set_penalty(const std::vector<double> &diagonal, const std::vector<DenseBlock> &node_blocks, std::vector<CellBlock> blocks)
  {
    auto &finest = levels.back();
    for (const auto dof : finest.touched)
    {
      dof_penalty[dof] = finest.penalty[finest.sweep->positions()[dof]] = 0;
      flags[dof] = is_left;
    }
    for (auto &level : levels)
    {
      for (const auto dof : level.touched)
        level.reset(dof);
      level.touched.clear();
      level.additions.batches.assign(level.sweep->n_batches(), 0);
      level.block_start = {0};
      level.block_positions.clear();
      level.block_matrices.clear();
      for (const auto &block : level.stiffness->further_blocks())
        level.add_block(block.dofs, block.matrix.data());
    }

    penalised.clear();
    for (std::size_t dof = 0; dof < diagonal.size(); ++dof)
      if (diagonal[dof] != 0)
      {
        dof_penalty[dof] = diagonal[dof];
        penalised.push_back(dof);
      }
    nodes.set(node_blocks, hierarchy->finest(), hierarchy->levels.back().shared, parameters.truncation);
    cell_penalty = std::move(blocks);
    std::sort(cell_penalty.begin(), cell_penalty.end(), [](const auto &a, const auto &b) { return a.cell < b.cell; });
    has_penalty = hierarchy->processes().any(!cell_penalty.empty() || !nodes.empty() || !penalised.empty());
    couples_unknowns_of_cells = hierarchy->processes().any(!cell_penalty.empty());
    look_at_cells();
    for (unsigned l = levels.size() - 1; l > 0; --l)
      coarsen(l);
    for (unsigned l = 0; l < levels.size(); ++l)
      prepare_smoother(l);
    factorise_coarsest();
  }

  void Multigrid::look_at_cells()
  {
    const auto &op = hierarchy->finest();
    if (!has_penalty)
      return;
    for (const auto dof : penalised)
      flags[dof] = is_penalised | (truncated(dof) ? 0 : is_left);
    for (const auto &node : nodes.all())
      for (const auto dof : node.dofs)
        flags[dof] |= is_at_node;
    hand_on_flags();
    // What several processes have is taken to the coarser level by its owner.
    for (const auto dof : hierarchy->levels.back().shared.all())
      if (!hierarchy->levels.back().shared.owns(dof))
        flags[dof] |= is_taken;
    op.collect_flags(flags.data(), cell_flags.data());
    for (const auto &block : cell_penalty)
      cell_flags[block.cell] |= is_penalised | is_left;
    if (nodes.empty())
      return;
    std::vector<std::uint32_t> cells;
    for (std::size_t cell = 0; cell < cell_flags.size(); ++cell)
      if (cell_flags[cell] & is_at_node)
        cells.push_back(cell);
    nodes.prepare_smoother(op, cells, levels.back().sweep->positions());
    if (levels.size() > 1)
      nodes.connect(*hierarchy, levels[levels.size() - 2].sweep->positions());
  }

  void Multigrid::hand_on_flags()
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

  void Multigrid::truncate_dependent(const Dependence &dependence, double *const matrix) const
  {
    const auto &[masters, C] = dependence;
    const std::size_t m = masters.size(), n = C.size() / std::max<std::size_t>(m, 1);
    for (std::size_t i = 0; i < n; ++i)
    {
      double all = 0, left = 0;
      for (std::size_t j = 0; j < m; ++j)
      {
        const double weight = std::abs(C[i * m + j]);
        all += weight;
        left += truncated(masters[j]) ? 0 : weight;
      }
      if (left == all)
        continue;
      for (std::size_t j = 0; j < n; ++j)
      {
        matrix[i * n + j] *= left / all;
        matrix[j * n + i] *= left / all;
      }
    }
  }

  DenseBlock Multigrid::on_unknowns_of(const CellOperator &op, const std::size_t cell, const double *const M)
  {
    if (const DependentCell *const dependent = op.dependent(cell))
      return dependent->dependence.condense(M);
    const unsigned n = op.n_cell_dofs();
    DenseBlock     block{std::vector<std::uint32_t>(n), std::vector<double>(M, M + n * n)};
    op.cell_dofs(cell, block.dofs.data());
    return block;
  }

  void Multigrid::coarsen(const unsigned l)
  {
    const auto    &fine = levels[l];
    auto          &coarse = levels[l - 1];
    const bool     finest = l + 1 == levels.size();
    const unsigned n = fine.stiffness->n_cell_dofs();
    coarse.change.clear();
    coarse.changed_matrices.clear();
    if (!has_penalty)
      return;
    if (hierarchy->cut && l == hierarchy->cut->level)
    {
      gather_changes();
      collect_differences(l - 1);
      return;
    }

    coarse.change.assign(coarse.stiffness->n_cells(), unchanged);
    std::vector<std::uint32_t> dofs(n);
    Matrix                     child_matrix(n, n), sum(n, n);
    auto                       block = cell_penalty.begin();
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
          for (; block != cell_penalty.end() && block->cell <= cell; ++block)
            if (block->cell == cell)
              child_matrix += ConstMatrixMap(block->matrix.data(), n, n);
          const DependentCell *const dependent = fine.stiffness->dependent(cell);
          if (dependent)
            truncate_dependent(dependent->dependence, child_matrix.data());
          for (unsigned i = 0; i < n; ++i)
            if (dependent)
            {
              if ((flags[dofs[i]] & (is_penalised | is_taken)) == is_penalised && !truncated(dofs[i]))
              {
                flags[dofs[i]] |= is_taken;
                child_matrix(i, i) += dof_penalty[dofs[i]];
              }
            }
            else if (truncated(dofs[i]))
            {
              child_matrix.row(i).setZero();
              child_matrix.col(i).setZero();
            }
            else if ((flags[dofs[i]] & (is_penalised | is_taken)) == is_penalised)
            {
              flags[dofs[i]] |= is_taken;
              child_matrix(i, i) += dof_penalty[dofs[i]];
            }
            else if (flags[dofs[i]] & is_at_node && dofs[i] == nodes.all()[nodes.of_dof(dofs[i])].dofs[0])
            {
              // Once for each node: its components follow each other.
              const auto           &node = nodes.all()[nodes.of_dof(dofs[i])];
              const unsigned        k = node.dofs.size();
              std::vector<unsigned> at(k);
              for (unsigned a = 0; a < k; ++a)
                at[a] = std::find(dofs.begin(), dofs.end(), node.dofs[a]) - dofs.begin();
              const ConstMatrixMap free(node.free.data(), k, k), soft(node.soft.data(), k, k);
              const Matrix         rows = free * child_matrix(at, Eigen::all);
              child_matrix(at, Eigen::all) = rows;
              const Matrix columns = child_matrix(Eigen::all, at) * free;
              child_matrix(Eigen::all, at) = columns;
              if (!(flags[dofs[i]] & is_taken))
              {
                flags[dofs[i]] |= is_taken;
                child_matrix(at, at) += soft;
              }
            }
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

    collect_differences(l - 1);
  }

  void Multigrid::gather_changes()
  {
    const auto     &cut = *hierarchy->cut;
    const auto     &part = levels[cut.level];
    auto           &whole = levels[cut.level - 1];
    const Processes processes = part.shared.processes();
    const unsigned  n = part.stiffness->n_cell_dofs();
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
    whole.changed_matrices = processes.gather(own_matrices);
    whole.change.assign(whole.stiffness->n_cells(), unchanged);
    std::int32_t n_matrices = 0;
    for (const auto &[cell, vanishes] : processes.gather(own))
      whole.change[cell] = vanishes ? vanished : n_matrices++;
  }

  void Multigrid::collect_differences(const unsigned l)
  {
    auto                      &coarse = levels[l];
    const unsigned             n = coarse.stiffness->n_cell_dofs();
    std::vector<std::uint32_t> dofs(n);
    Matrix                     difference(n, n);
    const auto                 base = coarse.diagonal_on_cuts(hierarchy->levels[l].shared);
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
          const DenseBlock block = on_unknowns_of(*coarse.stiffness, cell, difference.data());
          add_to_diagonal(block.dofs, block.matrix.data());
          coarse.add_block(block.dofs, block.matrix.data());
          continue;
        }
        coarse.stiffness->cell_dofs(cell, dofs.data());
        add_to_diagonal(dofs, difference.data());
      }
    coarse.add_diagonal_of_others(hierarchy->levels[l].shared, base);
    // A vanished cell whose unknowns all have vanished needs no difference: nothing is solved for there.
    const auto &a_ii = coarse.stiffness->diagonal();
    for (std::size_t cell = 0; cell < coarse.change.size(); ++cell)
      if (const auto change = coarse.change[cell]; change != unchanged && !coarse.stiffness->dependent(cell))
      {
        coarse.stiffness->cell_dofs(cell, dofs.data());
        if (change == vanished &&
            std::all_of(dofs.begin(), dofs.end(), [&](const auto dof) { return coarse.diagonal[dof] <= negligible_energy * a_ii[dof]; }))
          continue;
        find_difference(cell);
        coarse.add_block(dofs, difference.data());
      }
  }

  void Multigrid::prepare_smoother(const unsigned l)
  {
    auto            &level = levels[l];
    const bool       finest = l + 1 == levels.size();
    const unsigned   n = level.stiffness->n_cell_dofs();
    const auto      &a_ii = level.stiffness->diagonal();
    const auto      &position = level.sweep->positions();
    ScaledEigenvalue eigenvalue;
    eigenvalue.largest = level.stiffness_eigenvalue;
    const auto look_at = [&](const std::size_t cell, const double *const matrix)
    {
      if (level.stiffness->dependent(cell))
      {
        const DenseBlock block = on_unknowns_of(*level.stiffness, cell, matrix);
        eigenvalue.look_at(block.matrix.data(), block.dofs.size());
      }
      else
        eigenvalue.look_at(matrix, n);
    };
    if (finest)
    {
      Matrix now(n, n);
      level.touched = penalised;
      for (const auto dof : penalised)
      {
        level.diagonal[dof] += dof_penalty[dof];
        level.penalty[position[dof]] = dof_penalty[dof];
        level.additions.batches[level.sweep->batch_of(position[dof])] |= PatchSweep::Additions::has_penalty;
      }
      for (const auto &node : nodes.all())
        for (unsigned a = 0; a < node.dofs.size(); ++a)
        {
          level.diagonal[node.dofs[a]] += node.penalty[a * (node.dofs.size() + 1)];
          level.touched.push_back(node.dofs[a]);
        }
      const auto base = level.diagonal_on_cuts(hierarchy->levels[l].shared);
      for (std::size_t k = 0; k < cell_penalty.size(); ++k)
      {
        const auto      &block = cell_penalty[k];
        const DenseBlock on_level = on_unknowns_of(*level.stiffness, block.cell, block.matrix.data());
        for (std::size_t i = 0; i < on_level.dofs.size(); ++i)
          level.diagonal[on_level.dofs[i]] += on_level.matrix[i * (on_level.dofs.size() + 1)];
        level.add_block(on_level.dofs, on_level.matrix.data());
        level.touched.insert(level.touched.end(), on_level.dofs.begin(), on_level.dofs.end());
        if (k % (1 + cell_penalty.size() / 4000) == 0)
        {
          level.stiffness->cell_matrix(block.cell, now.data());
          now += ConstMatrixMap(block.matrix.data(), n, n);
          look_at(block.cell, now.data());
        }
      }
      if (couples_unknowns_of_cells)
        level.add_diagonal_of_others(hierarchy->levels[l].shared, base);
    }
    else
    {
      const std::int32_t stride = 1 + level.changed_matrices.size() / (4000 * n * n);
      for (std::size_t cell = 0; cell < level.change.size(); ++cell)
        if (level.change[cell] >= 0 && level.change[cell] % stride == 0)
          look_at(cell, level.changed_matrices.data() + std::size_t(level.change[cell]) * n * n);
    }
    level.largest_eigenvalue = level.shared.processes().max(eigenvalue.largest);

    for (const auto dof : level.touched)
      if (!level.is_fixed[dof])
      {
        const bool dead = level.diagonal[dof] <= negligible_energy * a_ii[dof];
        level.inverse_diagonal[position[dof]] = dead ? 0 : 1 / level.diagonal[dof];
        level.receive(position[dof], dead || (finest && truncated(dof)) ? 0 : 1);
      }
    // Nodes are dealt with one by one.
    if (finest && l > 0)
      for (const auto &node : nodes.all())
        for (const auto dof : node.dofs)
        {
          level.inverse_diagonal[position[dof]] = 0;
          level.receive(position[dof], 0);
        }
    for (const auto place : level.block_positions)
      level.additions.batches[level.sweep->batch_of(place)] |= PatchSweep::Additions::has_terms;
    for (const auto place : level.shared.all())
      level.additions.batches[level.sweep->batch_of(place)] |= PatchSweep::Additions::has_terms;
    level.additions.penalty = level.penalty.empty() ? nullptr : level.penalty.data();
  }

  void Multigrid::factorise_coarsest()
  {
    auto               &level = levels[0];
    const CellOperator &op = *level.stiffness;
    const unsigned      n = op.n_cell_dofs();
    if (op.n_dofs() > parameters.largest_coarse)
      throw std::runtime_error("the coarse mesh is too large for geometric multigrid");
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<std::uint32_t>          dofs(n);
    const auto                         &position = level.sweep->positions();
    const auto                          alive = [&](const std::uint32_t dof) { return level.inverse_diagonal[position[dof]] != 0; };
    const auto                          add = [&](const std::uint32_t *const rows, const unsigned size, const auto *const matrix)
    {
      for (unsigned i = 0; i < size; ++i)
        for (unsigned j = 0; j < size; ++j)
          if (alive(rows[i]) && alive(rows[j]))
            entries.emplace_back(rows[i], rows[j], matrix[i * size + j]);
    };
    Matrix own(n, n);
    for (std::size_t cell = 0; cell < op.n_cells(); ++cell)
    {
      const auto                 change = level.change.empty() ? unchanged : level.change[cell];
      const double *const        now = change >= 0 ? level.changed_matrices.data() + std::size_t(change) * n * n : nullptr;
      const DependentCell *const dependent = op.dependent(cell);
      if (change == (dependent ? unchanged : vanished))
        continue;
      if (dependent)
      {
        // It is one of the blocks as it was.
        op.cell_matrix(cell, own.data());
        own = -own;
        if (now)
          own += ConstMatrixMap(now, n, n);
        const DenseBlock difference = dependent->dependence.condense(own.data());
        add(difference.dofs.data(), difference.dofs.size(), difference.matrix.data());
        continue;
      }
      op.cell_dofs(cell, dofs.data());
      if (!now)
        op.cell_matrix(cell, own.data());
      add(dofs.data(), n, now ? now : own.data());
    }
    for (const auto &block : op.further_blocks())
      add(block.dofs.data(), block.dofs.size(), block.matrix.data());
    if (levels.size() == 1)
      for (const auto &penalty : cell_penalty)
      {
        const DenseBlock block = on_unknowns_of(op, penalty.cell, penalty.matrix.data());
        add(block.dofs.data(), block.dofs.size(), block.matrix.data());
      }
    if (levels.size() == 1)
      for (const auto &node : nodes.all())
        add(node.dofs.data(), node.dofs.size(), node.penalty.data());
    for (std::size_t i = 0; i < op.n_dofs(); ++i)
      if (!alive(i))
        entries.emplace_back(i, i, 1.);
      else if (levels.size() == 1 && dof_penalty[i] != 0)
        entries.emplace_back(i, i, dof_penalty[i]);
      else if (!level.change.empty())
        // Truncation can make coarse functions of higher degree depend on each other.
        entries.emplace_back(i, i, 1e-5 * level.diagonal[i]);
    Eigen::SparseMatrix<double> matrix(op.n_dofs(), op.n_dofs());
    matrix.setFromTriplets(entries.begin(), entries.end());
    coarsest.compute(matrix);
    if (coarsest.info() != Eigen::Success)
      throw std::runtime_error("the linear system is singular");
  }

  void Multigrid::smooth(MultigridLevel &level, const bool from_zero)
  {
    // Chebyshev's iteration for the eigenvalues of diag^-1 A in [largest / range, largest], see Y. Saad, Iterative Methods, alg. 12.1.
    const double largest = level.largest_eigenvalue, smallest = largest / parameters.smoothing_range;
    const double theta = 0.5 * (largest + smallest), delta = 0.5 * (largest - smallest), sigma = theta / delta;
    double       rho = 1 / sigma;
    const bool   with_nodes = &level == &levels.back() && !nodes.empty();
    float *const __restrict x = level.x.data();
    const float *const __restrict b = level.b.data();
    const float *const __restrict inverse_diagonal = level.inverse_diagonal.data();
    for (unsigned k = 0; k < parameters.smoother_degree; ++k)
    {
      const double rho_next = k == 0 ? rho : 1 / (2 * sigma - rho);
      const float  keep = rho_next * rho, gain = k == 0 ? 1 / theta : 2 * rho_next / delta;
      rho = rho_next;
      if (k == 0 && from_zero)
      {
        for (std::size_t i = 0, n = level.x.size(); i < n; ++i)
          x[i] = gain * inverse_diagonal[i] * b[i];
        if (with_nodes)
        {
          nodes.keep_residual(b, nullptr, nullptr);
          nodes.smooth(x, nullptr, gain);
        }
        continue;
      }
      count_application(level);
      level.add_terms(x);
      if (with_nodes)
        nodes.keep_residual(b, x, level.terms.data());
      // The first step from zero is x itself.
      const float *const previous = k == 0 ? nullptr : k == 1 && from_zero ? x : level.step.data();
      float *const       step = k + 1 < parameters.smoother_degree ? level.step.data() : nullptr;
      level.sweep->smooth({x, previous, step, b, inverse_diagonal, keep, gain}, level.additions, level.terms.data());
      if (with_nodes)
        nodes.smooth(x, step, gain);
    }
  }

  void Multigrid::cycle(const unsigned l)
  {
    auto &level = levels[l];
    if (l == 0)
    {
      const auto     &position = level.sweep->positions();
      Eigen::VectorXd rhs(position.size());
      for (std::size_t i = 0; i < position.size(); ++i)
        rhs(i) = level.inverse_diagonal[position[i]] != 0 ? level.b[position[i]] : 0.f;
      const Eigen::VectorXd solution = coarsest.solve(rhs);
      for (std::size_t i = 0; i < position.size(); ++i)
        level.x[position[i]] = solution(i);
      return;
    }
    if (hierarchy->cut && l == hierarchy->cut->level)
    {
      solve_on_whole();
      return;
    }
    auto        &coarse = levels[l - 1];
    float *const x = level.x.data();
    const bool   with_nodes = l + 1 == levels.size() && !nodes.empty();
    smooth(level, true);
    count_application(level);
    level.add_terms(x);
    if (with_nodes)
      nodes.keep_residual(level.b.data(), x, level.terms.data());
    std::fill(coarse.b.begin(), coarse.b.end(), 0.f);
    level.sweep->restrict_residual(coarse.b.data(), level.b.data(), x, level.sends.data(), level.additions, level.terms.data(),
                                   level.step.data());
    if (with_nodes)
      nodes.restrict_residual(coarse.b.data());
    coarse.shared.add(coarse.b.data());
    cycle(l - 1);
    level.sweep->prolongate(x, coarse.x.data(), level.receives.data());
    if (with_nodes)
      nodes.prolongate(x, coarse.x.data());
    smooth(level, false);
  }

  void Multigrid::solve_on_whole()
  {
    const auto &cut = *hierarchy->cut;
    auto       &part = levels[cut.level], &whole = levels[cut.level - 1];
    const auto &in_part = part.sweep->positions(), &in_whole = whole.sweep->positions();
    std::fill(whole.b.begin(), whole.b.end(), 0.f);
    for (std::size_t i = 0; i < in_part.size(); ++i)
      if (part.shared.owns(in_part[i]))
        whole.b[in_whole[cut.to_whole[i]]] = part.b[in_part[i]];
    part.shared.processes().sum(whole.b.data(), whole.b.size());
    cycle(cut.level - 1);
    for (std::size_t i = 0; i < in_part.size(); ++i)
      part.x[in_part[i]] = whole.x[in_whole[cut.to_whole[i]]];
  }

  void Multigrid::vmult(double *const z, const double *const r)
  {
    auto       &finest = levels.back();
    const auto &position = finest.sweep->positions();
    // The residual of a solve may be too small for single precision.
    const std::size_t n = position.size();
    const double      scale = finest.shared.processes().max(largest_magnitude(r, n));
    if (scale == 0 || !std::isfinite(scale))
    {
      std::copy(r, r + n, z);
      return;
    }
    const double inverse_scale = 1 / scale;
    for (std::size_t i = 0; i < n; ++i)
      finest.b[position[i]] = r[i] * inverse_scale;
    cycle(levels.size() - 1);
    for (std::size_t i = 0; i < n; ++i)
      z[i] = scale * finest.x[position[i]];
    // Sums were rounded in different orders.
    hierarchy->levels.back().shared.take_from_owner(z);
  }

  void Multigrid::add_penalty(double *const y, const double *const x, const double factor) const
  {
    if (!has_penalty)
      return;
    for (const auto dof : penalised)
      y[dof] += factor * dof_penalty[dof] * x[dof];
    nodes.add(y, x, factor);
    if (!couples_unknowns_of_cells)
      return;
    // What others add to unknowns on cuts must arrive once.
    const auto                &shared = hierarchy->levels.back().shared;
    const bool                 several = !shared.processes().alone();
    std::vector<double>        sum(several ? dof_penalty.size() : 0, 0.);
    double *const              target = several ? sum.data() : y;
    const auto                &op = hierarchy->finest();
    std::vector<std::uint32_t> dofs(op.n_cell_dofs());
    const auto                 add = [&](const std::vector<std::uint32_t> &dofs, const double *matrix)
    {
      for (const auto row : dofs)
        for (const auto column : dofs)
          target[row] += factor * *matrix++ * x[column];
    };
    for (const auto &penalty : cell_penalty)
      if (op.dependent(penalty.cell))
      {
        const DenseBlock block = on_unknowns_of(op, penalty.cell, penalty.matrix.data());
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

  std::size_t Multigrid::memory() const
  {
    std::size_t bytes = 0;
    for (const auto &level : levels)
      bytes += level.stiffness->memory() + level.sweep->memory() + level.diagonal.size() * sizeof(double) +
               7 * level.x.size() * sizeof(float) + level.block_positions.size() * sizeof(std::uint32_t) +
               level.block_matrices.size() * sizeof(float) + level.changed_matrices.size() * sizeof(double);
    return bytes;
  }
} // namespace unilateral
