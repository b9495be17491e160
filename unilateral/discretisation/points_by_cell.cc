#include "unilateral/discretisation/points_by_cell.h"

#include <deal.II/base/utilities.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Points by the box of a fine grid in which they lie.
    template <int dim>
    class PointsInBoxes
    {
    public:
      explicit PointsInBoxes(const double spacing) : spacing(spacing) {}

      /// @p dof: of a cell that has the point.
      void put(const std::size_t point, const Point<dim> &x, const types::global_dof_index dof)
      {
        boxes[box_of(x)].push_back({point, x, dof});
      }

      /// The point at x that belongs to the cell with these @p dofs, and to the side of an edge that faces along the normal: the two sides
      /// of a slit, and those of an edge, have points of their own. set.size() where there is none.
      std::size_t find(const Point<dim>                           &x,
                       const std::vector<types::global_dof_index> &dofs,
                       const Tensor<1, dim>                       &normal,
                       const ConstraintSet<dim>                   &set) const
      {
        const Box   home = box_of(x);
        std::size_t best = set.size();
        for (unsigned neighbour = 0; neighbour < Utilities::pow(3u, dim); ++neighbour)
        {
          Box box = home;
          for (unsigned d = 0, rest = neighbour; d < dim; ++d, rest /= 3)
            box[d] += long(rest % 3) - 1;
          if (const auto it = boxes.find(box); it != boxes.end())
            for (const auto &[i, at, dof] : it->second)
              if (x.distance(at) < 1e-2 * spacing && std::find(dofs.begin(), dofs.end(), dof) != dofs.end())
                if (best == set.size() || (!set.directions.empty() && set.directions[i] * normal > set.directions[best] * normal))
                  best = i;
        }
        return best;
      }

    private:
      using Box = std::array<long, dim>;
      struct Place
      {
        std::size_t             point;
        Point<dim>              x;
        types::global_dof_index dof;
      };

      Box box_of(const Point<dim> &x) const
      {
        Box box;
        for (unsigned d = 0; d < dim; ++d)
          box[d] = std::lround(x[d] / spacing);
        return box;
      }

      const double                      spacing;
      std::map<Box, std::vector<Place>> boxes;
    };
  } // namespace

  template <int dim>
  std::vector<RuleOnCell<dim>> rule_on_cells(const Problem<dim> &problem, const ConstraintSet<dim> &set, const std::size_t block)
  {
    const auto &[begin, end] = std::pair(set.blocks[block].begin, set.blocks[block].end);
    const auto  &fe = *problem.space.fe;
    const double spacing = 1e-3 * problem.space.cell_sizes().first;

    PointsInBoxes<dim> points(spacing);
    for (std::size_t i = begin; i < end; ++i)
      points.put(i, set.points[i].x, set.trace[i].dofs[0]);
    for (const auto &image : set.images) // which the cells at the periodic partner have
      if (image.point >= begin && image.point < end)
      {
        const auto *const node = problem.space.couplings.periodic.image_with(image.row.dofs[0]).first;
        points.put(image.point, set.points[image.point].x + (node->node.x - node->original.x), image.row.dofs[0]);
      }
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());

    std::vector<RuleOnCell<dim>> rules;
    const auto                   add = [&](const auto &cell, const std::optional<unsigned> face, const FEValuesBase<dim> &values)
    {
      cell->get_dof_indices(dofs);
      RuleOnCell<dim> rule{cell, face, values.get_quadrature_points(), {}};
      for (const unsigned q : values.quadrature_point_indices())
        rule.points.push_back(points.find(values.quadrature_point(q), dofs, face ? values.normal_vector(q) : Tensor<1, dim>(), set));
      rules.push_back(std::move(rule));
    };
    const auto &condition = problem.conditions[block];
    if (!condition.part)
    {
      FEValues<dim> values(*problem.space.mapping, fe, quadrature_rule<dim>(condition.rule, problem.space.element),
                           update_quadrature_points);
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      {
        values.reinit(cell);
        add(cell, {}, values);
      }
      return rules;
    }
    FEFaceValues<dim> values(*problem.space.mapping, fe, quadrature_rule<dim - 1>(condition.rule, problem.space.element),
                             update_quadrature_points | update_normal_vectors);
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      for (const auto face : cell->face_indices())
        if (cell->at_boundary(face) && cell->face(face)->boundary_id() == *condition.part)
        {
          values.reinit(cell, face);
          add(cell, face, values);
        }
    return rules;
  }

  template <int dim>
  void add_at_cuts(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, std::vector<double> &at_points)
  {
    if (problem.space.processes().alone() || !constraint_set.at_nodes())
      return;
    std::vector<double> at_unknowns(problem.space.dof_handler.n_dofs());
    for (const ConstraintBlock &block : constraint_set.blocks)
    {
      std::fill(at_unknowns.begin(), at_unknowns.end(), 0.);
      for (std::size_t i = block.begin; i < block.end; ++i)
        for (const auto dof : constraint_set.trace[i].dofs)
          at_unknowns[dof] = at_points[i];
      problem.space.shared().add(at_unknowns.data());
      for (std::size_t i = block.begin; i < block.end; ++i)
        if (const auto row = constraint_set.trace[i]; !row.dofs.empty())
          at_points[i] = at_unknowns[row.dofs.front()];
    }
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::vector<RuleOnCell<dim>> rule_on_cells(const Problem<dim> &, const ConstraintSet<dim> &, std::size_t);                      \
  template void                         add_at_cuts(const Problem<dim> &, const ConstraintSet<dim> &, std::vector<double> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
