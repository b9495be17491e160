// Which process gets which cells.
#include "unilateral/mesh/division.h"

#include "unilateral/mesh/make_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <vector>

namespace
{
  using namespace dealii;
  using namespace unilateral;

  /// Owners of the base cells with a vertex where @p there holds.
  template <int dim>
  std::set<unsigned> owners_at(const Mesh<dim> &mesh, const Division &division, const std::function<bool(const Point<dim> &)> &there)
  {
    std::set<unsigned> owners;
    unsigned           number = 0;
    for (const auto &cell : mesh.triangulation->cell_iterators_on_level(division.base_level))
    {
      for (const unsigned v : cell->vertex_indices())
        if (there(cell->vertex(v)))
          owners.insert(division.owner[number]);
      ++number;
    }
    return owners;
  }

  std::size_t largest_part(const Division &division, const unsigned n_parts)
  {
    std::vector<std::size_t> n_cells(n_parts, 0);
    for (const unsigned owner : division.owner)
      ++n_cells[owner];
    return *std::max_element(n_cells.begin(), n_cells.end());
  }
} // namespace

TEST(Division, KeepsCellsAtTiedPartsTogether)
{
  auto mesh = make_mesh<2>(box({0, 0}, {2, 1}, {40, 20}), false);
  mesh.triangulation->refine_global(1);
  for (const unsigned n : {2u, 3u, 4u})
  {
    const auto left_and_right = divide(*mesh.triangulation, n, {}, {{0, 1}});
    EXPECT_EQ(owners_at<2>(mesh, left_and_right, [](const Point<2> &x) { return x[0] < 1e-9 || x[0] > 2 - 1e-9; }).size(), 1u) << n;
    EXPECT_LE(largest_part(left_and_right, n), 1.1 * left_and_right.owner.size() / n) << n;

    // Two parts that nothing connects may have two owners.
    const auto each = divide(*mesh.triangulation, n, {}, {{0}, {1}});
    EXPECT_EQ(owners_at<2>(mesh, each, [](const Point<2> &x) { return x[0] < 1e-9; }).size(), 1u) << n;
    EXPECT_EQ(owners_at<2>(mesh, each, [](const Point<2> &x) { return x[0] > 2 - 1e-9; }).size(), 1u) << n;
    EXPECT_NE(owners_at<2>(mesh, each, [](const Point<2> &x) { return x[0] < 1e-9; }),
              owners_at<2>(mesh, each, [](const Point<2> &x) { return x[0] > 2 - 1e-9; }))
      << n;

    // Those that meet at a corner have one.
    const auto meeting = divide(*mesh.triangulation, n, {}, {{0}, {2}});
    EXPECT_EQ(owners_at<2>(mesh, meeting, [](const Point<2> &x) { return x[0] < 1e-9 || x[1] < 1e-9; }).size(), 1u) << n;
  }
}

TEST(Division, KeepsCellsAtTiedPartsTogetherInSpace)
{
  const auto mesh = make_mesh<3>(box({0, 0, 0}, {1, 1, 1}, {10, 10, 10}), true);
  for (const unsigned n : {2u, 5u})
  {
    const auto division = divide(*mesh.triangulation, n, {}, {{5}});
    EXPECT_EQ(owners_at<3>(mesh, division, [](const Point<3> &x) { return x[2] > 1 - 1e-9; }).size(), 1u) << n;
    EXPECT_LE(largest_part(division, n), 1.05 * division.owner.size() / n) << n;
  }
}

TEST(Division, DoesNotCutAlongTheBorderOfWhatWillBeRefined)
{
  // The corner that is refined twice is half of the cells to come. Fewest faces are cut around it, where all cells across would become
  // as small.
  const auto          mesh = make_mesh<3>(box({0, 0, 0}, {1, 1, 1}, {16, 16, 16}), false);
  std::vector<double> weights;
  for (const auto &cell : mesh.triangulation->active_cell_iterators())
  {
    const auto   x = cell->center();
    const double sum = x[0] + x[1] + x[2];
    weights.push_back(sum < 0.5 ? 64 : sum < 0.8 ? 8 : 1);
  }
  const auto  division = divide(*mesh.triangulation, 2, weights);
  std::size_t n_cut = 0, n_along_border = 0;
  double      of_first = 0, of_all = 0;
  for (const auto &cell : mesh.triangulation->active_cell_iterators())
  {
    const auto c = cell->active_cell_index();
    of_all += weights[c];
    of_first += division.owner[c] == 0 ? weights[c] : 0;
    for (const auto face : cell->face_indices())
      if (!cell->at_boundary(face))
        if (const auto other = cell->neighbor(face)->active_cell_index(); other > c && division.owner[c] != division.owner[other])
        {
          ++n_cut;
          n_along_border += weights[c] != weights[other];
        }
  }
  EXPECT_NEAR(of_first, 0.5 * of_all, 0.05 * of_all);
  EXPECT_LT(n_along_border, n_cut / 4);
}

TEST(Division, LeavesNoPartEmptyWhateverACellWeighs)
{
  const Mesh<2>       mesh = make_mesh<2>(box({0, 0}, {1, 1}, {10, 10}), false);
  std::vector<double> weights(100, 1.);
  weights[0] = 1e5;
  for (const unsigned n : {2u, 3u, 4u, 7u})
  {
    const Division        division = divide(*mesh.triangulation, n, weights);
    std::vector<unsigned> n_cells(n, 0);
    for (const unsigned owner : division.owner)
      ++n_cells[owner];
    EXPECT_GT(*std::min_element(n_cells.begin(), n_cells.end()), 0u) << n;
  }
}
