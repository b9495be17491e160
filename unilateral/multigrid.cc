#include "unilateral/multigrid.h"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace unilateral
{
  namespace
  {
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    using ConstMatrixMap = Eigen::Map<const Matrix>;

    /// What a cell adds to the level's own A_K, because of what is truncated or penalised below it.
    constexpr std::int32_t unchanged = -1, vanished = -2;

    /// A coarse function of which truncation leaves less than this part of its energy is left out: in single precision its row would be
    /// noise.
    constexpr double negligible_energy = 1e-3;

    /// y += G G' x at the components of a node.
    template <typename Number>
    void add_penalty_of(const std::vector<std::uint32_t> &dofs, const double *const G, const Number *const x, Number *const y)
    {
      const unsigned size = dofs.size();
      for (unsigned direction = 0; direction < size; ++direction)
      {
        Number along = 0;
        for (unsigned i = 0; i < size; ++i)
          along += Number(G[i * size + direction]) * x[dofs[i]];
        for (unsigned i = 0; i < size; ++i)
          y[dofs[i]] += Number(G[i * size + direction]) * along;
      }
    }

    /// The largest eigenvalue of diag(M)^-1 M over symmetric matrices M: that of the sum of all M is not larger.
    class ScaledEigenvalue
    {
    public:
      void look_at(const double *const entries, const unsigned n)
      {
        scale.resize(n);
        scaled = ConstMatrixMap(entries, n, n);
        for (unsigned i = 0; i < n; ++i)
          scale(i) = scaled(i, i) > 0 ? 1 / std::sqrt(scaled(i, i)) : 0;
        scaled = scale.asDiagonal() * scaled * scale.asDiagonal();
        // Eigenvalues are dear, and never larger than a row sum.
        if (scaled.cwiseAbs().rowwise().sum().maxCoeff() > largest)
          largest = std::max(largest, Eigen::SelfAdjointEigenSolver<Matrix>(scaled, Eigen::EigenvaluesOnly).eigenvalues()(n - 1));
      }

      double largest = 1;

    private:
      Matrix          scaled;
      Eigen::VectorXd scale;
    };

    double largest_scaled_eigenvalue(const CellOperator &op)
    {
      ScaledEigenvalue    eigenvalue;
      const unsigned      n = op.n_cell_dofs();
      std::vector<double> matrix(n * n);
      const auto          cells = op.representative_cells(2000);
      for (const auto cell : cells)
      {
        op.cell_matrix(cell, matrix.data());
        eigenvalue.look_at(matrix.data(), n);
      }
      const std::size_t stride = op.further_blocks().size() / 500 + 1;
      for (std::size_t k = 0; k < op.further_blocks().size(); k += stride)
        eigenvalue.look_at(op.further_blocks()[k].matrix.data(), op.further_blocks()[k].dofs.size());
      // A sample may miss the largest.
      return cells.size() > 1000 || stride > 1 ? 1.1 * eigenvalue.largest : eigenvalue.largest;
    }
  } // namespace

  struct Multigrid::Level
  {
    const CellOperator   *stiffness = nullptr;
    const Prolongation   *from_coarser = nullptr;
    const SharedUnknowns *shared = nullptr;
    std::vector<double>   stiffness_diagonal;
    double                stiffness_eigenvalue = 1; ///< largest of diag(A)^-1 A

    /// For each cell: unchanged, vanished (its matrix is zero now) or an entry of `changed_matrices`. Empty: all unchanged.
    std::vector<std::int32_t> change;
    std::vector<double>       changed_matrices; ///< in place of A_K

    /// The same as differences to A_K, to be added to A x.
    std::vector<std::uint32_t> difference_dofs;
    std::vector<float>         differences;

    std::vector<float> penalty;          ///< on the diagonal; empty: none
    std::vector<float> inverse_diagonal; ///< 0 where nothing is to be solved for
    std::vector<float> receives;         ///< 1 where coarse corrections go, else 0
    double             largest_eigenvalue = 1;
    std::vector<float> x, b, residual, step;
  };

  Multigrid::Multigrid(std::shared_ptr<const LevelHierarchy> level_hierarchy, const Parameters &parameters)
    : hierarchy(std::move(level_hierarchy)), parameters(parameters), levels(hierarchy->levels.size())
  {
    for (unsigned l = 0; l < levels.size(); ++l)
    {
      auto &level = levels[l];
      level.stiffness = hierarchy->levels[l].stiffness.get();
      level.from_coarser = &hierarchy->levels[l].from_coarser;
      level.shared = &hierarchy->levels[l].shared;
      level.stiffness_diagonal = level.stiffness->diagonal();
      level.shared->add(level.stiffness_diagonal.data());
      for (const auto dof : level.stiffness->fixed())
        level.stiffness_diagonal[dof] = 1;
      level.stiffness_eigenvalue = level.shared->processes().max(largest_scaled_eigenvalue(*level.stiffness));
      for (auto *const v : {&level.x, &level.b, &level.residual, &level.step, &level.inverse_diagonal, &level.receives})
        v->assign(level.stiffness->n_dofs(), 0);
    }
    dof_penalty.assign(hierarchy->finest().n_dofs(), 0);
  }

  Multigrid::~Multigrid() = default;

  void
  Multigrid::set_penalty(const std::vector<double> &diagonal, const std::vector<DenseBlock> &node_blocks, std::vector<CellBlock> blocks)
  {
    dof_penalty = diagonal;
    cell_penalty = std::move(blocks);
    std::sort(cell_penalty.begin(), cell_penalty.end(), [](const auto &a, const auto &b) { return a.cell < b.cell; });
    prepare_nodes(node_blocks);
    has_penalty =
      !cell_penalty.empty() || !nodes.empty() || std::any_of(diagonal.begin(), diagonal.end(), [](const double d) { return d != 0; });
    has_penalty = hierarchy->processes().any(has_penalty);
    couples_unknowns_of_cells = hierarchy->processes().any(!cell_penalty.empty());

    auto &finest = levels.back();
    finest.penalty.clear();
    if (has_penalty)
      finest.penalty.assign(dof_penalty.begin(), dof_penalty.end());
    finest.difference_dofs.clear();
    finest.differences.clear();
    std::vector<std::uint32_t> dofs(finest.stiffness->n_cell_dofs());
    for (const auto &block : cell_penalty)
    {
      finest.stiffness->cell_dofs(block.cell, dofs.data());
      finest.difference_dofs.insert(finest.difference_dofs.end(), dofs.begin(), dofs.end());
      finest.differences.insert(finest.differences.end(), block.matrix.begin(), block.matrix.end());
    }
    std::size_t n_at_nodes = 0;
    for (const auto &node : nodes)
      n_at_nodes += node.dofs.size();
    defect_at_nodes.resize(n_at_nodes);
    for (unsigned l = levels.size() - 1; l > 0; --l)
      coarsen(l);
    for (unsigned l = 0; l < levels.size(); ++l)
      prepare_smoother(l);
    factorise_coarsest();
  }

  void Multigrid::prepare_nodes(const std::vector<DenseBlock> &blocks)
  {
    const auto &diagonal = levels.back().stiffness_diagonal;
    nodes.clear();
    node_of_dof.clear();
    if (!blocks.empty())
      node_of_dof.assign(diagonal.size(), -1);
    for (const auto &block : blocks)
    {
      const unsigned k = block.dofs.size();
      Matrix         P = ConstMatrixMap(block.matrix.data(), k, k), with_stiffness = P, free = Matrix::Identity(k, k);
      double         stiffness = 0;
      for (unsigned i = 0; i < k; ++i)
      {
        with_stiffness(i, i) += diagonal[block.dofs[i]];
        stiffness += diagonal[block.dofs[i]] / k;
        node_of_dof[block.dofs[i]] = nodes.size();
      }
      const Eigen::SelfAdjointEigenSolver<Matrix> directions(P);
      for (unsigned i = 0; i < k; ++i)
        if (directions.eigenvalues()(i) > parameters.truncation * stiffness)
          free -= directions.eigenvectors().col(i) * directions.eigenvectors().col(i).transpose();
      const Matrix soft = free * P * free, inverse = with_stiffness.inverse(),
                   G = directions.eigenvectors() * directions.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
      nodes.push_back({block.dofs,
                       block.matrix,
                       {G.data(), G.data() + k * k},
                       {free.data(), free.data() + k * k},
                       {soft.data(), soft.data() + k * k},
                       {inverse.data(), inverse.data() + k * k}});
    }
  }

  void Multigrid::coarsen(const unsigned l)
  {
    const auto    &fine = levels[l];
    auto          &coarse = levels[l - 1];
    const bool     finest = l + 1 == levels.size();
    const unsigned n = fine.stiffness->n_cell_dofs(), n_children = hierarchy->n_children;
    coarse.change.clear();
    coarse.changed_matrices.clear();
    coarse.difference_dofs.clear();
    coarse.differences.clear();
    if (!has_penalty)
      return;
    if (hierarchy->cut && l == hierarchy->cut->level)
    {
      gather_changes();
      collect_differences(l - 1);
      return;
    }

    // On the finest level: how much of an unknown's diagonal penalty a cell takes, which unknowns are truncated.
    std::vector<char> penalty_taken, node_taken(nodes.size(), false);
    if (finest)
    {
      // What several processes have is taken by its owner.
      penalty_taken.assign(fine.stiffness->n_dofs(), false);
      for (std::size_t dof = 0; dof < penalty_taken.size(); ++dof)
        penalty_taken[dof] = !fine.shared->owns(dof);
      for (std::size_t k = 0; k < nodes.size(); ++k)
        node_taken[k] = !fine.shared->owns(nodes[k].dofs[0]);
    }
    const auto truncated = [&](const std::uint32_t dof) { return dof_penalty[dof] > parameters.truncation * fine.stiffness_diagonal[dof]; };

    coarse.change.assign(coarse.stiffness->n_cells(), unchanged);
    std::vector<std::uint32_t> dofs(n), live(n);
    Matrix                     child_matrix(n, n), sum(n, n);
    auto                       block = cell_penalty.begin();
    for (std::size_t parent = 0; parent < coarse.change.size(); ++parent)
    {
      bool any_changed = false, any_left = false;
      for (unsigned c = 0; c < n_children; ++c)
      {
        const std::size_t cell = parent * n_children + c;
        if (!finest)
        {
          any_changed |= fine.change.empty() ? false : fine.change[cell] != unchanged;
          any_left |= fine.change.empty() || fine.change[cell] != vanished;
          continue;
        }
        fine.stiffness->cell_dofs(cell, dofs.data());
        for (const auto dof : dofs)
        {
          any_changed |= dof_penalty[dof] != 0 || (!node_of_dof.empty() && node_of_dof[dof] >= 0);
          any_left |= !truncated(dof);
        }
        while (block != cell_penalty.end() && block->cell < cell)
          ++block;
        if (block != cell_penalty.end() && block->cell == cell)
          any_changed = any_left = true;
      }
      if (!any_changed)
        continue;
      if (!any_left)
      {
        coarse.change[parent] = vanished;
        continue;
      }
      sum.setZero();
      for (unsigned c = 0; c < n_children; ++c)
      {
        const std::size_t cell = parent * n_children + c;
        if (finest)
        {
          fine.stiffness->cell_dofs(cell, dofs.data());
          fine.stiffness->cell_matrix(cell, child_matrix.data());
          for (auto b = std::lower_bound(cell_penalty.begin(), cell_penalty.end(), cell,
                                         [](const CellBlock &entry, const std::size_t index) { return entry.cell < index; });
               b != cell_penalty.end() && b->cell == cell; ++b)
            child_matrix += ConstMatrixMap(b->matrix.data(), n, n);
          for (unsigned i = 0; i < n; ++i)
            if (truncated(dofs[i]))
            {
              child_matrix.row(i).setZero();
              child_matrix.col(i).setZero();
            }
            else if (dof_penalty[dofs[i]] != 0 && !penalty_taken[dofs[i]])
            {
              penalty_taken[dofs[i]] = true;
              child_matrix(i, i) += dof_penalty[dofs[i]];
            }
            else if (!node_of_dof.empty() && node_of_dof[dofs[i]] >= 0 && dofs[i] == nodes[node_of_dof[dofs[i]]].dofs[0])
            {
              // Once for each node: its components follow each other.
              const auto           &node = nodes[node_of_dof[dofs[i]]];
              const unsigned        k = node.dofs.size();
              std::vector<unsigned> at(k);
              for (unsigned a = 0; a < k; ++a)
                at[a] = std::find(dofs.begin(), dofs.end(), node.dofs[a]) - dofs.begin();
              const ConstMatrixMap free(node.free.data(), k, k), soft(node.soft.data(), k, k);
              const Matrix         rows = free * child_matrix(at, Eigen::all);
              child_matrix(at, Eigen::all) = rows;
              const Matrix columns = child_matrix(Eigen::all, at) * free;
              child_matrix(Eigen::all, at) = columns;
              if (!node_taken[node_of_dof[dofs[i]]])
              {
                node_taken[node_of_dof[dofs[i]]] = true;
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
        const ConstMatrixMap P(hierarchy->to_child[c].data(), n, n);
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
    const Processes processes = part.shared->processes();
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

    // A vanished cell whose unknowns all have vanished needs no difference: nothing is solved for there.
    std::vector<double> diagonal(coarse.stiffness->n_dofs(), 0.);
    Matrix              own(n, n);
    for (const bool collect : {false, true})
    {
      if (collect)
      {
        coarse.shared->add(diagonal.data());
        for (std::size_t i = 0; i < diagonal.size(); ++i)
          diagonal[i] += coarse.stiffness_diagonal[i];
      }
      for (std::size_t cell = 0; cell < coarse.change.size(); ++cell)
      {
        const auto change = coarse.change[cell];
        if (change == unchanged)
          continue;
        coarse.stiffness->cell_dofs(cell, dofs.data());
        coarse.stiffness->cell_matrix(cell, own.data());
        const double *const now = change >= 0 ? coarse.changed_matrices.data() + std::size_t(change) * n * n : nullptr;
        if (!collect)
        {
          for (unsigned i = 0; i < n; ++i)
            diagonal[dofs[i]] += (now ? now[i * (n + 1)] : 0.) - own(i, i);
          continue;
        }
        if (change == vanished &&
            std::all_of(dofs.begin(), dofs.end(),
                        [&](const auto dof) { return diagonal[dof] <= negligible_energy * coarse.stiffness_diagonal[dof]; }))
          continue;
        coarse.difference_dofs.insert(coarse.difference_dofs.end(), dofs.begin(), dofs.end());
        for (unsigned k = 0; k < n * n; ++k)
          coarse.differences.push_back((now ? now[k] : 0.) - own.data()[k]);
      }
    }
  }

  void Multigrid::prepare_smoother(const unsigned l)
  {
    auto               &level = levels[l];
    const bool          finest = l + 1 == levels.size();
    const unsigned      n = level.stiffness->n_cell_dofs();
    std::vector<double> diagonal(level.stiffness_diagonal.size(), 0.);

    // What has changed, as matrices of their own: for the diagonal and for the bound of the eigenvalues.
    std::vector<std::uint32_t> dofs(n);
    Matrix                     now(n, n);
    ScaledEigenvalue           eigenvalue;
    eigenvalue.largest = level.stiffness_eigenvalue;
    std::size_t n_seen = 0;
    const auto  look_at = [&](const double *const matrix)
    {
      if (n_seen++ % (1 + level.change.size() / 4000) == 0)
        eigenvalue.look_at(matrix, n);
    };
    if (finest)
      for (std::size_t k = 0; k < cell_penalty.size(); ++k)
      {
        level.stiffness->cell_dofs(cell_penalty[k].cell, dofs.data());
        for (unsigned i = 0; i < n; ++i)
          diagonal[dofs[i]] += cell_penalty[k].matrix[i * (n + 1)];
        level.stiffness->cell_matrix(cell_penalty[k].cell, now.data());
        now += ConstMatrixMap(cell_penalty[k].matrix.data(), n, n);
        look_at(now.data());
      }
    else
      for (std::size_t cell = 0; cell < level.change.size(); ++cell)
      {
        const auto change = level.change[cell];
        if (change == unchanged)
          continue;
        level.stiffness->cell_dofs(cell, dofs.data());
        level.stiffness->cell_matrix(cell, now.data());
        const double *const matrix = change >= 0 ? level.changed_matrices.data() + std::size_t(change) * n * n : nullptr;
        for (unsigned i = 0; i < n; ++i)
          diagonal[dofs[i]] += (matrix ? matrix[i * (n + 1)] : 0.) - now(i, i);
        if (matrix)
          look_at(matrix);
      }
    level.shared->add(diagonal.data());
    for (std::size_t i = 0; i < diagonal.size(); ++i)
      diagonal[i] += level.stiffness_diagonal[i] + (finest ? dof_penalty[i] : 0.);
    if (finest)
      for (const auto &node : nodes)
        for (unsigned a = 0; a < node.dofs.size(); ++a)
          diagonal[node.dofs[a]] += node.penalty[a * (node.dofs.size() + 1)];
    level.largest_eigenvalue = level.shared->processes().max(eigenvalue.largest);
    for (std::size_t i = 0; i < diagonal.size(); ++i)
    {
      const bool dead = diagonal[i] <= negligible_energy * level.stiffness_diagonal[i];
      level.inverse_diagonal[i] = dead ? 0 : 1 / diagonal[i];
      level.receives[i] = dead || (finest && dof_penalty[i] > parameters.truncation * level.stiffness_diagonal[i]) ? 0 : 1;
    }
    for (const auto dof : level.stiffness->fixed())
      level.inverse_diagonal[dof] = level.receives[dof] = 0;
    // Nodes are dealt with one by one.
    if (finest && l > 0)
      for (const auto &node : nodes)
        for (const auto dof : node.dofs)
          level.inverse_diagonal[dof] = level.receives[dof] = 0;
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
    const auto                          alive = [&](const std::uint32_t dof) { return level.inverse_diagonal[dof] != 0; };
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
      const auto change = level.change.empty() ? unchanged : level.change[cell];
      if (change == vanished)
        continue;
      op.cell_dofs(cell, dofs.data());
      if (change == unchanged)
        op.cell_matrix(cell, own.data());
      add(dofs.data(), n, change == unchanged ? own.data() : level.changed_matrices.data() + std::size_t(change) * n * n);
    }
    for (const auto &block : op.further_blocks())
      add(block.dofs.data(), block.dofs.size(), block.matrix.data());
    if (levels.size() == 1)
      for (const auto &block : cell_penalty)
      {
        op.cell_dofs(block.cell, dofs.data());
        add(dofs.data(), n, block.matrix.data());
      }
    if (levels.size() == 1)
      for (const auto &node : nodes)
        add(node.dofs.data(), node.dofs.size(), node.penalty.data());
    for (std::size_t i = 0; i < op.n_dofs(); ++i)
      if (!alive(i))
        entries.emplace_back(i, i, 1.);
      else if (levels.size() == 1 && dof_penalty[i] != 0)
        entries.emplace_back(i, i, dof_penalty[i]);
      else if (!level.change.empty())
        // Truncation can make coarse functions of higher degree depend on each other.
        entries.emplace_back(i, i, 1e-5 / level.inverse_diagonal[i]);
    Eigen::SparseMatrix<double> matrix(op.n_dofs(), op.n_dofs());
    matrix.setFromTriplets(entries.begin(), entries.end());
    coarsest.compute(matrix);
    if (coarsest.info() != Eigen::Success)
      throw std::runtime_error("the linear system is singular");
  }

  void Multigrid::apply(Level &level, float *y, const float *x)
  {
    level.stiffness->vmult(y, x);
    if (&level == &levels.back())
      ++fine_applications;
    const unsigned n = level.stiffness->n_cell_dofs();
    for (std::size_t k = 0; k < level.difference_dofs.size(); k += n)
    {
      const std::uint32_t *const dofs = level.difference_dofs.data() + k;
      const float *const         matrix = level.differences.data() + k * n;
      for (unsigned i = 0; i < n; ++i)
      {
        float sum = 0;
        for (unsigned j = 0; j < n; ++j)
          sum += matrix[i * n + j] * x[dofs[j]];
        y[dofs[i]] += sum;
      }
    }
    level.shared->add(y);
    if (!level.penalty.empty())
      for (std::size_t i = 0; i < level.penalty.size(); ++i)
        y[i] += level.penalty[i] * x[i];
    if (&level == &levels.back())
      for (const auto &node : nodes)
        add_penalty_of(node.dofs, node.factor.data(), x, y);
  }

  void Multigrid::smooth(Level &level, float *const __restrict x, const float *const __restrict b, const bool from_zero)
  {
    // Chebyshev's iteration for the eigenvalues of diag^-1 A in [largest / range, largest], see Y. Saad, Iterative Methods, alg. 12.1.
    const double largest = level.largest_eigenvalue, smallest = largest / parameters.smoothing_range;
    const double theta = 0.5 * (largest + smallest), delta = 0.5 * (largest - smallest), sigma = theta / delta;
    double       rho = 1 / sigma;
    float *const __restrict step = level.step.data();
    float *const __restrict Ax = level.residual.data();
    const float *const __restrict inverse_diagonal = level.inverse_diagonal.data();
    const std::size_t n = level.x.size();
    for (unsigned k = 0; k < parameters.smoother_degree; ++k)
    {
      const bool zero = k == 0 && from_zero;
      if (!zero)
        apply(level, Ax, x);
      const double rho_next = k == 0 ? rho : 1 / (2 * sigma - rho);
      const float  keep = k == 0 ? 0 : rho_next * rho, gain = k == 0 ? 1 / theta : 2 * rho_next / delta;
      rho = rho_next;
      // Where the diagonal of the preconditioner is a block instead: (b - A x) there, taken before x moves.
      const bool  with_nodes = &level == &levels.back() && !nodes.empty();
      std::size_t k_defect = 0;
      if (with_nodes)
        for (const auto &node : nodes)
          for (const auto dof : node.dofs)
            defect_at_nodes[k_defect++] = zero ? b[dof] : b[dof] - Ax[dof];
      if (zero)
        for (std::size_t i = 0; i < n; ++i)
          x[i] = step[i] = gain * inverse_diagonal[i] * b[i];
      else if (k == 0)
        for (std::size_t i = 0; i < n; ++i)
          x[i] += step[i] = gain * inverse_diagonal[i] * (b[i] - Ax[i]);
      else
        for (std::size_t i = 0; i < n; ++i)
          x[i] += step[i] = keep * step[i] + gain * inverse_diagonal[i] * (b[i] - Ax[i]);
      k_defect = 0;
      if (with_nodes)
        for (const auto &node : nodes)
        {
          const unsigned size = node.dofs.size();
          for (unsigned i = 0; i < size; ++i)
          {
            float sum = 0;
            for (unsigned j = 0; j < size; ++j)
              sum += node.inverse[i * size + j] * defect_at_nodes[k_defect + j];
            step[node.dofs[i]] += gain * sum;
            x[node.dofs[i]] += gain * sum;
          }
          k_defect += size;
        }
    }
  }

  void Multigrid::cycle(const unsigned l, float *x, const float *b)
  {
    auto &level = levels[l];
    if (l == 0)
    {
      Eigen::VectorXd rhs(level.x.size());
      for (std::size_t i = 0; i < level.x.size(); ++i)
        rhs(i) = level.inverse_diagonal[i] != 0 ? b[i] : 0.f;
      const Eigen::VectorXd solution = coarsest.solve(rhs);
      for (std::size_t i = 0; i < level.x.size(); ++i)
        x[i] = solution(i);
      return;
    }
    if (hierarchy->cut && l == hierarchy->cut->level)
    {
      solve_on_whole(x, b);
      return;
    }
    smooth(level, x, b, true);
    apply(level, level.residual.data(), x);
    auto             &coarse = levels[l - 1];
    const auto       &P = *level.from_coarser;
    float *const      coarse_b = coarse.b.data();
    float *const      coarse_x = coarse.x.data();
    const std::size_t n = level.x.size();
    std::fill(coarse.b.begin(), coarse.b.end(), 0.f);
    const auto restrict_entry = [&](const std::size_t i, const float r)
    {
      for (std::uint32_t k = P.row_start[i]; k < P.row_start[i + 1]; ++k)
        coarse_b[P.columns[k]] += P.values[k] * r;
    };
    const auto prolongate_entry = [&](const std::size_t i)
    {
      float sum = 0;
      for (std::uint32_t k = P.row_start[i]; k < P.row_start[i + 1]; ++k)
        sum += P.values[k] * coarse_x[P.columns[k]];
      return sum;
    };
    const auto &shared = *level.shared;
    for (std::size_t i = 0; i < n; ++i)
      if (shared.owns(i))
        restrict_entry(i, level.receives[i] * (b[i] - level.residual[i]));
    const bool with_nodes = l + 1 == levels.size();
    if (with_nodes)
      for (const auto &node : nodes)
        for (unsigned i = 0, size = node.dofs.size(); i < size; ++i)
        {
          float r = 0;
          for (unsigned j = 0; j < size; ++j)
            r += node.free[i * size + j] * (b[node.dofs[j]] - level.residual[node.dofs[j]]);
          if (shared.owns(node.dofs[i]))
            restrict_entry(node.dofs[i], r);
        }
    coarse.shared->add(coarse_b);
    cycle(l - 1, coarse_x, coarse_b);
    for (std::size_t i = 0; i < n; ++i)
      x[i] += level.receives[i] * prolongate_entry(i);
    if (with_nodes)
      for (const auto &node : nodes)
        for (unsigned j = 0, size = node.dofs.size(); j < size; ++j)
        {
          const float c = prolongate_entry(node.dofs[j]);
          for (unsigned i = 0; i < size; ++i)
            x[node.dofs[i]] += node.free[i * size + j] * c;
        }
    smooth(level, x, b, false);
  }

  void Multigrid::solve_on_whole(float *const x, const float *const b)
  {
    const auto &cut = *hierarchy->cut;
    const auto &part = levels[cut.level];
    auto       &whole = levels[cut.level - 1];
    std::fill(whole.b.begin(), whole.b.end(), 0.f);
    for (std::size_t i = 0; i < cut.to_whole.size(); ++i)
      if (part.shared->owns(i))
        whole.b[cut.to_whole[i]] = b[i];
    part.shared->processes().sum(whole.b.data(), whole.b.size());
    cycle(cut.level - 1, whole.x.data(), whole.b.data());
    for (std::size_t i = 0; i < cut.to_whole.size(); ++i)
      x[i] = whole.x[cut.to_whole[i]];
  }

  void Multigrid::vmult(double *z, const double *r)
  {
    auto &finest = levels.back();
    // The residual of a solve may be too small for single precision.
    const std::size_t n = finest.x.size();
    double            scale = 0;
    for (std::size_t i = 0; i < n; ++i)
      scale = std::max(scale, std::abs(r[i]));
    scale = finest.shared->processes().max(scale);
    if (scale == 0 || !std::isfinite(scale))
    {
      std::copy(r, r + n, z);
      return;
    }
    for (std::size_t i = 0; i < n; ++i)
      finest.b[i] = r[i] / scale;
    cycle(levels.size() - 1, finest.x.data(), finest.b.data());
    for (std::size_t i = 0; i < n; ++i)
      z[i] = scale * finest.x[i];
  }

  void Multigrid::add_penalty(double *y, const double *x) const
  {
    if (!has_penalty)
      return;
    for (std::size_t i = 0; i < dof_penalty.size(); ++i)
      y[i] += dof_penalty[i] * x[i];
    for (const auto &node : nodes)
      add_penalty_of(node.dofs, node.factor.data(), x, y);
    const auto                &op = hierarchy->finest();
    const unsigned             n = op.n_cell_dofs();
    std::vector<std::uint32_t> dofs(n);
    if (!couples_unknowns_of_cells)
      return;
    // What others add to unknowns on cuts must arrive once.
    const bool          several = !hierarchy->processes().alone();
    std::vector<double> sum(several ? op.n_dofs() : 0, 0.);
    double *const       target = several ? sum.data() : y;
    for (const auto &block : cell_penalty)
    {
      op.cell_dofs(block.cell, dofs.data());
      for (unsigned i = 0; i < n; ++i)
        for (unsigned j = 0; j < n; ++j)
          target[dofs[i]] += block.matrix[i * n + j] * x[dofs[j]];
    }
    levels.back().shared->add(sum.data());
    for (std::size_t i = 0; i < sum.size(); ++i)
      y[i] += sum[i];
  }

  std::size_t Multigrid::memory() const
  {
    std::size_t bytes = 0;
    for (const auto &level : levels)
      bytes += level.stiffness->memory() + level.stiffness_diagonal.size() * sizeof(double) + 6 * level.x.size() * sizeof(float) +
               level.penalty.size() * sizeof(float) + level.differences.size() * sizeof(float) +
               level.difference_dofs.size() * sizeof(std::uint32_t) + level.changed_matrices.size() * sizeof(double) +
               level.from_coarser->columns.size() * 8 + level.from_coarser->row_start.size() * 4;
    return bytes;
  }
} // namespace unilateral
