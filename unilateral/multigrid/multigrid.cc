#include "unilateral/multigrid/multigrid.h"

#include "unilateral/multigrid/scaled_eigenvalue.h"

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
    : hierarchy(std::move(level_hierarchy)), parameters(parameters), penalty(hierarchy, parameters.truncation), coarse_operators(hierarchy)
  {
    for (const auto &level : hierarchy->levels)
      levels.emplace_back(*level.stiffness, *level.sweep, level.shared);
    levels.back().penalty.resize(levels.back().sweep->size(), 0.f);
  }

  void Multigrid::set_penalty(const std::vector<double>             &diagonal,
                              const std::vector<DenseBlock>         &node_blocks,
                              std::vector<TangentPenalty::CellBlock> cell_blocks)
  {
    auto &finest = levels.back();
    for (const auto dof : penalty.unknowns())
      finest.penalty[finest.sweep->positions()[dof]] = 0;
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
    penalty.set(diagonal, node_blocks, std::move(cell_blocks));
    coarse_operators.compute(penalty, levels);
    if (!penalty.nodes.empty())
    {
      penalty.nodes.prepare_smoother(hierarchy->finest(), coarse_operators.cells_at_nodes(), finest.sweep->positions());
      if (levels.size() > 1)
        penalty.nodes.connect(*hierarchy, levels[levels.size() - 2].sweep->positions());
    }
    for (unsigned l = 0; l < levels.size(); ++l)
      prepare_smoother(l);
    factorise_coarsest();
  }

  /// The largest eigenvalue of diag(A)^-1 A of what the cells of a level add to A now. Where very many have changed, of a sample.
  class Multigrid::CellEigenvalues
  {
  public:
    static constexpr std::size_t sample = 4000;

    explicit CellEigenvalues(const MultigridLevel &level) : level(level) { eigenvalue.largest = level.stiffness_eigenvalue; }

    double largest() const { return eigenvalue.largest; }

    void look_at(const std::size_t cell, const double *const matrix)
    {
      if (level.stiffness->dependent(cell))
      {
        const DenseBlock block = level.stiffness->contribution(cell, matrix);
        eigenvalue.look_at(block.matrix.data(), block.dofs.size());
      }
      else
        eigenvalue.look_at(matrix, level.stiffness->n_cell_dofs());
    }

    void look_at_changed_cells()
    {
      const std::size_t  size = std::size_t(level.stiffness->n_cell_dofs()) * level.stiffness->n_cell_dofs();
      const std::int32_t stride = 1 + level.changed_matrices.size() / (sample * size);
      for (std::size_t cell = 0; cell < level.change.size(); ++cell)
        if (level.change[cell] >= 0 && level.change[cell] % stride == 0)
          look_at(cell, level.changed_matrices.data() + std::size_t(level.change[cell]) * size);
    }

  private:
    const MultigridLevel &level;
    ScaledEigenvalue      eigenvalue;
  };

  void Multigrid::prepare_smoother(const unsigned l)
  {
    auto           &level = levels[l];
    const bool      finest = l + 1 == levels.size();
    CellEigenvalues eigenvalues(level);
    if (finest)
      add_penalty_to_finest(eigenvalues);
    else
      eigenvalues.look_at_changed_cells();
    level.largest_eigenvalue = level.shared.processes().max(eigenvalues.largest());
    invert_diagonal(level, finest);
    // Nodes are dealt with one by one.
    if (finest && l > 0)
      for (const auto &node : penalty.nodes.all())
        for (const auto dof : node.dofs)
        {
          const auto position = level.sweep->positions()[dof];
          level.inverse_diagonal[position] = 0;
          level.receive(position, 0);
        }
    for (const auto place : level.block_positions)
      level.additions.batches[level.sweep->batch_of(place)] |= PatchSweep::Additions::has_terms;
    for (const auto place : level.shared.all())
      level.additions.batches[level.sweep->batch_of(place)] |= PatchSweep::Additions::has_terms;
    level.additions.penalty = level.penalty.empty() ? nullptr : level.penalty.data();
  }

  /// To the diagonal, and to what products add.
  void Multigrid::add_penalty_to_finest(CellEigenvalues &eigenvalues)
  {
    auto       &level = levels.back();
    const auto &position = level.sweep->positions();
    level.touched = penalty.unknowns();
    for (const auto dof : penalty.unknowns())
    {
      level.diagonal[dof] += penalty.diagonal(dof);
      level.penalty[position[dof]] = penalty.diagonal(dof);
      level.additions.batches[level.sweep->batch_of(position[dof])] |= PatchSweep::Additions::has_penalty;
    }
    for (const auto &node : penalty.nodes.all())
      for (unsigned a = 0; a < node.dofs.size(); ++a)
      {
        level.diagonal[node.dofs[a]] += node.penalty[a * (node.dofs.size() + 1)];
        level.touched.push_back(node.dofs[a]);
      }
    const auto    &shared = hierarchy->levels.back().shared;
    const auto     base = level.diagonal_on_cuts(shared);
    const unsigned n = level.stiffness->n_cell_dofs();
    Matrix         now(n, n);
    for (std::size_t k = 0; k < penalty.cells().size(); ++k)
    {
      const auto      &block = penalty.cells()[k];
      const DenseBlock on_level = level.stiffness->contribution(block.cell, block.matrix.data());
      for (std::size_t i = 0; i < on_level.dofs.size(); ++i)
        level.diagonal[on_level.dofs[i]] += on_level.matrix[i * (on_level.dofs.size() + 1)];
      level.add_block(on_level.dofs, on_level.matrix.data());
      level.touched.insert(level.touched.end(), on_level.dofs.begin(), on_level.dofs.end());
      if (k % (1 + penalty.cells().size() / CellEigenvalues::sample) == 0)
      {
        level.stiffness->cell_matrix(block.cell, now.data());
        now += ConstMatrixMap(block.matrix.data(), n, n);
        eigenvalues.look_at(block.cell, now.data());
      }
    }
    if (penalty.couples_unknowns_of_cells())
      level.add_diagonal_of_others(shared, base);
  }

  /// Where it has changed; 0 where nothing is to be solved for.
  void Multigrid::invert_diagonal(MultigridLevel &level, const bool finest)
  {
    const auto &a_ii = level.stiffness->diagonal();
    const auto &position = level.sweep->positions();
    for (const auto dof : level.touched)
      if (!level.is_fixed[dof])
      {
        const bool dead = level.diagonal[dof] <= MultigridLevel::negligible_energy * a_ii[dof];
        level.inverse_diagonal[position[dof]] = dead ? 0 : 1 / level.diagonal[dof];
        level.receive(position[dof], dead || (finest && penalty.truncates(dof)) ? 0 : 1);
      }
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
      for (const auto &block_of_cell : penalty.cells())
      {
        const DenseBlock block = op.contribution(block_of_cell.cell, block_of_cell.matrix.data());
        add(block.dofs.data(), block.dofs.size(), block.matrix.data());
      }
    if (levels.size() == 1)
      for (const auto &node : penalty.nodes.all())
        add(node.dofs.data(), node.dofs.size(), node.penalty.data());
    for (std::size_t i = 0; i < op.n_dofs(); ++i)
      if (!alive(i))
        entries.emplace_back(i, i, 1.);
      else if (levels.size() == 1 && penalty.diagonal(i) != 0)
        entries.emplace_back(i, i, penalty.diagonal(i));
      else if (!level.change.empty())
        // Truncation can make coarse functions of higher degree depend on each other.
        entries.emplace_back(i, i, 1e-5 * level.diagonal[i]);
    Eigen::SparseMatrix<double> matrix(op.n_dofs(), op.n_dofs());
    matrix.setFromTriplets(entries.begin(), entries.end());
    coarsest.cholmod().print = 0;
    coarsest.cholmod().nmethods = 1; // METIS, which CHOLMOD would try as well, takes SIGTERM from the program and loses it
    coarsest.cholmod().method[0].ordering = CHOLMOD_AMD;
    coarsest.setMode(Eigen::CholmodSupernodalLLt);
    coarsest.compute(matrix);
    if (coarsest.info() != Eigen::Success) // a pivot that rounding has made negative
    {
      coarsest.setMode(Eigen::CholmodLDLt);
      coarsest.compute(matrix);
    }
    if (coarsest.info() != Eigen::Success)
      throw std::runtime_error("the linear system is singular");
  }

  void Multigrid::smooth(MultigridLevel &level, const bool from_zero)
  {
    // Chebyshev's iteration for the eigenvalues of diag^-1 A in [largest / range, largest], see Y. Saad, Iterative Methods, alg. 12.1.
    const double largest = level.largest_eigenvalue, smallest = largest / parameters.smoothing_range;
    const double theta = 0.5 * (largest + smallest), delta = 0.5 * (largest - smallest), sigma = theta / delta;
    double       rho = 1 / sigma;
    const bool   with_nodes = &level == &levels.back() && !penalty.nodes.empty();
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
          penalty.nodes.keep_residual(b, nullptr, nullptr);
          penalty.nodes.smooth(x, nullptr, gain);
        }
        continue;
      }
      count_application(level);
      level.add_terms(x);
      if (with_nodes)
        penalty.nodes.keep_residual(b, x, level.terms.data());
      // The first step from zero is x itself.
      const float *const previous = k == 0 ? nullptr : k == 1 && from_zero ? x : level.step.data();
      float *const       step = k + 1 < parameters.smoother_degree ? level.step.data() : nullptr;
      level.sweep->smooth({x, previous, step, b, inverse_diagonal, keep, gain}, level.additions, level.terms.data());
      if (with_nodes)
        penalty.nodes.smooth(x, step, gain);
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
    if (const auto *const cut = hierarchy->cut_at(l))
    {
      solve_on_whole(*cut);
      return;
    }
    auto        &coarse = levels[l - 1];
    float *const x = level.x.data();
    const bool   with_nodes = l + 1 == levels.size() && !penalty.nodes.empty();
    smooth(level, true);
    count_application(level);
    level.add_terms(x);
    if (with_nodes)
      penalty.nodes.keep_residual(level.b.data(), x, level.terms.data());
    std::fill(coarse.b.begin(), coarse.b.end(), 0.f);
    level.sweep->restrict_residual(coarse.b.data(), level.b.data(), x, level.sends.data(), level.additions, level.terms.data(),
                                   level.step.data());
    if (with_nodes)
      penalty.nodes.restrict_residual(coarse.b.data());
    coarse.shared.add(coarse.b.data());
    cycle(l - 1);
    level.sweep->prolongate(x, coarse.x.data(), level.receives.data());
    if (with_nodes)
      penalty.nodes.prolongate(x, coarse.x.data());
    smooth(level, false);
  }

  void Multigrid::solve_on_whole(const LevelHierarchy::Cut &cut)
  {
    auto       &part = levels[cut.level], &whole = levels[cut.level - 1];
    const auto &in_part = part.sweep->positions(), &in_whole = whole.sweep->positions();
    std::fill(whole.b.begin(), whole.b.end(), 0.f);
    for (const auto i : cut.contributed)
      whole.b[in_whole[cut.to_whole[i]]] = part.b[in_part[i]];
    cut.group.sum(whole.b.data(), whole.b.size());
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
