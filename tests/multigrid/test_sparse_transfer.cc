// A coarse V_H in a finer V_h where only some cells were refined: what the rows reproduce, and which have none.
#include "unilateral/multigrid/cell_operator.h"
#include "unilateral/multigrid/sparse_transfer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{
  using namespace unilateral;

  /// Value at x of the Lagrange polynomial of node j of 0, 1/p, ..., 1.
  double lagrange(const unsigned p, const unsigned j, const double x)
  {
    double value = 1;
    for (unsigned k = 0; k <= p; ++k)
      if (k != j)
        value *= (x * p - k) / (double(j) - k);
    return value;
  }

  /// Five cells [0, 1], ..., [4, 5] of degree p, of which the second and the fourth are halved.
  struct Segments
  {
    explicit Segments(const unsigned p, std::vector<DependentCell> dependent = {})
      : n(p + 1), coarse(5 * p + 1,
                         std::vector<CellOperator::PatchGroup>{{shape(), 5}},
                         [p](const std::size_t cell, std::uint32_t *dofs) { number(cell, p, dofs); },
                         matrices_of(dependent),
                         std::vector<double>(n * n, 1.),
                         dependent,
                         {},
                         {})
    {
      to_child.assign(2, {});
      for (unsigned child : {0, 1})
        for (unsigned i = 0; i <= p; ++i)
          for (unsigned j = 0; j <= p; ++j)
            to_child[child].push_back(lagrange(p, j, (child + double(i) / p) / 2));
      dofs_of_cells.resize(7 * n);
      for (unsigned cell = 0; cell < 7; ++cell)
        number(cell, p, dofs_of_cells.data() + cell * n);
      for (unsigned i = 0; i <= 7 * p; ++i)
      {
        const double of_cells = double(i) / p, left[] = {0, 1, 1.5, 2, 3, 3.5, 4, 5};
        const int    cell = std::min<int>(of_cells, 6);
        x_fine.push_back(left[cell] + (of_cells - cell) * (left[cell + 1] - left[cell]));
      }
    }

    SparseTransfer transfer(const std::vector<bool> &is_free) const
    {
      return transfer_in_places(coarse, to_child, {{0, 1, 3, 4, 6}, {true, false, true, false, true}}, dofs_of_cells, is_free);
    }

    static void number(const std::size_t cell, const unsigned p, std::uint32_t *const dofs)
    {
      for (unsigned i = 0; i <= p; ++i)
        dofs[i] = cell * p + i;
    }

    static std::vector<std::int32_t> matrices_of(const std::vector<DependentCell> &dependent)
    {
      std::vector<std::int32_t> id(5, 0);
      for (const auto &cell : dependent)
        id[cell.cell] = -1;
      return id;
    }

    PatchShape shape() const
    {
      PatchShape shape{n, n, 1, {}};
      for (unsigned i = 0; i < n; ++i)
        shape.cell_dofs.push_back(i);
      return shape;
    }

    unsigned                         n;
    CellOperator                     coarse;
    std::vector<std::vector<double>> to_child;
    std::vector<std::uint32_t>       dofs_of_cells;
    std::vector<double>              x_fine;
  };

  double row_times(const SparseTransfer &transfer, const unsigned row, const std::vector<double> &v)
  {
    double sum = 0;
    for (unsigned k = transfer.row_start[row]; k < transfer.row_start[row + 1]; ++k)
      sum += transfer.weights[k] * v[transfer.columns[k]];
    return sum;
  }
} // namespace

TEST(SparseTransfer, reproduces_polynomials_of_the_degree)
{
  for (const unsigned p : {1, 2, 3, 4})
  {
    const Segments       segments(p);
    const SparseTransfer transfer = segments.transfer(std::vector<bool>(7 * p + 1, true));
    ASSERT_EQ(transfer.row_start.size(), 7 * p + 2);
    for (unsigned power = 0; power <= p; ++power)
    {
      std::vector<double> coarse;
      for (unsigned i = 0; i <= 5 * p; ++i)
        coarse.push_back(std::pow(double(i) / p, power));
      for (unsigned i = 0; i <= 7 * p; ++i)
        EXPECT_NEAR(row_times(transfer, i, coarse), std::pow(segments.x_fine[i], power), 1e-6 * std::pow(5, power)) << p << ' ' << i;
    }
  }
}

TEST(SparseTransfer, a_cell_that_stays_keeps_its_functions)
{
  const Segments       segments(2);
  const SparseTransfer transfer = segments.transfer(std::vector<bool>(15, true));
  for (const auto &[fine, coarse] : {std::pair(0u, 0u), {1, 1}, {2, 2}, {4, 3}, {6, 4}, {7, 5}, {14, 10}})
  {
    ASSERT_EQ(transfer.row_start[fine + 1] - transfer.row_start[fine], 1u) << fine;
    EXPECT_EQ(transfer.columns[transfer.row_start[fine]], coarse);
    EXPECT_EQ(transfer.weights[transfer.row_start[fine]], 1);
  }
}

TEST(SparseTransfer, what_is_not_free_has_no_row)
{
  const Segments    segments(1);
  std::vector<bool> is_free(8, true);
  is_free[0] = is_free[5] = false;
  const SparseTransfer transfer = segments.transfer(is_free);
  for (unsigned i = 0; i < 8; ++i)
    EXPECT_EQ(transfer.row_start[i + 1] == transfer.row_start[i], !is_free[i]) << i;
}

TEST(SparseTransfer, in_terms_of_what_a_cell_depends_on)
{
  // In the second cell, which is halved, the right value is the mean of the values at 1 and at 5.
  const Segments       segments(1, {{1, {{1, 5}, {1, 0, 0.5, 0.5}}, std::vector<double>(4, 1.)}});
  const SparseTransfer transfer = segments.transfer(std::vector<bool>(8, true));
  EXPECT_FLOAT_EQ(row_times(transfer, 2, {0, 4, 0, 0, 0, 0}), 3); // in the middle of it: 3/4 and 1/4
  EXPECT_FLOAT_EQ(row_times(transfer, 2, {0, 0, 0, 0, 0, 4}), 1);
  EXPECT_EQ(row_times(transfer, 2, {7, 0, 7, 7, 7, 0}), 0);
}
