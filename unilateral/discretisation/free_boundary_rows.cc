#include "unilateral/discretisation/free_boundary_rows.h"

#include "unilateral/algebra/symmetric_block_matrix.h"

#include <algorithm>

namespace unilateral
{
  namespace
  {
    constexpr unsigned      nodes_around = 4;
    constexpr std::uint32_t none = -1;

    /// Bits of an unknown or of all in a cell: it is seen by a point in contact, by another one, belongs to the neighbourhood.
    constexpr unsigned char in_contact = 1, free = 2, near = 4;

    /// For each unknown what the points that see it are.
    std::vector<unsigned char> flag_unknowns(const ConstraintTrace &B, const std::vector<bool> &active, const std::size_t n_dofs)
    {
      std::vector<unsigned char> flags(n_dofs, 0);
      for (std::size_t i = 0; i < B.n_points(); ++i)
        for (std::size_t k = B.row_start[i]; k < B.row_start[i + 1]; ++k)
          flags[B.columns[k]] |= active[i] ? in_contact : free;
      return flags;
    }

    /// The place of each unknown in rows.unknowns.
    std::vector<std::uint32_t> number_unknowns(LocalRows &rows, const std::vector<unsigned char> &flags)
    {
      std::vector<std::uint32_t> number(flags.size(), none);
      for (std::size_t dof = 0; dof < flags.size(); ++dof)
        if (flags[dof] & near)
        {
          number[dof] = rows.unknowns.size();
          rows.unknowns.push_back(dof);
        }
      return number;
    }

    /// Unknowns on cuts take part on all processes where one wants it, unless a point sees them together with others: who holds those does
    /// not know all of its rows.
    void agree_on_cuts(std::vector<unsigned char>       &flags,
                       const ConstraintTrace            &B,
                       const SharedUnknowns             &shared,
                       const std::vector<std::uint32_t> &incomplete = {})
    {
      if (shared.processes().alone())
        return;
      std::vector<double> wanted(flags.size(), 0.), barred(flags.size(), 0.);
      for (const auto dof : incomplete)
      {
        flags[dof] &= static_cast<unsigned char>(~near);
        barred[dof] = 1;
      }
      for (const auto dof : shared.all())
        wanted[dof] = flags[dof] & near ? 1 : 0;
      for (std::size_t i = 0; i < B.n_points(); ++i)
      {
        const auto begin = B.columns.begin() + B.row_start[i], end = B.columns.begin() + B.row_start[i + 1];
        const auto is_shared = [&](const auto dof) { return shared.shares(dof); };
        if (std::any_of(begin, end, is_shared) && !std::all_of(begin, end, is_shared))
          for (auto dof = begin; dof != end; ++dof)
            barred[*dof] = 1;
      }
      shared.add(wanted.data());
      shared.add(barred.data());
      for (const auto dof : shared.all())
        flags[dof] = wanted[dof] > 0 && barred[dof] == 0 ? flags[dof] | near : flags[dof] & ~near;
    }

    void take_points(LocalRows &rows, const ConstraintTrace &B, const std::vector<unsigned char> &flags)
    {
      for (std::size_t i = 0; i < B.n_points(); ++i)
      {
        const auto begin = B.columns.begin() + B.row_start[i], end = B.columns.begin() + B.row_start[i + 1];
        if (std::none_of(begin, end, [&](const auto dof) { return flags[dof] & near; }))
          continue;
        rows.points.push_back(i);
        rows.B.columns.insert(rows.B.columns.end(), begin, end);
        rows.B.values.insert(rows.B.values.end(), B.values.begin() + B.row_start[i], B.values.begin() + B.row_start[i + 1]);
        rows.B.start.push_back(rows.B.columns.size());
      }
    }

    /// Entries of a row that have the same column become one.
    void merge_columns(LocalRows::Rows &rows, const std::size_t n_columns)
    {
      std::vector<std::size_t> place(n_columns, 0); // where the column was last put, plus one
      std::size_t              size = 0;
      for (std::size_t row = 0; row + 1 < rows.start.size(); ++row)
      {
        const std::size_t begin = size, first = rows.start[row], end = rows.start[row + 1];
        rows.start[row] = begin;
        for (std::size_t k = first; k < end; ++k)
          if (auto &at = place[rows.columns[k]]; at > begin)
            rows.values[at - 1] += rows.values[k];
          else
          {
            rows.columns[size] = rows.columns[k];
            rows.values[size] = rows.values[k];
            at = ++size;
          }
      }
      rows.start.back() = size;
      rows.columns.resize(size);
      rows.values.resize(size);
    }

    /// Whole blocks of cells, the descendants of one, in which the flags of all cells together have the bits of @p wanted.
    std::vector<std::size_t>
    blocks_with(const std::vector<unsigned char> &cell_flags, const std::size_t cells_per_block, const unsigned char wanted)
    {
      std::vector<std::size_t> blocks;
      for (std::size_t begin = 0; begin < cell_flags.size(); begin += cells_per_block)
      {
        unsigned char all = 0;
        for (std::size_t cell = begin; cell < begin + cells_per_block; ++cell)
          all |= cell_flags[cell];
        if ((all & wanted) == wanted)
          blocks.push_back(begin);
      }
      return blocks;
    }
  } // namespace

