#include "unilateral/evaluation/unseen_contact.h"

#include "unilateral/base/diagnostics.h"

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Points that the rule of the condition may not have.
    template <int dim>
    std::vector<RuleName> rules_between(const ElementName &element)
    {
      using Family = RuleName::Family;
      if (element.simplex() && dim == 3)
        return {{Family::trapezoid}, {Family::edges}, {Family::gauss, 2}};
      return {{Family::lobatto, 2 * std::max(element.degree, 1u) + 1}};
    }

    struct CellOfFace
    {
      std::size_t index;
      double      diameter;
    };

    /// The cells at a part, each with the middle of its face, in a tree.
    template <int dim>
    RTree<std::pair<Point<dim>, CellOfFace>> cells_at(const Problem<dim> &problem, const types::boundary_id part)
    {
      std::vector<std::pair<Point<dim>, CellOfFace>> cells;
      for (const auto &cell : problem.space.mesh.triangulation->active_cell_iterators())
        for (const auto face : cell->face_indices())
          if (cell->at_boundary(face) && cell->face(face)->boundary_id() == part)
            cells.push_back({cell->face(face)->center(), {cell->active_cell_index(), cell->diameter()}});
      return RTree<std::pair<Point<dim>, CellOfFace>>(cells.begin(), cells.end());
    }

    /// What is prescribed leaves the point no way to move in the direction of contact, or hardly one.
    bool is_fixed(const TraceRowView &row, const AffineConstraints<double> &dirichlet)
    {
      constexpr double largest = 0.5; // as where contact along a surface is held across at its rim, see constraint_set.cc
      double           free = 0, all = 0;
      for (std::size_t k = 0; k < row.dofs.size(); ++k)
      {
        const bool fixed = dirichlet.is_constrained(row.dofs[k]) && dirichlet.get_constraint_entries(row.dofs[k])->empty();
        free += fixed ? 0 : row.values[k] * row.values[k];
        all += row.values[k] * row.values[k];
      }
      return std::sqrt(free) <= largest * std::sqrt(all);
    }

    template <typename Tree, typename PointType>
    std::optional<typename Tree::value_type> nearest(const Tree &tree, const PointType &x)
    {
      std::vector<typename Tree::value_type> found;
      tree.query(boost::geometry::index::nearest(x, 1), std::back_inserter(found));
      return found.empty() ? std::nullopt : std::optional(found[0]);
    }
  } // namespace

  template <int dim>
  std::vector<UnseenContact>
  unseen_contact(const Problem<dim> &problem, const ConstraintSet<dim> &set, const Vector &u, const Vector &lambda)
  {
    constexpr double           least_depth = 1e-6; // of the cell's diameter
    const auto                &space = problem.space;
    AffineConstraints<double>  none;
    std::vector<UnseenContact> found;
    none.close();
    if (dim == 1 || problem.form->order() != 1)
      return found;
    for (std::size_t b = 0; b < set.blocks.size(); ++b)
    {
      UnilateralCondition condition = problem.conditions[b];
      if (!condition.part)
        continue;
      std::vector<Point<dim>> in_contact;
      for (std::size_t i = set.blocks[b].begin; i < set.blocks[b].end; ++i)
        if (lambda(i) > 0)
          in_contact.push_back(set.points[i].x);
      const RTree<Point<dim>>              contact(in_contact.begin(), in_contact.end());
      const auto                           cells = cells_at(problem, *condition.part);
      std::map<std::size_t, UnseenContact> deepest; // by cell
      for (const RuleName &rule : rules_between<dim>(space.element))
        try
        {
          condition.rule = rule;
          // Without the constraints of unknowns: data that contradict each other between the points of the rule are no error here.
          const auto between = make_constraint_set<dim>({condition}, space.element, *space.mapping, space.dof_handler, none, none,
                                                        *problem.form, space.shared());
          const auto values = between.values_of(u);
          for (std::size_t i = 0; i < between.size(); ++i)
          {
            const auto  &point = between.points[i];
            const double depth = point.sign * (values[i] - point.bound);
            if (!(depth > 0) || is_fixed(between.trace[i], space.dirichlet))
              continue;
            // Of several processes each looks at its own faces: who owns a point on a cut may have none there.
            const auto found_cell = nearest(cells, point.x);
            if (!found_cell || found_cell->first.distance(point.x) > found_cell->second.diameter)
              continue;
            const CellOfFace cell = found_cell->second;
            UnseenContact   &unseen = deepest[cell.index];
            if (depth <= least_depth * cell.diameter || depth <= unseen.depth)
              continue;
            if (const auto neighbour = nearest(contact, point.x); neighbour && neighbour->distance(point.x) <= cell.diameter)
              continue;
            unseen = {b, depth, cell.index, {}};
            for (unsigned d = 0; d < dim; ++d)
              unseen.x[d] = point.x[d];
          }
        }
        catch (const InputError &)
        {
          // Nothing of the part meets the obstacle there, or the bound has no value: there is nothing to compare u with.
        }
      for (const auto &[cell, unseen] : deepest)
        if (unseen.depth > 0)
          found.push_back(unseen);
    }
    return found;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::vector<UnseenContact> unseen_contact(const Problem<dim> &, const ConstraintSet<dim> &, const Vector &, const Vector &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
