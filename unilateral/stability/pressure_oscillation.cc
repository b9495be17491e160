#include "unilateral/stability/pressure_oscillation.h"

#include "unilateral/algebra/dense_solvers.h"
#include "unilateral/stability/multiplier_pairing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace unilateral
{
  namespace
  {
    /// The cells (faces) with points of a block, numbered in the mesh's order, and which of them are neighbours.
    template <int dim>
    class CellsAroundPoints
    {
    public:
      CellsAroundPoints(const Problem<dim> &problem, const ConstraintSet<dim> &set, const std::size_t block)
        : rules(rule_on_cells(problem, set, block)), vertices(rules.size()), cells_of_point(set.size() + 1)
      {
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
      }

      unsigned                        n_cells() const { return rules.size(); }
      const std::vector<std::size_t> &points(const unsigned cell) const { return rules[cell].points; }

      /// Those with a common vertex, and the cell itself.
      std::set<unsigned> neighbours(const unsigned cell) const
      {
        std::set<unsigned> result;
        for (const unsigned v : vertices[cell])
          result.insert(cells_at_vertex.at(v).begin(), cells_at_vertex.at(v).end());
        return result;
      }

      /// The cells that share the point, or the neighbours of the only one that holds it.
      std::set<unsigned> patch(const std::size_t point) const
      {
        const std::set<unsigned> cells(cells_of_point[point].begin(), cells_of_point[point].end());
        return cells.size() == 1 ? neighbours(*cells.begin()) : cells;
      }

    private:
      const std::vector<RuleOnCell<dim>>        rules;
      std::vector<std::vector<unsigned>>        vertices; ///< of each cell
      std::map<unsigned, std::vector<unsigned>> cells_at_vertex;
      std::vector<std::vector<unsigned>>        cells_of_point; ///< the last entry is that of dropped points
    };

    /// The cells of the contact zone, holes of single cells closed (where a checkerboard is cut off at zero), less three rings of cells:
    /// next to the free boundary the discrete pressure is irregular however smooth it is elsewhere.
    template <int dim>
    std::vector<bool> cells_inside_contact(const CellsAroundPoints<dim> &cells, const ConstraintSet<dim> &set, const Vector &lambda)
    {
      std::vector<bool> inside(cells.n_cells());
      for (unsigned c = 0; c < cells.n_cells(); ++c)
        inside[c] =
          std::any_of(cells.points(c).begin(), cells.points(c).end(), [&](const auto i) { return i < set.size() && lambda(i) > 0; });
      const auto update = [&](const auto &holds)
      {
        std::vector<bool> next(cells.n_cells());
        for (unsigned c = 0; c < cells.n_cells(); ++c)
          next[c] = holds(cells.neighbours(c));
        inside = next;
      };
      const auto is_inside = [&](const unsigned c) { return inside[c]; };
      update([&](const auto &around) { return std::any_of(around.begin(), around.end(), is_inside); });
      for (unsigned ring = 0; ring < 3; ++ring)
        update([&](const auto &around) { return std::all_of(around.begin(), around.end(), is_inside); });
      return inside;
    }

    /// The value at point @p i of the linear function that fits the pressures at @p others best.
    template <int dim>
    double linear_fit(const ConstraintSet<dim> &set, const Vector &lambda, const std::size_t i, const std::set<std::size_t> &others)
    {
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
      // The least-squares solution of minimal norm: points on a surface or a line need no special treatment.
      const Eigen::VectorXd fit = M.completeOrthogonalDecomposition().solve(values);
      return fit(0);
    }
  } // namespace

  template <int dim>
  std::optional<double>
  pressure_oscillation(const Problem<dim> &problem, const ConstraintSet<dim> &set, const std::size_t block, const Vector &lambda)
  {
    const CellsAroundPoints<dim> cells(problem, set, block);
    const std::vector<bool>      inside = cells_inside_contact(cells, set, lambda);
    double                       deviation = 0, size = 0;
    for (std::size_t i = set.blocks[block].begin; i < set.blocks[block].end; ++i)
    {
      const std::set<unsigned> patch = cells.patch(i);
      if (patch.empty() || !std::all_of(patch.begin(), patch.end(), [&](const unsigned c) { return inside[c]; }))
        continue;
      std::set<std::size_t> others;
      for (const unsigned c : patch)
        others.insert(cells.points(c).begin(), cells.points(c).end());
      others.erase(i);
      others.erase(set.size()); // dropped points
      if (others.size() < 2)
        continue;
      deviation += set.points[i].weight * std::pow(lambda(i) - linear_fit(set, lambda, i, others), 2);
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