  LocalRows rows_near_free_boundary(const LevelHierarchy &hierarchy, const ConstraintTrace &B, const std::vector<bool> &active)
  {
    const auto                &op = hierarchy.finest();
    const unsigned             n = op.n_cell_dofs();
    std::vector<std::uint32_t> dofs(n);
    std::size_t                cells_per_block = 1;
    unsigned                   width = 1; // of a block, in cells
    for (unsigned k = 0; width < nodes_around && k < hierarchy.refinements_of_all_cells(); width *= 2, ++k)
      cells_per_block *= hierarchy.n_children;

    auto                       flags = flag_unknowns(B, active, op.n_dofs());
    std::vector<unsigned char> cell_flags(op.n_cells());
    const auto                 mark_blocks = [&](const unsigned char wanted)
    {
      op.collect_flags(flags.data(), cell_flags.data());
      for (const std::size_t begin : blocks_with(cell_flags, cells_per_block, wanted))
        for (std::size_t cell = begin; cell < begin + cells_per_block; ++cell)
        {
          op.cell_dofs(cell, dofs.data());
          for (const auto dof : dofs)
            flags[dof] |= near;
        }
    };
    mark_blocks(in_contact | free);
    mark_blocks(near);
    // Where cells have ancestors of their own, or the part has been refined once or not at all, the neighbourhood grows by small blocks.
    if (!hierarchy.places.empty() || !hierarchy.cuts.empty())
      for (unsigned layer = std::max(width, 2u); layer < nodes_around; ++layer)
        mark_blocks(near);
    for (const auto dof : op.fixed())
      flags[dof] = 0;
    const SharedUnknowns &shared = hierarchy.levels.back().shared;
    agree_on_cuts(flags, B, shared);
    op.collect_flags(flags.data(), cell_flags.data());

    LocalRows  rows;
    const auto number = number_unknowns(rows, flags);
    if (rows.unknowns.empty())
      return rows;
    take_points(rows, B, flags);

    // Rows as their cells have them, one cell behind the other.
    std::vector<double> matrix(n * n);
    rows.A.start.assign(rows.unknowns.size() + 1, 0);
    auto next = rows.A.start;
    for (const bool fill : {false, true})
    {
      const auto add = [&](const std::vector<std::uint32_t> &dofs, const double *const matrix)
      {
        for (std::size_t i = 0; i < dofs.size(); ++i)
          if (const auto row = number[dofs[i]]; row != none && !fill)
            rows.A.start[row + 1] += dofs.size();
          else if (row != none)
            for (std::size_t j = 0; j < dofs.size(); ++j)
            {
              rows.A.columns[next[row]] = dofs[j];
              rows.A.values[next[row]++] = matrix[i * dofs.size() + j];
            }
      };
      if (fill)
      {
        for (std::size_t row = 0; row < rows.unknowns.size(); ++row)
          rows.A.start[row + 1] += rows.A.start[row];
        next = rows.A.start;
        rows.A.columns.resize(rows.A.start.back());
        rows.A.values.resize(rows.A.start.back());
      }
      for (std::size_t cell = 0; cell < op.n_cells(); ++cell)
        if (cell_flags[cell] & near && !op.dependent(cell)) // whose rows are among the blocks
        {
          op.cell_dofs(cell, dofs.data());
          if (fill)
            op.cell_matrix(cell, matrix.data());
          add(dofs, matrix.data());
        }
      for (const auto &block : op.further_blocks())
        add(block.dofs, block.matrix.data());
    }
    merge_columns(rows.A, op.n_dofs());
    return rows;
  }

  template <typename Matrix>
  LocalRows rows_near_free_boundary(const Matrix                     &A,
                                    const ConstraintTrace            &B,
                                    const std::vector<bool>          &active,
                                    const SharedUnknowns             &shared,
                                    const std::vector<std::uint32_t> &incomplete)
  {
    auto                       flags = flag_unknowns(B, active, A.m());
    const auto                 seen = flags;
    std::vector<std::uint32_t> layer, next;
    const auto                 take = [&](const std::uint32_t dof)
    {
      if (!(flags[dof] & near))
      {
        flags[dof] |= near;
        next.push_back(dof);
      }
    };
    for (std::uint32_t dof = 0; dof < A.m(); ++dof)
      if (seen[dof] != 0)
      {
        unsigned char all = 0;
        for_each_in_row(A, dof, [&](const std::size_t column, double) { all |= seen[column]; });
        if (all == (in_contact | free))
          take(dof);
      }
    for (unsigned k = 0; k < nodes_around; ++k)
    {
      layer.swap(next);
      next.clear();
      for (const auto dof : layer)
        for_each_in_row(A, dof, [&](const std::size_t column, double) { take(column); });
    }
    agree_on_cuts(flags, B, shared, incomplete);

    LocalRows rows;
    number_unknowns(rows, flags);
    if (rows.unknowns.empty())
      return rows;
    take_points(rows, B, flags);
    for (const auto dof : rows.unknowns)
    {
      for_each_in_row(A, dof,
                      [&](const std::size_t column, const double value)
                      {
                        rows.A.columns.push_back(column);
                        rows.A.values.push_back(value);
                      });
      rows.A.start.push_back(rows.A.columns.size());
    }
    return rows;
  }

  template LocalRows rows_near_free_boundary(const dealii::SparseMatrix<double> &,
                                             const ConstraintTrace &,
                                             const std::vector<bool> &,
                                             const SharedUnknowns &,
                                             const std::vector<std::uint32_t> &);
  template LocalRows rows_near_free_boundary(const SymmetricBlockMatrix &,
                                             const ConstraintTrace &,
                                             const std::vector<bool> &,
                                             const SharedUnknowns &,
                                             const std::vector<std::uint32_t> &);
} // namespace unilateral
