#include "unilateral/multigrid/galerkin_multigrid.h"

#include "unilateral/algebra/linear_solver.h"
#include "unilateral/algebra/sparse_cholesky.h"
#include "unilateral/multigrid/gathered_system.h"
#include "unilateral/multigrid/shared_gauss_seidel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace unilateral
{
  using namespace dealii;
  using types::global_dof_index;

  namespace
  {
    using Entries = std::vector<std::pair<global_dof_index, double>>;

    /// Aggregation goes on until so few unknowns are left, and ends where it leaves more than this part of them.
    constexpr std::size_t small_enough = 3000;
    constexpr double      largest_part = 0.7;

    /// A row of a product that is added up entry by entry.
    class SparseSum
    {
    public:
      explicit SparseSum(const std::size_t n) : place(n, -1) {}

      void add(const global_dof_index column, const double value)
      {
        if (place[column] < 0)
        {
          place[column] = entries.size();
          entries.emplace_back(column, 0.);
        }
        entries[place[column]].second += value;
      }

      /// Leaves it empty.
      Entries take_sorted()
      {
        for (const auto &[column, value] : entries)
          place[column] = -1;
        std::sort(entries.begin(), entries.end());
        return std::exchange(entries, {});
      }

    private:
      std::vector<int> place;
      Entries          entries;
    };

    /// P'AP row by row; one on the diagonal where a column of P is empty. Matrix: a SparseMatrix or a SymmetricBlockMatrix.
    template <typename Matrix>
    std::vector<Entries> galerkin_product(const Matrix &A, const OwnSparseRows &P)
    {
      std::vector<Entries> columns_of_P(P.n_columns), product(P.n_columns);
      for (std::size_t i = 0; i < P.size(); ++i)
        for (std::size_t k = P.row_start[i]; k < P.row_start[i + 1]; ++k)
          columns_of_P[P.columns[k]].emplace_back(i, P.values[k]);
      SparseSum row(P.n_columns);
      for (std::size_t I = 0; I < P.n_columns; ++I)
      {
        for (const auto &column_entry : columns_of_P[I])
          for_each_in_row(A, column_entry.first,
                          [&, weight = column_entry.second](const std::size_t j, const double a)
                          {
                            for (std::size_t l = P.row_start[j]; l < P.row_start[j + 1]; ++l)
                              row.add(P.columns[l], weight * a * P.values[l]);
                          });
        product[I] = row.take_sorted();
        if (product[I].empty())
          product[I].emplace_back(I, 1.);
      }
      return product;
    }

    /// BP
    OwnSparseRows product(const SparseRows &B, const OwnSparseRows &P)
    {
      OwnSparseRows result;
      result.n_columns = P.n_columns;
      SparseSum row(P.n_columns);
      for (std::size_t i = 0; i < B.size(); ++i)
      {
        for (std::size_t k = B.row_start[i]; k < B.row_start[i + 1]; ++k)
          for (std::size_t l = P.row_start[B.columns[k]]; l < P.row_start[B.columns[k] + 1]; ++l)
            row.add(P.columns[l], B.values[k] * P.values[l]);
        for (const auto &[column, value] : row.take_sorted())
        {
          result.columns.push_back(column);
          result.values.push_back(value);
        }
        result.row_start.push_back(result.columns.size());
      }
      return result;
    }

    /// Spaces that are nearly as large as the one before are passed over, as refinement in places makes them.
    std::vector<OwnSparseRows> without_small_steps(std::vector<OwnSparseRows> prolongations)
    {
      std::vector<OwnSparseRows> result;
      for (OwnSparseRows &P : prolongations)
        if (result.empty() || result.back().n_columns <= largest_part * result.back().size())
          result.push_back(std::move(P));
        else
          result.back() = product(result.back().rows(), P);
      return result;
    }
  } // namespace

  GalerkinMultigrid::GalerkinMultigrid(SymmetricBlockMatrix       A,
                                       const SparseRows          &B,
                                       std::vector<OwnSparseRows> prolongations,
                                       Parameters                 parameters)
    : B(B), parameters(std::move(parameters)), n_entries(A.n_nonzero_elements()), modes_of_coarsest(this->parameters.near_null_space)
  {
    const bool several = !this->parameters.shared.empty() && !this->parameters.shared[0].processes().alone();
    levels.push_back(std::make_unique<Level>());
    levels[0]->in_blocks = std::move(A);
    levels[0]->block_size = this->parameters.block_size;
    if (several)
      levels[0]->shared = this->parameters.shared[0];
    for (auto &P : several ? std::move(prolongations) : without_small_steps(std::move(prolongations)))
      add_level(std::move(P));
    if (levels.size() == 1)
      levels[0]->in_blocks.copy_to(levels[0]->pattern, levels[0]->A);
    AggregationParameters aggregation;
    if (several)
    {
      if (n_unknowns(*levels.back()) > this->parameters.largest_gathered)
        while (n_unknowns(*levels.back()) > small_enough && add_aggregated_level(aggregation))
        {
        }
      if (levels.size() == 1)
        make_smoother(0);
      gather_coarsest();
    }
    else
    {
      if (levels.size() > 1 || this->parameters.may_factorise_finest)
        choose_coarse_solver();
      while (!cholesky && add_aggregated_level(aggregation))
        if (levels.back()->A.m() <= small_enough)
          choose_coarse_solver();
      if (levels.size() == 1 && !cholesky)
        make_smoother(0);
      if (!cholesky)
        make_coarse_amg();
    }
    for (const auto &level : levels)
      for (std::vector<float> *const v : {&level->r, &level->x, &level->rest})
        v->resize(level->smoother ? level->in_blocks.m() : level->A.m());
    for (Vector *const v : {&coarse_r, &coarse_x})
      v->reinit(levels.back()->A.m());
  }

  GalerkinMultigrid::~GalerkinMultigrid() = default;

  void GalerkinMultigrid::add_level(OwnSparseRows P)
  {
    const auto l = levels.size() - 1;
    auto      &level = *levels.emplace_back(std::make_unique<Level>());
    {
      const auto entries = l == 0 ? galerkin_product(levels[l]->in_blocks, P) : galerkin_product(levels[l]->A, P);
      level.pattern.copy_from(P.n_columns, P.n_columns, entries.begin(), entries.end());
      level.A.reinit(level.pattern);
      level.A.copy_from(entries.begin(), entries.end());
    }
    level.B = product(rows(l), P);
    level.block_size = parameters.block_size;
    if (!parameters.shared.empty())
      level.shared = parameters.shared[l + 1];
    levels[l]->P = std::move(P);
    make_smoother(l);
  }

  bool GalerkinMultigrid::add_aggregated_level(AggregationParameters &aggregation)
  {
    const std::size_t           l = levels.size() - 1;
    const SparseMatrix<double> &finer = levels[l]->A;
    AggregatedSpace             space = aggregated_space(finer, levels[l]->block_size, modes_of_coarsest, aggregation, levels[l]->shared);
    const std::uint64_t         n_owned = space.P.n_coarse() - space.shared.n_not_owned(), n = levels[l]->shared.processes().sum(n_owned);
    if (n == 0 || double(n) > largest_part * double(n_unknowns(*levels[l])))
      return false;
    auto &level = *levels.emplace_back(std::make_unique<Level>());
    galerkin_product(finer, space.P, level.pattern, level.A);
    level.B = product(rows(l), space.P);
    level.block_size = space.P.n_columns;
    level.shared = std::move(space.shared);
    levels[l]->aggregates = std::move(space.P);
    make_smoother(l);
    modes_of_coarsest = std::move(space.near_null_space);
    aggregation.threshold /= 2; // connections of aggregates are weaker
    return true;
  }

  /// The matrix in blocks takes the place of that in rows, which a single level needs for its coarse solver, too.
  void GalerkinMultigrid::make_smoother(const std::size_t l)
  {
    Level &level = *levels[l];
    if (l > 0)
      level.in_blocks = SymmetricBlockMatrix(level.A, level.block_size);
    if (levels.size() > 1)
    {
      level.A.clear();
      level.pattern.reinit(0, 0, 0);
    }
    level.smoother = std::make_unique<SharedGaussSeidel>(level.in_blocks, rows(l), level.shared);
  }

  std::uint64_t GalerkinMultigrid::n_unknowns(const Level &coarsest)
  {
    return coarsest.shared.processes().sum(std::uint64_t(coarsest.A.m() - coarsest.shared.n_not_owned()));
  }

  void GalerkinMultigrid::gather_coarsest()
  {
    Level           &coarsest = *levels.back();
    const Processes &processes = coarsest.shared.processes();
    gathered = std::make_unique<GatheredSystem>(coarsest.A, rows(levels.size() - 1), coarsest.shared);
    std::vector<Vector> modes(modes_of_coarsest.size());
    for (std::size_t k = 0; k < modes.size(); ++k)
      gathered->take_whole(modes_of_coarsest[k], modes[k]);
    const double         ratio = processes.sum(double(n_entries)) / std::max<std::size_t>(gathered->matrix().n_nonzero_elements(), 1);
    SymmetricBlockMatrix whole(gathered->matrix(), coarsest.block_size);
    gathered->release_matrix();
    on_whole = std::make_unique<GalerkinMultigrid>(std::move(whole), gathered->rows(), std::vector<OwnSparseRows>(),
                                                   Parameters{.block_size = coarsest.block_size,
                                                              .near_null_space = std::move(modes),
                                                              .operations_per_entry = parameters.operations_per_entry * ratio,
                                                              .changed_part = parameters.changed_part,
                                                              .may_factorise_finest = true,
                                                              .shared = {}});
  }

  void GalerkinMultigrid::choose_coarse_solver()
  {
    try
    {
      auto factorisation = std::make_unique<SparseCholesky>(levels.back()->A);
      if (factorisation->predicted_operations() <= parameters.operations_per_entry * n_entries)
        cholesky = std::move(factorisation);
    }
    catch (const std::runtime_error &) // too large
    {
    }
  }

  void GalerkinMultigrid::make_coarse_amg()
  {
    amg = std::make_unique<LinearSolver>(LinearSolver::Parameters{
      .method = LinearSolver::Method::amg, .near_null_space = modes_of_coarsest, .block_size = levels.back()->block_size});
  }

  std::string GalerkinMultigrid::description() const
  {
    const unsigned n_processes = levels[0]->shared.processes().size();
    if (levels.size() == 1 && on_whole)
      return fmt::format("{}, which every process has, between sweeps of Gauss-Seidel that {} processes share", on_whole->description(),
                         n_processes);
    if (on_whole)
      return fmt::format("multigrid with assembled matrices on {} levels, divided among {} processes, of which the coarsest, {} unknowns, "
                         "every process has: {}",
                         levels.size(), n_processes, gathered->size(), on_whole->description());
    if (levels.size() == 1)
      return cholesky ? "a factorisation" : "algebraic multigrid";
    return fmt::format("multigrid with assembled matrices on {} levels, of which the coarsest, {} unknowns, {}", levels.size(),
                       coarse_x.size(), cholesky ? "is factorised" : "takes algebraic multigrid");
  }

  void GalerkinMultigrid::set_diagonal(const Vector &d)
  {
    for (const auto &level : levels)
      if (level->smoother)
        level->smoother->set_diagonal(d);
    if (on_whole)
      on_whole->set_diagonal(gathered->at_points(d));
    else if (!coarse_solver_serves(d))
      set_up_coarse_solver(d);
  }

  bool GalerkinMultigrid::coarse_solver_serves(const Vector &d) const
  {
    if (setups == 0)
      return false;
    std::size_t n_active = 0, n_changed = 0;
    for (std::size_t i = 0; i < d.size(); ++i)
    {
      n_active += d(i) != 0;
      n_changed += d(i) > 2 * d_of_coarse_solver(i) || d_of_coarse_solver(i) > 2 * d(i);
    }
    return n_changed <= parameters.changed_part * n_active;
  }

  void GalerkinMultigrid::set_up_coarse_solver(const Vector &d)
  {
    ++setups;
    d_of_coarse_solver = d;
    const Level         &coarsest = *levels.back();
    SparseMatrix<double> T(coarsest.pattern);
    T.copy_from(coarsest.A);
    add_penalty(T, rows(levels.size() - 1), d);
    is_factorised = false;
    if (cholesky)
      try
      {
        cholesky->factorise(T);
        is_factorised = true;
        return;
      }
      catch (const NotPositiveDefinite &) // by rounding: nothing but contact may hold a body, and this set does not
      {
        if (!amg)
          make_coarse_amg();
      }
    amg->set_matrix(T);
  }

  void GalerkinMultigrid::vmult(Vector &x, const Vector &r) const
  {
    const double size = levels[0]->shared.processes().max(r.size() > 0 ? r.linfty_norm() : 0.);
    if (!(size > 0))
    {
      x = 0.;
      return;
    }
    const Level &finest = *levels[0];
    if (!finest.smoother)
    {
      coarse_r = r;
      solve_on_coarsest();
      x = coarse_x;
      return;
    }
    const std::size_t   n = r.size();
    const double *const r_of = r.begin();
    double *const       x_of = x.begin();
    for (std::size_t j = 0; j < n; ++j)
      finest.r[j] = float(r_of[j] / size);
    v_cycle(0);
    const double factor = size / finest.smoother->scale();
    for (std::size_t j = 0; j < n; ++j)
      x_of[j] = factor * finest.x[j];
    if (on_whole)
      finest.shared.take_from_owner(x_of); // to the last bit
  }

  /// Smoothers divide T_l by scale(): x is that much larger.
  void GalerkinMultigrid::v_cycle(const std::size_t l) const
  {
    const Level             &level = *levels[l];
    const SharedGaussSeidel &smoother = *level.smoother;
    const std::size_t        n = level.x.size();
    smoother.first_sweep(level.r.data(), level.x.data(), level.rest.data());
    if (levels.size() == 1)
    {
      level.shared.add(level.rest.data());
      std::copy(level.rest.begin(), level.rest.end(), coarse_r.begin());
      solve_on_coarsest();
      for (std::size_t i = 0; i < n; ++i)
        level.x[i] += float(smoother.scale() * coarse_x(i));
    }
    else
    {
      const Level        &coarser = *levels[l + 1];
      const bool          coarsest = l + 2 == levels.size();
      std::vector<float> &coarser_r = coarser.r, &coarser_x = coarser.x;
      restrict(level, coarser_r);
      coarser.shared.add(coarser_r.data());
      if (coarsest)
      {
        std::copy(coarser_r.begin(), coarser_r.end(), coarse_r.begin());
        solve_on_coarsest();
        for (std::size_t i = 0; i < coarser_x.size(); ++i)
          coarser_x[i] = float(smoother.scale() * coarse_x(i));
      }
      else
        v_cycle(l + 1);
      prolongate(coarser_x, coarsest ? 1.F : float(smoother.scale() / coarser.smoother->scale()), level);
    }
    smoother.backward_sweep(level.r.data(), level.x.data(), level.rest.data());
  }

  void GalerkinMultigrid::restrict(const Level &level, std::vector<float> &coarser)
  {
    if (level.aggregates.n_aggregates > 0)
      return level.aggregates.restrict(level.rest.data(), coarser.data());
    const OwnSparseRows &P = level.P;
    std::fill(coarser.begin(), coarser.end(), 0.F);
    for (std::size_t i = 0; i < P.size(); ++i)
      for (std::size_t k = P.row_start[i]; k < P.row_start[i + 1]; ++k)
        coarser[P.columns[k]] += float(P.values[k]) * level.rest[i];
  }

  void GalerkinMultigrid::prolongate(const std::vector<float> &coarser, const float factor, const Level &level)
  {
    if (level.aggregates.n_aggregates > 0)
      return level.aggregates.prolongate(coarser.data(), factor, level.x.data());
    const OwnSparseRows &P = level.P;
    for (std::size_t i = 0; i < P.size(); ++i)
    {
      float correction = 0;
      for (std::size_t k = P.row_start[i]; k < P.row_start[i + 1]; ++k)
        correction += float(P.values[k]) * coarser[P.columns[k]];
      level.x[i] += factor * correction;
    }
  }

  void GalerkinMultigrid::solve_on_coarsest() const
  {
    if (on_whole)
    {
      gathered->take_whole(coarse_r, whole_r);
      whole_x.reinit(whole_r, /*omit_zeroing_entries=*/true);
      on_whole->vmult(whole_x, whole_r);
      return gathered->take_own(whole_x, coarse_x);
    }
    if (!is_factorised)
      return amg->precondition(coarse_x, coarse_r);
    cholesky->forward(coarse_r.begin(), coarse_x.begin());
    cholesky->backward(coarse_x.begin(), coarse_x.begin());
  }
} // namespace unilateral
