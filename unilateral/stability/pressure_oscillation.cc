#include "unilateral/stability/pressure_oscillation.h"

#include "unilateral/algebra/dense_solvers.h"
#include "unilateral/stability/multiplier_pairing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace unilateral
{
  template <int dim>
  std::optional<double>
  pressure_oscillation(const Problem<dim> &problem, const ConstraintSet<dim> &set, const std::size_t block, const Vector &lambda)
  {
    const auto rules = rule_on_cells(problem, set, block);

    // Cells (faces) by vertex, and the cells of each point.
    std::vector<std::vector<unsigned>>        vertices(rules.size());
    std::map<unsigned, std::vector<unsigned>> cells_at_vertex;
    std::vector<std::vector<unsigned>>        cells_of_point(set.size() + 1);
    for (unsigned c = 0; c < rules.size(); ++c)
    {
      const auto collect = [&](const auto &entity)
      {
        for (const unsigned v : entity->vertex_indices())
          vertices[c].push_back(entity->vertex_index(v));
      };
      if (!rules[c].face)
        collect(rules[c].cell);
      else if constexpr (dim > 1)
        collect(rules[c].cell->face(*rules[c].face));
      for (const unsigned v : vertices[c])
        cells_at_vertex[v].push_back(c);
      for (const std::size_t i : rules[c].points)
        cells_of_point[i].push_back(c);
    }
    const auto neighbours = [&](const unsigned c)
    {
      std::set<unsigned> result;
      for (const unsigned v : vertices[c])
        result.insert(cells_at_vertex[v].begin(), cells_at_vertex[v].end());
      return result;
    };

    // The contact zone, holes of single cells closed (where a checkerboard is cut off at zero), less three rings of cells: next to the
    // free boundary the discrete pressure is irregular however smooth it is elsewhere.
    std::vector<bool> inside(rules.size());
    for (unsigned c = 0; c < rules.size(); ++c)
      inside[c] =
        std::any_of(rules[c].points.begin(), rules[c].points.end(), [&](const auto i) { return i < set.size() && lambda(i) > 0; });
    const auto update = [&](const auto &holds)
    {
      std::vector<bool> next(rules.size());
      for (unsigned c = 0; c < rules.size(); ++c)
        next[c] = holds(neighbours(c));
      inside = next;
    };
    const auto is_inside = [&](const unsigned c) { return inside[c]; };
    update([&](const auto &around) { return std::any_of(around.begin(), around.end(), is_inside); });
    for (unsigned ring = 0; ring < 3; ++ring)
      update([&](const auto &around) { return std::all_of(around.begin(), around.end(), is_inside); });

    double deviation = 0, size = 0;
    for (std::size_t i = set.blocks[block].begin; i < set.blocks[block].end; ++i)
    {
      std::set<unsigned> patch(cells_of_point[i].begin(), cells_of_point[i].end());
      if (patch.size() == 1)
        patch = neighbours(*patch.begin());
      if (patch.empty() || !std::all_of(patch.begin(), patch.end(), is_inside))
        continue;
      std::set<std::size_t> others;
      for (const unsigned c : patch)
        others.insert(rules[c].points.begin(), rules[c].points.end());
      others.erase(i);
      others.erase(set.size());
      if (others.size() < 2)
        continue;
      // The least-squares solution of minimal norm: points on a surface or a line need no special treatment.
      Eigen::MatrixXd M(others.size(), dim + 1);
      Eigen::VectorXd values(others.size());
      Eigen::Index    row = 0;
      double          radius = 0;
      for (const std::size_t j : others)
        radius = std::max(radius, set.points[j].x.distance(set.points[i].x));
      for (const std::size_t j : others)
      {
        M(row, 0) = 1;
        for (unsigned d = 0; d < dim; ++d)
          M(row, d + 1) = (set.points[j].x[d] - set.points[i].x[d]) / radius;
        values(row++) = lambda(j);
      }
      const Eigen::VectorXd fit = M.completeOrthogonalDecomposition().solve(values);
      deviation += set.points[i].weight * std::pow(lambda(i) - fit(0), 2);
      size += set.points[i].weight * std::pow(lambda(i), 2);
    }
    if (size == 0)
      return {};
    return std::sqrt(deviation / size);
  }

  template std::optional<double> pressure_oscillation(const Problem<1> &, const ConstraintSet<1> &, std::size_t, const Vector &);
  template std::optional<double> pressure_oscillation(const Problem<2> &, const ConstraintSet<2> &, std::size_t, const Vector &);
  template std::optional<double> pressure_oscillation(const Problem<3> &, const ConstraintSet<3> &, std::size_t, const Vector &);
} // namespace unilateral
