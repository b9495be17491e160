#include "unilateral/algebra/sparse_cholesky.h"

#include "unilateral/algebra/equal_rows.h"

#include <cholmod.h>

#include <algorithm>
#include <csignal>
#include <stdexcept>

// Of the OpenMP library that CHOLMOD is linked with. Its header belongs to the compiler, and not every one has it.
extern "C" int  omp_get_max_active_levels();
extern "C" void omp_set_max_active_levels(int);

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Calls @p action(column, value) for the entries of row @p i up to the diagonal, in the order of their columns.
    template <typename Action>
    void for_each_entry_up_to_diagonal(const SparseMatrix<double> &matrix, const std::size_t i, const Action &action)
    {
      // The diagonal comes first in a row, the others follow by column.
      for (auto entry = matrix.begin(i); entry != matrix.end(i); ++entry)
        if (entry->column() < i)
          action(entry->column(), entry->value());
      action(i, matrix.diag_element(i));
    }

    std::vector<bool> rows_without_coupling(const SparseMatrix<double> &matrix)
    {
      std::vector<bool> result(matrix.m(), true);
      for (std::size_t i = 0; i < matrix.m(); ++i)
        for (auto entry = matrix.begin(i); entry != matrix.end(i); ++entry)
          if (entry->column() != i && entry->value() != 0)
          {
            result[i] = false;
            break;
          }
      return result;
    }

    /// METIS catches SIGTERM and SIGABRT while it works, and does not put handlers back as they were: they would serve once. SIGTERM had
    /// better be blocked: its handler jumps out of what it interrupts, whatever lock that holds (cli/interrupt.cc).
    class HandlersOfSignals
    {
    public:
      HandlersOfSignals()
      {
        sigaction(SIGTERM, nullptr, &on_term);
        sigaction(SIGABRT, nullptr, &on_abort);
      }

      ~HandlersOfSignals()
      {
        sigaction(SIGTERM, &on_term, nullptr);
        sigaction(SIGABRT, &on_abort, nullptr);
      }

      HandlersOfSignals(const HandlersOfSignals &) = delete;
      HandlersOfSignals &operator=(const HandlersOfSignals &) = delete;

    private:
      struct sigaction on_term = {}, on_abort = {};
    };

    /// CHOLMOD's loops start four threads each, on any number of processors, for less work than that takes: not while this lives.
    class OneThread
    {
    public:
      OneThread() : levels(omp_get_max_active_levels()) { omp_set_max_active_levels(0); }
      ~OneThread() { omp_set_max_active_levels(levels); }
      OneThread(const OneThread &) = delete;
      OneThread &operator=(const OneThread &) = delete;

    private:
      const int levels;
    };
  } // namespace

  /// The handles of CHOLMOD, with indices of 64 bits: factors of large systems have more entries than 32 bits count.
  struct SparseCholesky::Cholmod
  {
    mutable cholmod_common common;
    cholmod_sparse        *upper = nullptr; ///< of T
    cholmod_factor        *factor = nullptr;
    mutable cholmod_dense *x = nullptr, *work_y = nullptr, *work_e = nullptr; ///< of solve()

    Cholmod()
    {
      cholmod_l_start(&common);
      common.print = 0;
      common.supernodal = CHOLMOD_SUPERNODAL;
      common.try_catch = 1;
    }

    ~Cholmod()
    {
      for (cholmod_dense **const dense : {&x, &work_y, &work_e})
        cholmod_l_free_dense(dense, &common);
      cholmod_l_free_factor(&factor, &common);
      cholmod_l_free_sparse(&upper, &common);
      cholmod_l_finish(&common);
    }

    Cholmod(const Cholmod &) = delete;
    Cholmod &operator=(const Cholmod &) = delete;

    void check_memory() const
    {
      if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE)
        throw std::runtime_error("the linear system is too large for the direct solver");
    }

    void check() const
    {
      check_memory();
      if (common.status < CHOLMOD_OK)
        throw std::runtime_error("the direct solver failed");
    }

    /// Which of the groups comes when.
    std::vector<SuiteSparse_long> order_of_elimination(const EqualRows &groups, const Order how)
    {
      const std::size_t     n_entries = groups.columns.size();
      cholmod_sparse *const graph = cholmod_l_allocate_sparse(groups.n(), groups.n(), n_entries, true, true, 1, CHOLMOD_REAL, &common);
      check();
      std::copy(groups.column_starts.begin(), groups.column_starts.end(), static_cast<SuiteSparse_long *>(graph->p));
      std::copy(groups.columns.begin(), groups.columns.end(), static_cast<SuiteSparse_long *>(graph->i));
      std::fill_n(static_cast<double *>(graph->x), n_entries, 1.);
      return how == Order::nested_dissection ? order_by_nested_dissection(graph) : order_by_minimum_degree(graph);
    }

    /// Frees @p graph.
    std::vector<SuiteSparse_long> order_by_minimum_degree(cholmod_sparse *graph)
    {
      std::vector<SuiteSparse_long> order(graph->nrow);
      const bool                    succeeded = cholmod_l_amd(graph, nullptr, 0, order.data(), &common);
      cholmod_l_free_sparse(&graph, &common);
      check();
      if (!succeeded)
        throw std::runtime_error("the order of elimination was not found");
      return order;
    }

    /// Frees @p graph.
    std::vector<SuiteSparse_long> order_by_nested_dissection(cholmod_sparse *graph)
    {
      std::vector<SuiteSparse_long> order(graph->nrow);
      bool                          succeeded = false;
      {
        const HandlersOfSignals restored_afterwards;
        succeeded = cholmod_l_metis(graph, nullptr, 0, /*postorder=*/true, order.data(), &common);
      }
      cholmod_l_free_sparse(&graph, &common);
      if (succeeded)
        return order;
      check_memory();
      // METIS has most likely caught SIGTERM itself and given up: whoever waits for the signal gets it now.
      struct sigaction on_term = {};
      sigaction(SIGTERM, nullptr, &on_term);
      if (on_term.sa_handler != SIG_DFL)
        std::raise(SIGTERM);
      throw std::runtime_error("the order of elimination was not found");
    }

    /// The entries that upper has. False: the matrix has others that are not zero.
    bool copy_values(const SparseMatrix<double> &matrix)
    {
      bool complete = true;
      for (std::size_t i = 0; i < n(); ++i)
      {
        // The entries stored are a part of the row, in the same order.
        SuiteSparse_long next = columns()[i];
        for_each_entry_up_to_diagonal(matrix, i,
                                      [&](const std::size_t j, const double value)
                                      {
                                        if (next < columns()[i + 1] && rows()[next] == SuiteSparse_long(j))
                                          values()[next++] = value;
                                        else
                                          complete = complete && value == 0;
                                      });
      }
      return complete;
    }

    /// One of the systems of CHOLMOD; @p b and @p result may be the same.
    void solve(const int system, const double *const b, double *const result) const
    {
      cholmod_dense rhs{};
      rhs.nrow = rhs.nzmax = rhs.d = n();
      rhs.ncol = 1;
      rhs.x = const_cast<double *>(b);
      rhs.xtype = CHOLMOD_REAL;
      rhs.dtype = CHOLMOD_DOUBLE;
      const OneThread meanwhile;
      cholmod_l_solve2(system, factor, &rhs, nullptr, &x, nullptr, &work_y, &work_e, &common);
      check();
      std::copy_n(static_cast<const double *>(x->x), n(), result);
    }

    /// The upper triangle, its values ones; of rows that are @p decoupled the diagonal alone.
    cholmod_sparse *pattern(const SparseMatrix<double> &matrix, const std::vector<bool> &decoupled)
    {
      // Row i of the lower triangle is column i of the upper one.
      const auto for_each_stored = [&](const std::size_t i, const auto &action)
      {
        for_each_entry_up_to_diagonal(matrix, i,
                                      [&](const std::size_t j, double)
                                      {
                                        if (i == j || (!decoupled[i] && !decoupled[j]))
                                          action(j);
                                      });
      };
      const std::size_t n_rows = matrix.m();
      std::size_t       n_entries = 0;
      for (std::size_t i = 0; i < n_rows; ++i)
        for_each_stored(i, [&](std::size_t) { ++n_entries; });
      cholmod_sparse *const result = cholmod_l_allocate_sparse(n_rows, n_rows, n_entries, true, true, 1, CHOLMOD_REAL, &common);
      check();
      auto *const column = static_cast<SuiteSparse_long *>(result->p), *const row = static_cast<SuiteSparse_long *>(result->i);
      SuiteSparse_long next = 0;
      for (std::size_t i = 0; i < n_rows; ++i)
      {
        column[i] = next;
        for_each_stored(i, [&](const std::size_t j) { row[next++] = j; });
      }
      column[n_rows] = next;
      std::fill_n(static_cast<double *>(result->x), n_entries, 1.);
      return result;
    }

    std::size_t       n() const { return upper->nrow; }
    SuiteSparse_long *columns() const { return static_cast<SuiteSparse_long *>(upper->p); }
    SuiteSparse_long *rows() const { return static_cast<SuiteSparse_long *>(upper->i); }
    double           *values() const { return static_cast<double *>(upper->x); }
  };

  SparseCholesky::SparseCholesky(const SparseMatrix<double> &matrix, const std::vector<types::global_dof_index> &last, const Order order)
    : order(order), last(last)
  {
    analyse(matrix);
  }

  void SparseCholesky::analyse(const SparseMatrix<double> &matrix)
  {
    auto                    analysed = std::make_unique<Cholmod>();
    const std::vector<bool> decoupled = rows_without_coupling(matrix);
    analysed->upper = analysed->pattern(matrix, decoupled);

    // The others in an order of what they make among themselves; those that come last stay together at the end.
    std::vector<bool> kept(matrix.m(), true);
    for (const auto i : last)
      kept[i] = false;
    std::vector<SuiteSparse_long> elimination;
    if (last.size() < matrix.m())
    {
      const EqualRows groups(matrix, kept, decoupled);
      for (const SuiteSparse_long g : analysed->order_of_elimination(groups, order))
        elimination.insert(elimination.end(), groups.rows.begin() + groups.starts[g], groups.rows.begin() + groups.starts[g + 1]);
    }
    elimination.insert(elimination.end(), last.begin(), last.end());

    analysed->common.nmethods = 1;
    analysed->common.method[0].ordering = CHOLMOD_GIVEN;
    analysed->common.postorder = last.empty(); // the last are to stay where they are
    analysed->factor = cholmod_l_analyze_p(analysed->upper, elimination.data(), nullptr, 0, &analysed->common);
    analysed->check();
    data = std::move(analysed);
  }

  SparseCholesky::~SparseCholesky() = default;

  double SparseCholesky::predicted_entries() const
  {
    return std::max<double>(data->common.lnz, data->factor->xsize);
  }

  double SparseCholesky::predicted_operations() const
  {
    return data->common.fl;
  }

  void SparseCholesky::factorise(const SparseMatrix<double> &matrix, const Additions &to_diagonal)
  {
    if (!data->copy_values(matrix))
    {
      analyse(matrix); // it couples rows that were not coupled
      data->copy_values(matrix);
    }
    for (const auto &[i, value] : to_diagonal)
      data->values()[data->columns()[i + 1] - 1] += value; // the diagonal ends the column of an upper triangle
    const OneThread meanwhile;
    cholmod_l_factorize(data->upper, data->factor, &data->common);
    data->check();
    if (data->common.status == CHOLMOD_NOT_POSDEF || data->factor->minor < data->n())
      throw NotPositiveDefinite("the linear system is singular, or not positive definite");
  }

  void SparseCholesky::forward(const double *const b, double *const z) const
  {
    data->solve(CHOLMOD_P, b, z);
    data->solve(CHOLMOD_L, z, z);
  }

  void SparseCholesky::backward(const double *const z, double *const x) const
  {
    data->solve(CHOLMOD_Lt, z, x);
    data->solve(CHOLMOD_Pt, x, x);
  }

  Eigen::MatrixXd SparseCholesky::last_block() const
  {
    const cholmod_factor    &L = *data->factor;
    const auto *const        first_column = static_cast<const SuiteSparse_long *>(L.super),
                      *const first_row = static_cast<const SuiteSparse_long *>(L.pi),
                      *const first_value = static_cast<const SuiteSparse_long *>(L.px),
                      *const row = static_cast<const SuiteSparse_long *>(L.s);
    const auto *const        value = static_cast<const double *>(L.x);
    const SuiteSparse_long   n_last = last.size(), begin = data->n() - n_last;
    Eigen::MatrixXd          block = Eigen::MatrixXd::Zero(n_last, n_last);
    for (SuiteSparse_long s = L.nsuper - 1; s >= 0 && first_column[s + 1] > begin; --s)
    {
      const SuiteSparse_long n_rows = first_row[s + 1] - first_row[s];
      for (SuiteSparse_long j = std::max(first_column[s], begin); j < first_column[s + 1]; ++j)
      {
        const double *const column = value + first_value[s] + (j - first_column[s]) * n_rows;
        // The rows of a supernode begin with its own columns; what lies above the diagonal there means nothing.
        for (SuiteSparse_long k = j - first_column[s]; k < n_rows; ++k)
          block(row[first_row[s] + k] - begin, j - begin) = column[k];
      }
    }
    return block;
  }
} // namespace unilateral
