#include "unilateral/multigrid/gathered_system.h"

#include <algorithm>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    struct Entry
    {
      std::uint32_t row, column;
      double        value;
    };

    /// Equal places added up, in the order of rows and columns.
    std::vector<std::vector<std::pair<types::global_dof_index, double>>> sums(std::vector<Entry> entries, const std::size_t n_rows)
    {
      const auto before = [](const Entry &a, const Entry &b) { return std::pair(a.row, a.column) < std::pair(b.row, b.column); };
      std::stable_sort(entries.begin(), entries.end(), before); // rounding is the same everywhere
      std::vector<std::vector<std::pair<types::global_dof_index, double>>> rows(n_rows);
      for (const Entry &entry : entries)
        if (auto &row = rows[entry.row]; row.empty() || row.back().first != entry.column)
          row.emplace_back(entry.column, entry.value);
        else
          row.back().second += entry.value;
      return rows;
    }
  } // namespace

  GatheredSystem::GatheredSystem(const SparseMatrix<double> &own_A, const SparseRows &own_B, const SharedUnknowns &shared) : shared(shared)
  {
    const Processes &processes = shared.processes();
    n_unknowns = processes.sum(std::uint64_t(own_A.m() - shared.n_not_owned()));
    const auto numbers = shared.numbers_by_owner(own_A.m());
    number.assign(numbers.begin(), numbers.end());

    std::vector<Entry> entries;
    entries.reserve(own_A.n_nonzero_elements());
    for (std::size_t i = 0; i < own_A.m(); ++i)
      for (auto entry = own_A.begin(i); entry != own_A.end(i); ++entry)
        entries.push_back({number[i], number[entry->column()], entry->value()});
    {
      const auto rows = sums(processes.gather(entries), n_unknowns);
      pattern.copy_from(n_unknowns, n_unknowns, rows.begin(), rows.end());
      A.reinit(pattern);
      A.copy_from(rows.begin(), rows.end());
    }

    std::vector<std::uint32_t> lengths, columns;
    for (std::size_t i = 0; i < own_B.size(); ++i)
      lengths.push_back(own_B.row_start[i + 1] - own_B.row_start[i]);
    for (const auto column : own_B.columns)
      columns.push_back(number[column]);
    for (const std::uint32_t length : processes.gather(lengths))
      B.row_start.push_back(B.row_start.back() + length);
    const auto all_columns = processes.gather(columns);
    B.columns.assign(all_columns.begin(), all_columns.end());
    B.values = processes.gather(own_B.values);
    B.n_columns = n_unknowns;
  }

  void GatheredSystem::release_matrix()
  {
    A.clear();
    pattern.reinit(0, 0, 0);
  }

  void GatheredSystem::take_whole(const Vector &own, Vector &whole) const
  {
    whole.reinit(n_unknowns);
    for (std::size_t i = 0; i < number.size(); ++i)
      if (shared.owns(i))
        whole(number[i]) = own(i);
    shared.processes().sum(whole.begin(), n_unknowns);
  }

  void GatheredSystem::take_own(const Vector &whole, Vector &own) const
  {
    for (std::size_t i = 0; i < number.size(); ++i)
      own(i) = whole(number[i]);
  }

  Vector GatheredSystem::at_points(const Vector &own) const
  {
    const auto values = shared.processes().gather(std::vector<double>(own.begin(), own.end()));
    Vector     result(values.size());
    std::copy(values.begin(), values.end(), result.begin());
    return result;
  }
} // namespace unilateral
